//! A time step that conserves the momentum of a robot that floats freely.

use super::linearly_implicit;
use crate::algorithms::{NotPositiveDefinite, base_velocity_from_momentum};
use crate::effects::Effect;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::State;

/// One step of `h` seconds as [`linearly_implicit()`], after which the rates of the first body's
/// free joint are set so that all bodies together have the given momentum, about the base's origin
/// and along its axes.
///
/// For a robot that floats freely: no external force acts on it, and every body is a descendant of
/// the first. The plain step has a momentum error of first order in h, which accumulates; here the
/// error is that of rounding and does not accumulate. First order in h in everything else. Cost:
/// that of [`base_velocity_from_momentum`] in addition.
///
/// Hairer, Lubich & Wanner, *Geometric Numerical Integration* (2006), section IV.4: projection onto
/// an invariant.
///
/// ```
/// use dynamics_core::algorithms::momentum;
/// use dynamics_core::model::{BASE, Body, Joint, Model};
/// use dynamics_core::{state::manifold::neutral, effects::{Coriolis, Inertia}, sim::momentum_preserving, spatial::Force, state::State};
/// let boom = |name, parent, joint| Body::new(name, parent, joint).mass(2.0).com([0.5, 0.0, 0.0]).inertia([0.1, 0.0, 0.0, 0.3, 0.0, 0.3]);
/// let pair: Model<f64, 2, 8, 7> = Model::new("pair", [
///     boom("satellite", BASE, Joint::free()), boom("arm", 0, Joint::revolute([0.0, 1.0, 0.0])).xyz([1.0, 0.0, 0.0]),
/// ]);
/// let (mut state, mut scene) = (State::at(neutral(&pair)), (Inertia, Coriolis));
/// for _ in 0..1000 {
///     momentum_preserving(&pair, &mut state, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3], &mut scene, Force::ZERO, 1e-3)?;
/// }
/// let h = momentum(&pair, &state, &());
/// assert!(state.qd[6] > 0.1 && h.ang.length() + h.lin.length() < 1e-14);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`linearly_implicit()`].
pub fn momentum_preserving<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &mut State<R, Q, V>,
    tau: &[R; V],
    effects: &mut E,
    momentum: Force<R>,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    linearly_implicit(robot, state, tau, effects, h)?;
    state.qd = base_velocity_from_momentum(robot, &*state, momentum, effects)?;
    Ok(())
}
