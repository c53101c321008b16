//! The geometric Jacobian of a body, and its bias acceleration J̇ q̇.
//!
//! Featherstone, RBDA (2008), section 4.1: the column of a coordinate is that of S at its joint,
//! transformed to the body; zero for joints that do not move the body.

use core::borrow::Borrow;

use crate::algorithms::kinematics::frame::{Frame, Pose};
use crate::algorithms::kinematics::in_link_frame;
use crate::algorithms::tree_pass::per_body;
use crate::model::{BASE, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::{Motion, Xform};
use crate::state::{Configuration, RobotState};

/// The geometric Jacobian J of `body` in a [`Frame`] with v = J q̇, by columns, one for each
/// coordinate.
///
/// ω in rad/s and velocity in m/s per rad/s or m/s; the force f on the body b is in the same frame:
///
/// ```text
/// v_b = J q̇      τ = Jᵀ f
/// J_j = ᵇX_j S_j if joint j moves body b, 0 otherwise
/// ```
///
/// # Shape
/// 6 × V; zero for the base, NaN for a body that the robot does not have.
///
/// # Cost
/// O(depth): 81 flops for each revolute joint between body and base, and 39 (`Local`), 69
/// (`LocalWorldAligned`) or 81 (`World`) for each coordinate.
///
/// # Source
/// RBDA (2008), section 4.1.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{frame, jacobian}, model::Robot, robots::Ur5e};
/// let j = jacobian(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], 5, frame::LocalWorldAligned);
/// assert!((j[0].ang.z - 1.0).abs() < 1e-12); // the first axis is vertical
/// ```
#[doc(alias = "geometric Jacobian")]
#[doc(alias = "end effector")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn jacobian<R: Real, D, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    body: usize,
    frame: F,
) -> [Motion<R>; V]
where
    D: RobotModel<R, B, Q, V>,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    let turns = &trig.coordinates;
    let mut columns = [Motion::ZERO; V];
    let mut x = Xform::IDENTITY; // from the body reached to `body`
    let mut reached = body;
    for _ in 0..B {
        let Some(link) = robot.link(reached) else {
            break; // the base
        };
        if reached == body {
            x.rot = link.to_joint_frame.transpose();
        }
        for (k, coordinate) in link.coordinates().enumerate() {
            if let Some(column) = columns.get_mut(coordinate) {
                *column = x * link.column(turns, k);
            }
        }
        x = x * link.xform(turns);
        reached = link.parent;
    }
    let pose = Pose { rot: x.rot.transpose(), pos: x.pos };
    for column in &mut columns {
        *column = frame.express(&pose, *column);
    }
    if body >= B && body != BASE {
        columns = [Motion::nan(); V];
    }
    columns
}

/// The acceleration J̇ q̇ of `body` at q̈ = 0, in a [`Frame`], rad/s² and m/s².
///
/// It is the derivative of J q̇ in that frame's coordinates: in `LocalWorldAligned` ω̇ and p̈, in
/// the others the spatial acceleration. `state.qdd` is not read.
///
/// ```text
/// v̇_b = J q̈ + J̇ q̇
/// ```
///
/// # Shape
/// 6; zero for the base, NaN for a body that the robot does not have.
///
/// # Cost
/// O(B): some 170 flops for each revolute joint.
///
/// # Source
/// Featherstone & Orin (2000), (4) at q̈ = 0; RBDA (2008), section 4.1.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{bias_acceleration, frame}, model::Robot, robots::Ur5e, state::State};
/// let turning = State { qd: [2.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
/// let a = bias_acceleration(&Ur5e::MODEL, &turning, 5, frame::LocalWorldAligned);
/// assert!(a.lin.x > 3.0); // towards the axis
/// ```
#[doc(alias = "drift")]
#[doc(alias = "Jdot")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn bias_acceleration<R: Real, D, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    body: usize,
    frame: F,
) -> Motion<R>
where
    D: RobotModel<R, B, Q, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let mut moving = per_body(robot, (Pose::IDENTITY, Motion::ZERO, Motion::ZERO));
    for (i, link) in robot.links().enumerate() {
        let (pose, v, a) = moving.parent(&link);
        let x = link.xform(turns);
        let pose = pose.transformed_by(&x);
        let v = link.plus_motion(x * v, turns, &state.qd);
        let a = link.plus_velocity_product(x * a, turns, &state.qd, v);
        if i == body {
            let pose = pose.in_link_frame(&link.to_joint_frame);
            let express = |m| frame.express(&pose, in_link_frame(&link, m));
            return express(a) + frame.classical_term(express(v));
        }
        moving.push((pose, v, a));
    }
    if body == BASE { Motion::ZERO } else { Motion::nan() }
}
