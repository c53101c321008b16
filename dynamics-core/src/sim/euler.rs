//! Time steps of first order: one acceleration, that of the step's beginning.

use super::step_increment::add_scaled;
use super::{Dynamics, Integrator, ModelDynamics, Step, StepIncrement};
use crate::algorithms::NotPositiveDefinite;
use crate::effects::Effect;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::State;

/// Explicit Euler: q̇ and q̈ of the step's beginning. First order; gains energy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Euler;

impl<R: Real, const Q: usize, const V: usize> Integrator<R, Q, V> for Euler {
    #[cfg_attr(optimised, inline(always))]
    fn step(&self, robot: &impl Dynamics<R, Q, V>, at: &State<R, Q, V>, _h: R) -> Step<R, V> {
        Ok(StepIncrement::constant(at.qd, robot.acceleration(at)?))
    }
}

/// Semi-implicit Euler: q advances with the new q̇. First order. The energy oscillates without
/// drift only where M does not depend on q; elsewhere the step is not symplectic, and the energy
/// drifts: at steps of 1 ms a double pendulum without friction that starts at (0.5, −0.3) rad has
/// 1.24 times its energy after 256 s, and one that starts at (2.5, 1) rad has lost half of it after
/// 64 s. [`LinearlyImplicit`](super::LinearlyImplicit) and [`RungeKutta`](super::RungeKutta) are
/// for long motions without friction.
#[derive(Clone, Copy, Debug, Default)]
pub struct SemiImplicit;

impl<R: Real, const Q: usize, const V: usize> Integrator<R, Q, V> for SemiImplicit {
    #[cfg_attr(optimised, inline(always))]
    fn step(&self, robot: &impl Dynamics<R, Q, V>, at: &State<R, Q, V>, h: R) -> Step<R, V> {
        let qdd = robot.acceleration(at)?;
        Ok(StepIncrement::constant(add_scaled(at.qd, h, &qdd), qdd))
    }
}

/// One step of `h` seconds by semi-implicit Euler: q̇ ← q̇ + h FD(q, q̇, τ), then q ← q ⊕ h q̇ with
/// the new q̇. First order in h, and its energy drifts ([`SemiImplicit`]); `state.qdd` is left at
/// the acceleration used. The internal states of effects are not advanced;
/// [`linearly_implicit`](super::linearly_implicit()) advances them.
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
/// As [`aba`](crate::algorithms::aba()); the state is then left as it was.
pub fn semi_implicit<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &mut State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let tau = *tau;
    SemiImplicit.advance(&ModelDynamics { robot, tau, effects }, state, h)
}
