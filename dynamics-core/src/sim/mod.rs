//! Time steps of a simulated robot, and its actuators.
//!
//! [`semi_implicit`] and [`linearly_implicit`] step any robot; [`Integrator`]s those whose coordinates add up.

mod actuator;
mod conserving;
mod integrators;
mod linearly_implicit;
mod runge_kutta;
mod mechanics;
mod summed;

pub use actuator::Actuator;
pub use conserving::conserving;
pub use integrators::{
    EnergyKept, Euler, ImplicitDamping, Increments, Integrator, RungeKutta, SemiImplicit,
};
pub use linearly_implicit::linearly_implicit;
pub use runge_kutta::runge_kutta;
pub use mechanics::{Described, Mechanics};
pub use summed::Summed;

use crate::algorithms::{NotPositiveDefinite, aba};
use crate::configuration::integrate;
use crate::effects::Effect;
use crate::model::Description;
use crate::scalar::Real;
use crate::state::State;

/// One step of `h` seconds by semi-implicit (symplectic) Euler: q̇ ← q̇ + h FD(q, q̇, τ), then
/// q ← q ⊕ h q̇ with the new q̇. First order in h; `state.qdd` is left at the acceleration used. What effects
/// remember stays as it is: [`linearly_implicit`] moves it on.
///
/// Hairer, Lubich & Wanner, *Geometric Numerical Integration* (2006), section I.1.2.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, sim::semi_implicit, state::State};
/// let mut arm = State::at([0.0_f64, -1.5, 0.0, 0.0, 0.0, 0.0]);
/// semi_implicit(&Ur5e::MODEL, &mut arm, &[0.0; 6], &RIGID_BODY, 1e-3)?;
/// assert!(arm.qd[1] != 0.0);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`aba`]; the state is then left as it was.
pub fn semi_implicit<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &mut State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    D: Description<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    state.qdd = aba(robot, state, tau, effects)?;
    for (qd, &qdd) in state.qd.iter_mut().zip(&state.qdd) {
        *qd += h * qdd;
    }
    state.q = integrate(robot, &state.q, &state.qd.map(|qd| h * qd));
    Ok(())
}
