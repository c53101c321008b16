//! The wrenches in joints: the f_i of inverse dynamics, which RBDA has in table 5.1.

use core::borrow::Borrow;

use super::rnea::rnea;
use crate::effects::{Effect, Scene};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real};
use crate::spatial::Force;
use crate::state::{Configuration, RobotState};

/// The torques of motors, and the wrenches in the joints of N bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorquesAndWrenches<R: Real, const V: usize, const N: usize> {
    /// The torque τ of each motor, N·m or N.
    pub tau: [R; V],
    /// The wrench fᵢ that the parent exerts on each body through its joint, N·m and N, in the
    /// body's own frame and about its origin.
    pub wrenches: [Force<R>; N],
}

/// The torque of each motor, N·m or N, and the wrench fᵢ in the joint of each body, N·m and N,
/// under the effects of the scene.
///
/// fᵢ is what the parent exerts on body i and all that it carries; friction and armatures of the
/// joint itself are within the parent and not in it. A fixed joint has one, too: that of a body
/// beyond a force sensor is the prediction of what the sensor measures. About another point or in
/// other axes it is `x.transpose_mul(f)` or `x * f` by an [`Xform`](crate::spatial::Xform).
///
/// ```text
/// f_i = I_i a_i + v_i ×* I_i v_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ f_j
/// ```
///
/// # Shape
/// V, and B wrenches in the order of the bodies.
///
/// # Cost
/// That of [`rnea`](crate::algorithms::rnea()) in its plain form. Of some bodies alone
/// [`Engine::rnea_and_wrenches`](crate::Engine::rnea_and_wrenches) costs less.
///
/// # Source
/// Featherstone & Orin (2000), (5) to (7); RBDA (2008), table 5.1.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::rnea_and_wrenches, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let all = rnea_and_wrenches(&Ur5e::MODEL, &State::at([0.0_f64; 6]), &RIGID_BODY);
/// // The shoulder carries the weight of the whole arm.
/// let mass: f64 = Ur5e::MODEL.links.iter().map(|link| link.inertia.mass).sum();
/// assert!((all.wrenches[0].lin.length() - mass * 9.81).abs() < 1e-11);
/// ```
#[doc(alias = "reaction wrench")]
#[doc(alias = "force sensor")]
#[must_use]
pub fn rnea_and_wrenches<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> TorquesAndWrenches<R, V, B>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let trig = state.configuration().trig_of(robot);
    let mut wrenches = [Force::ZERO; B];
    let tau = rnea(robot, trig.borrow(), state.state(), effects, |body, f| {
        if let (Some(wrench), Some(link)) = (wrenches.get_mut(body), robot.link(body)) {
            let rot = link.to_joint_frame;
            *wrench = Force::new(rot.transpose_mul(f.ang), rot.transpose_mul(f.lin));
        }
    });
    TorquesAndWrenches { tau, wrenches }
}
