//! Kinematics: poses, velocities and accelerations of the bodies.
//!
//! Featherstone & Orin (2000), equations (3) and (4); RBDA (2008), table 5.1, without the forces.

pub mod frame;
mod jacobian;

pub use frame::{Frame, Pose, classical};
pub use jacobian::{bias_acceleration, jacobian};

use core::borrow::Borrow;

use crate::algorithms::tree_pass::per_body;
use crate::effects::{Effect, base_given};
use crate::model::{LinkView, RobotModel};
use crate::scalar::{Matrix, Real};
use crate::spatial::Motion;
use crate::state::{Configuration, RobotState};

/// Poses, velocities and accelerations of all bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics<R: Real, const B: usize> {
    /// The pose of each body's own frame in the base's.
    pub poses: [Pose<R>; B],
    /// The spatial velocity of each body, in its own frame.
    pub velocities: [Motion<R>; B],
    /// The spatial acceleration of each body, in its own frame, without gravity.
    pub accelerations: [Motion<R>; B],
}

impl<R: Real, const B: usize> Kinematics<R, B> {
    /// The velocity of `body`, rad/s and m/s, in a [`Frame`]; NaN for a body that the robot does
    /// not have.
    #[cfg_attr(optimised, inline(always))]
    pub fn velocity<F: Frame>(&self, body: usize, frame: F) -> Motion<R> {
        match (self.poses.get(body), self.velocities.get(body)) {
            (Some(pose), Some(&v)) => frame.express(pose, v),
            _ => Motion::nan(),
        }
    }

    /// The spatial acceleration of `body`, rad/s² and m/s², in a [`Frame`]; NaN for a body that the
    /// robot does not have.
    #[cfg_attr(optimised, inline(always))]
    pub fn acceleration<F: Frame>(&self, body: usize, frame: F) -> Motion<R> {
        match (self.poses.get(body), self.accelerations.get(body)) {
            (Some(pose), Some(&a)) => frame.express(pose, a),
            _ => Motion::nan(),
        }
    }

    /// The classical acceleration of `body`: ω̇ and p̈ of its origin, rad/s² and m/s², without
    /// gravity, along the axes of a [`Frame`] at its reference point.
    #[cfg_attr(optimised, inline(always))]
    pub fn classical<F: Frame>(&self, body: usize, frame: F) -> Motion<R> {
        classical(self.acceleration(body, frame), self.velocity(body, frame))
    }
}

/// The pose of every body's own frame in the base's: rotation, and position in m.
///
/// # Shape
/// B.
///
/// # Cost
/// O(B): some 130 flops for each revolute joint.
///
/// # Source
/// RBDA (2008), table 2.6.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::poses, model::Robot, robots::Ur5e};
/// let [.., elbow, _, _, _] = poses(&Ur5e::MODEL, &[0.0, -1.57, 0.0, 0.0, 0.0, 0.0]);
/// assert!(elbow.pos.z > 0.5); // the upper arm points upwards
/// ```
#[doc(alias = "end effector")]
#[doc(alias = "forward kinematics")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn poses<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
) -> [Pose<R>; B]
where
    D: RobotModel<R, B, Q, V>,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    let mut poses = [Pose::IDENTITY; B];
    let mut at = per_body(robot, Pose::IDENTITY);
    for (link, pose) in robot.links().zip(&mut poses) {
        let here = at.parent(&link);
        let here = here.transformed_by(&link.xform(&trig.coordinates));
        *pose = here.in_link_frame(&link.to_joint_frame);
        at.push(here);
    }
    poses
}

/// Pose, velocity and acceleration of every body, on a base that moves as the effects specify.
///
/// `state.qdd` is read. The only effect that is included is a given motion v₀, a₀ of the base;
/// gravity is not. The results are along the present axes of the base.
///
/// # Shape
/// B.
///
/// # Cost
/// O(B): some 290 flops for each revolute joint.
///
/// # Source
/// Featherstone & Orin (2000), (3) and (4).
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::{kinematics, frame}, model::Robot, robots::Ur5e, state::State};
/// let turning = State { qd: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
/// let k = kinematics(&Ur5e::MODEL, &turning, &());
/// let (hand, p) = (k.velocity(5, frame::LocalWorldAligned), k.poses[5].pos);
/// assert!((hand.lin.x + p.y).abs() < 1e-12 && (hand.lin.y - p.x).abs() < 1e-12);
/// ```
#[doc(alias = "forward kinematics")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn kinematics<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> Kinematics<R, B>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let (turns, (v_0, a_0)) = (&trig.coordinates, base_given(effects));
    let mut v = per_body(robot, v_0);
    let mut a = per_body(robot, a_0);
    let (mut velocities, mut accelerations) = ([Motion::ZERO; B], [Motion::ZERO; B]);
    let moving = velocities.iter_mut().zip(&mut accelerations);
    for (link, (velocity, acceleration)) in robot.links().zip(moving) {
        let x = link.xform(turns);
        let v_i = link.plus_motion(x * v.parent(&link), turns, &state.qd); // (3)
        let a_i = link.plus_motion(x * a.parent(&link), turns, &state.qdd); // (4)
        let a_i = link.plus_velocity_product(a_i, turns, &state.qd, v_i);
        (*velocity, *acceleration) = (in_link_frame(&link, v_i), in_link_frame(&link, a_i));
        v.push(v_i);
        a.push(a_i);
    }
    Kinematics { poses: poses(robot, trig), velocities, accelerations }
}

/// A motion of a body from its aligned frame to its own.
#[cfg_attr(optimised, inline(always))]
pub(in crate::algorithms) fn in_link_frame<R: Real>(
    link: &LinkView<'_, R>,
    m: Motion<R>,
) -> Motion<R> {
    let frame = &link.to_joint_frame;
    Motion::new(frame.transpose_mul(m.ang), frame.transpose_mul(m.lin))
}
