//! Momentum about the centre of mass, and the matrix that maps q̇ to it.
//!
//! Orin, Goswami & Lee, "Centroidal dynamics of a humanoid robot" (2013). A column is the momentum
//! of the composite body beyond a joint when that coordinate alone moves at unit rate, so that the
//! composite inertias of the CRBA give the matrix in O(n) (their section 5; Wensing & Orin, 2016).

use core::borrow::Borrow;

use heapless::Vec;

use crate::algorithms::kinematics::frame::Pose;
use crate::algorithms::momentum::{mass_and_first_moment, momentum, reciprocal};
use crate::algorithms::tree_pass::{inward, per_body};
use crate::effects::{Declared, Effect, body_inertia};
use crate::model::RobotModel;
use crate::scalar::{Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{Force, Xform};
use crate::state::{Configuration, RobotState};

/// The centroidal momentum h_G: about the centre of mass and along the base's axes, N·m·s and N·s.
///
/// ```text
/// h_G = ⁰X_Gᵀ h = Σ_i ⁱX_Gᵀ I_i v_i
/// ```
///
/// # Shape
/// 6.
///
/// # Cost
/// O(B): some 250 flops for each revolute joint.
///
/// # Source
/// Orin, Goswami & Lee (2013).
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::centroidal_momentum, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
/// assert!(centroidal_momentum(&Ur5e::MODEL, &state, &()).ang.z > 0.0);
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn centroidal_momentum<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> Force<R>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let (mass, moment) = mass_and_first_moment(robot, trig, effects);
    let h = momentum(robot, trig.with(state), effects);
    Force::new(h.ang - (moment * reciprocal(mass)).cross(h.lin), h.lin)
}

/// The centroidal momentum matrix A_G with h_G = A_G q̇, by columns, one for each coordinate; for a
/// base at rest.
///
/// About the centre of mass and along the base's axes, N·m·s and N·s per rad/s or m/s.
///
/// ```text
/// h_G = A_G q̇      A_G,j = ʲX_Gᵀ Iᶜ_j S_j
/// ```
///
/// # Shape
/// 6 × V.
///
/// # Cost
/// O(B): some 350 flops for each revolute joint.
///
/// # Source
/// Orin, Goswami & Lee (2013), section 5.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{centroidal_matrix, centroidal_momentum}, model::Robot, robots::Ur5e, state::State};
/// let state = State { qd: [0.0, 2.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.3_f64; 6]) };
/// let column = centroidal_matrix(&Ur5e::MODEL, &state.q, &())[1];
/// let h = centroidal_momentum(&Ur5e::MODEL, &state, &());
/// assert!((h.ang - column.ang * 2.0).length() < 1e-12);
/// ```
#[doc(alias = "CMM")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn centroidal_matrix<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
) -> [Force<R>; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    const { assert!(!E::GYROSCOPIC_ROTORS, "no rotors that spin as bodies here; name `Armature`") };
    let turns = &trig.coordinates;
    let (mass, moment) = mass_and_first_moment(robot, trig, effects);
    let centre = moment * reciprocal(mass);

    let mut at = per_body(robot, Pose::IDENTITY);
    let mut bodies: Vec<(Pose<R>, Xform<R>, CompositeInertia<R>), B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let pose = at.parent(&link).transformed_by(&x);
        let _ = bodies.push((pose, x, body_inertia(effects, i, &link).into()));
        at.push(pose);
    }

    let mut columns = [Force::ZERO; V];
    let mut pass = inward(&mut bodies);
    while let Some(((pose, x, composite), inner)) = pass.next() {
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        for (k, coordinate) in link.coordinates().enumerate() {
            let h = composite.along(&link.subspace(turns, k));
            let (ang, lin) = (pose.rot * h.ang, pose.rot * h.lin);
            if let Some(column) = columns.get_mut(coordinate) {
                *column = Force::new(ang + (pose.pos - centre).cross(lin), lin);
            }
        }
        if let Some(parent) = inner.get_mut(link.parent) {
            parent.2 += composite.at_parent(x);
        }
    }
    columns
}
