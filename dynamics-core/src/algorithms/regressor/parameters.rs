//! The inertial parameters that the regressor multiplies.

use crate::effects::{Effect, body_inertia};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real};
use crate::spatial::SpatialInertia;

/// The inertial parameters φ of each body with what the effects add to it, in the body's own frame:
/// kg, kg·m, kg·m².
///
/// In the order of [`SpatialInertia::parameters`].
///
/// # Shape
/// B × 10.
///
/// # Cost
/// O(B): 105 flops for each body, for the change of frames.
///
/// # Source
/// Atkeson, An & Hollerbach (1986), (14).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{center_of_mass, inertial_parameters};
/// use dynamics_core::{model::Robot, robots::Ur5e, state::State};
/// let mass: f64 = inertial_parameters(&Ur5e::MODEL, &()).iter().map(|[mass, ..]| mass).sum();
/// let arm = center_of_mass(&Ur5e::MODEL, &State::at([0.0; 6]), &());
/// assert!((mass - arm.mass).abs() < 1e-12);
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn inertial_parameters<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    effects: &E,
) -> [[R; 10]; B]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let mut phi = [[R::ZERO; 10]; B];
    for (i, (phi, link)) in phi.iter_mut().zip(robot.links()).enumerate() {
        let (inertia, frame) = (body_inertia(effects, i, &link), &link.to_joint_frame);
        let own = SpatialInertia {
            mass: inertia.mass,
            first_moment: frame.transpose_mul(inertia.first_moment),
            rotational: frame.transpose() * inertia.rotational * *frame,
        };
        *phi = own.parameters();
    }
    phi
}
