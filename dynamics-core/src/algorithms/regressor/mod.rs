//! The regressor Y of inverse dynamics, which is linear in the inertial parameters: τ = Y(q, q̇,
//! q̈) φ.
//!
//! Atkeson, An & Hollerbach, "Estimation of inertial parameters of manipulator loads and links"
//! (1986). The force on a body is A(v, a) φ, and Sᵀ Xᵀ A = (X S)ᵀ A: each entry of Y is the power
//! per parameter as the body moves by a column of X S, so that neither A nor its columns at other
//! bodies are stored.

mod friction;
mod parameters;
mod power;

pub use friction::friction_regressor;
pub use parameters::inertial_parameters;

use core::borrow::Borrow;

use heapless::Vec;

use self::power::BodyPower;
use super::rnea::{acceleration, velocity};
use super::tree_pass::per_body;
use crate::effects::{Effect, base_motion};
use crate::model::{LinkView, RobotModel};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Motion, Xform};
use crate::state::{Configuration, JointTrig, RobotState, State};

/// The regressor Y of the joints' torques, by coordinates, bodies and parameters: N·m or N per unit
/// of each parameter.
///
/// The ten parameters φ of a body are those of
/// [`SpatialInertia::parameters`](crate::spatial::SpatialInertia::parameters) about the origin of
/// the body's own frame and along its axes: m, m c_x, m c_y, m c_z, I_xx, I_xy, I_yy, I_xz, I_yz,
/// I_zz.
///
/// ```text
/// τ_j = Σ_i Y_ji φ_i      Y_ji = (ⁱX_j S_j)ᵀ A_i(v_i, a_i)
/// ```
///
/// if body i is on a branch that joint j carries, zero elsewhere. The effects are those of
/// [`rnea`](crate::algorithms::rnea()): gravity, accelerations, velocity products and the motion of
/// the base are in Y as far as the scene has them. Effects that do not depend on the bodies'
/// inertias, such as friction ([`friction_regressor`]), armatures (their column is q̈), spinning
/// rotors and wrenches, are not. A non-finite input gives a non-finite output.
///
/// # Shape
/// V × B × 10, 40 B V bytes in f32.
///
/// # Cost
/// O(B V): some 200 flops for each body, and 140 for each pair of a body and a coordinate that
/// moves it; 4,200 for the UR5e.
///
/// # Source
/// Atkeson, An & Hollerbach (1986), (11) to (17); the order of parameters is that of Pinocchio.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{inertial_parameters, regressor, rnea};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
/// let y = regressor(&Ur5e::MODEL, &state, &RIGID_BODY);
/// let phi = inertial_parameters(&Ur5e::MODEL, &());
/// let tau = y.map(|row| row.iter().flatten().zip(phi.iter().flatten()).map(|(y, phi)| y * phi).sum::<f64>());
/// let same = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
/// assert!(tau.iter().zip(same).all(|(tau, same)| (tau - same).abs() < 1e-12));
/// ```
#[doc(alias = "computeJointTorqueRegressor")]
#[doc(alias = "parameter identification")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn regressor<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> [[[R; 10]; B]; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let mut y = [[[R::ZERO; 10]; B]; V];
    outward(robot, trig, state, effects, B, |i, [v, a], xforms| {
        let Some(link) = robot.link(i) else {
            return;
        };
        let power = BodyPower::of(&link, v, a);
        climb(robot, trig, i, xforms, |k, s| {
            if let Some(entry) = y.get_mut(k).and_then(|row| row.get_mut(i)) {
                *entry = power.per_parameter(s);
            }
        });
    });
    y
}

/// The columns of the [`regressor`] of one body, by coordinates: the torques of the joints per unit
/// of its parameters.
///
/// For a payload that is fixed to the body, with its parameters in the body's own frame. Without
/// such a body all are zero.
///
/// # Shape
/// V × 10.
///
/// # Cost
/// O(B): some 110 flops for each body, and 160 for each coordinate that moves this one; 1,700 for
/// the last body of the UR5e.
///
/// # Source
/// As [`regressor`].
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{regressor_columns, rnea};
/// use dynamics_core::effects::{Payload, RIGID_BODY};
/// use dynamics_core::{model::{BodyInertia, Robot}, robots::Ur5e, state::State};
/// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
/// let load = BodyInertia { mass: 2.0, com: [0.0, 0.03, 0.1], inertia: [0.01, 0.0, 0.0, 0.01, 0.0, 0.01] };
/// let load = Payload::<f64, WRIST>::from_inertia(load);
/// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3; 6]) };
/// let y = regressor_columns(&Ur5e::MODEL, &state, &RIGID_BODY, WRIST);
/// let tau = y.map(|row| row.iter().zip(load.0.parameters()).map(|(y, phi)| y * phi).sum::<f64>());
/// let with = rnea(&Ur5e::MODEL, &state, &(RIGID_BODY, load));
/// let without = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
/// assert!((0..6).all(|j| (tau[j] - (with[j] - without[j])).abs() < 1e-12));
/// ```
#[doc(alias = "load identification")]
#[doc(alias = "payload identification")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn regressor_columns<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
    body: usize,
) -> [[R; 10]; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let mut y = [[R::ZERO; 10]; V];
    outward(robot, trig, state, effects, B, |i, [v, a], xforms| {
        let Some(link) = robot.link(i).filter(|_| i == body) else {
            return;
        };
        let power = BodyPower::of(&link, v, a);
        climb(robot, trig, i, xforms, |k, s| {
            if let Some(row) = y.get_mut(k) {
                *row = power.per_parameter(s);
            }
        });
    });
    y
}

