//! The geometric Jacobian of a body, and its drift J̇ q̇.
//!
//! Featherstone, RBDA (2008), section 4.1: v = J q̇, the column of a coordinate being that of S at its
//! joint, taken to the body; zero for joints that do not carry the body.

use super::frame::{Frame, Pose};
use super::handed::Handed;
use super::kinematics::described;
use crate::model::{BASE, Description};
use crate::scalar::{Matrix, Real};
use crate::spatial::{Motion, Xform};
use crate::state::{Posture, State};

/// J with v = J q̇: the velocity of `body` in a [`Frame`], by columns, one a coordinate.
///
/// ω in rad/s and velocity in m/s per rad/s or m/s. τ = Jᵀ f for a force on the body in the same frame.
/// All zero for the base; NaN for a body that the robot does not have. Cost: 81 flops a revolute joint that carries the body and 39
/// (`Body`), 69 (`Mixed`) or 81 (`World`) a coordinate; O(depth). Errors: none. Source: RBDA (2008), section 4.1.
///
/// ```
/// use dynamics_core::{algorithms::{frame, jacobian}, model::Robot, robots::Ur5e};
/// let j = jacobian(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], 5, frame::Mixed);
/// assert!((j[0].ang.z - 1.0).abs() < 1e-12); // the first axis is vertical
/// ```
#[inline(always)]
pub fn jacobian<R: Real, D, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &[R; Q],
    body: usize,
    frame: F,
) -> [Motion<R>; V]
where
    D: Description<R, B, Q, V>,
{
    jacobian_at(robot, &Posture::of(robot, q), body, frame)
}

/// As [`jacobian`], at a posture whose sines and cosines are at hand.
#[inline(always)]
pub fn jacobian_at<R: Real, D, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    body: usize,
    _: F,
) -> [Motion<R>; V]
where
    D: Description<R, B, Q, V>,
{
    let turns = &posture.turns;
    let mut columns = [Motion::ZERO; V];
    let mut x = Xform::IDENTITY; // from the body reached to the one asked for
    let mut reached = body;
    for _ in 0..B {
        let Some(node) = robot.node(reached) else {
            break; // the base
        };
        if reached == body {
            x.rot = node.frame.transpose();
        }
        for (k, coordinate) in node.coordinates().enumerate() {
            if let Some(column) = columns.get_mut(coordinate) {
                *column = x * node.column(turns, k);
            }
        }
        x = x * node.xform(turns);
        reached = node.parent;
    }
    let pose = Pose {
        rot: x.rot.transpose(),
        pos: x.pos,
    };
    for column in &mut columns {
        *column = F::tell(&pose, *column);
    }
    if body >= B && body != BASE {
        columns = [Motion::nan(); V];
    }
    columns
}

/// J̇ q̇: the acceleration of `body` at q̈ = 0, in a [`Frame`], rad/s² and m/s².
///
/// The derivative of J q̇ in that frame's coordinates: in `Mixed` ω̇ and p̈, in the others the spatial
/// acceleration. `state.qdd` is not read. Zero for the base; NaN for a body that the robot does not have. Cost: O(B); some 170 flops a
/// revolute joint. Errors: none. Source: RBDA (2008), (4) of Featherstone & Orin (2000) at q̈ = 0.
///
/// ```
/// use dynamics_core::{algorithms::{drift, frame}, model::Robot, robots::Ur5e, state::State};
/// let turning = State { qd: [2.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
/// let a = drift(&Ur5e::MODEL, &turning, 5, frame::Mixed);
/// assert!(a.lin.x > 3.0); // towards the axis
/// ```
#[inline(always)]
pub fn drift<R: Real, D, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    body: usize,
    frame: F,
) -> Motion<R>
where
    D: Description<R, B, Q, V>,
{
    drift_at(robot, &Posture::of(robot, &state.q), state, body, frame)
}

/// As [`drift`], at a posture whose sines and cosines are at hand; `state.q` is not read.
#[inline(always)]
pub fn drift_at<R: Real, D, F: Frame, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    body: usize,
    _: F,
) -> Motion<R>
where
    D: Description<R, B, Q, V>,
{
    let turns = &posture.turns;
    let mut moving = Handed::<_, B>::from((Pose::IDENTITY, Motion::ZERO, Motion::ZERO));
    for (i, node) in robot.nodes().enumerate() {
        let (pose, v, a) = moving.by(D::CHAIN, node.parent);
        let x = node.xform(turns);
        let pose = pose.beyond(&x);
        let v = node.plus_motion(x * v, turns, &state.qd);
        let a = node.plus_velocity_product(x * a, turns, &state.qd, v);
        if i == body {
            let pose = pose.described(&node.frame);
            let tell = |m| F::tell(&pose, described(&node, m));
            return tell(a) + F::extra(tell(v));
        }
        moving.push(D::CHAIN, (pose, v, a));
    }
    if body == BASE {
        Motion::ZERO
    } else {
        Motion::nan()
    }
}