/// The row of the [`regressor`] of one coordinate, by bodies: its torque per unit of each body's
/// parameters, N·m or N.
///
/// For an estimator that uses one joint in each tick. The entries of bodies that the joint does not
/// move are zero, all of them for a coordinate that the robot does not have.
///
/// # Shape
/// B × 10.
///
/// # Cost
/// O(B): some 110 flops for each body, and 180 for each body that the joint moves.
///
/// # Source
/// As [`regressor`].
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{regressor, regressor_row};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
/// let row = regressor_row(&Ur5e::MODEL, &state, &RIGID_BODY, 2);
/// let all = regressor(&Ur5e::MODEL, &state, &RIGID_BODY)[2];
/// assert!(row.iter().flatten().zip(all.iter().flatten()).all(|(row, all)| (row - all).abs() < 1e-12));
/// assert_eq!(row[1], [0.0; 10]); // the elbow does not move the upper arm
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn regressor_row<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
    coordinate: usize,
) -> [[R; 10]; B]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    regressor_row_of_bodies(robot, state, effects, coordinate, &[true; B])
}

/// The entries of a [`regressor_row`] at these bodies, and zeros.
///
/// For an estimator of few parameters: those of its
/// `motion_control::estimate::SelectedParameters::bodies`.
///
/// # Shape
/// B × 10.
///
/// # Cost
/// O(B): some 110 flops for each body up to the last one of these, 30 for each that the joint
/// moves, 150 for each of these.
///
/// # Source
/// As [`regressor`].
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{regressor_row, regressor_row_of_bodies};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
/// let bodies = [false, false, true, false, true, false];
/// let row = regressor_row_of_bodies(&Ur5e::MODEL, &state, &RIGID_BODY, 1, &bodies);
/// let whole = regressor_row(&Ur5e::MODEL, &state, &RIGID_BODY, 1);
/// assert_eq!([row[2], row[4], row[5]], [whole[2], whole[4], [0.0; 10]]);
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn regressor_row_of_bodies<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
    coordinate: usize,
    bodies: &[bool; B],
) -> [[R; 10]; B]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let mut y = [[R::ZERO; 10]; B];
    let mut moved = per_body(robot, None);
    let count = bodies.iter().rposition(|is_in| *is_in).map_or(0, |last| last + 1);
    outward(robot, trig, state, effects, count, |i, [v, a], xforms| {
        let (Some(link), Some(x)) = (robot.link(i), xforms.last()) else {
            return;
        };
        let s = if link.coordinates().contains(&coordinate) {
            Some(link.column(turns, coordinate - link.idx_v()))
        } else {
            moved.parent(&link).map(|s| *x * s)
        };
        moved.push(s);
        if let (Some(s), Some(entry), Some(true)) = (s, y.get_mut(i), bodies.get(i)) {
            let frame = &link.to_joint_frame;
            let own = Motion::new(frame.transpose_mul(s.ang), frame.transpose_mul(s.lin));
            *entry = BodyPower::of(&link, v, a).per_parameter(own);
        }
    });
    y
}

/// Visits each of the first `count` bodies with its number, its velocity and acceleration, and the
/// transforms of all bodies up to it. Featherstone & Orin (3), (4).
#[cfg_attr(optimised, inline(always))]
fn outward<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    count: usize,
    mut visit: impl FnMut(usize, [Motion<R>; 2], &[Xform<R>]),
) where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let (v_0, a_0) = base_motion(effects);
    let mut v = per_body(robot, v_0);
    let mut a = per_body(robot, a_0);
    let mut xforms: Vec<Xform<R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate().take(count) {
        let x = link.xform(turns);
        let v_i = velocity(effects, &link, x * v.parent(&link), turns, state); // (3)
        v.push(v_i);
        let a_i = acceleration(effects, &link, x * a.parent(&link), v_i, turns, state); // (4)
        a.push(a_i);
        let _ = xforms.push(x);
        let known = if E::VELOCITY_PRODUCTS { v_i } else { Motion::ZERO };
        visit(i, [known, a_i], &xforms);
    }
}

/// Visits each coordinate that moves body `i` with the body's motion per unit of its rate, in the
/// body's own frame: X S of the joints on the path from the body to the base.
#[cfg_attr(optimised, inline(always))]
fn climb<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    i: usize,
    xforms: &[Xform<R>],
    mut visit: impl FnMut(usize, Motion<R>),
) where
    D: RobotModel<R, B, Q, V>,
{
    let own =
        |link: LinkView<'_, R>| Xform { rot: link.to_joint_frame.transpose(), pos: R::Vec3::ZERO };
    let (mut at, mut x) = (i, robot.link(i).map_or(Xform::IDENTITY, own));
    // As many steps as there are bodies at most.
    for _ in 0..=i {
        let (Some(link), Some(&up)) = (robot.link(at), xforms.get(at)) else {
            break;
        };
        for (column, k) in link.coordinates().enumerate() {
            visit(k, x * link.column(&trig.coordinates, column));
        }
        (at, x) = (link.parent, x * up);
    }
}
