//! The common interface of the methods of integration.
//!
//! The cost and the accuracy of each method are in `docs/accuracy.md` in the repository.

use super::{Dynamics, StepIncrement};
use crate::algorithms::NotPositiveDefinite;
use crate::scalar::Real;
use crate::state::State;

/// The mean rates of a step, or the joint that moves no inertia.
pub type Step<R, const V: usize> = Result<StepIncrement<R, V>, NotPositiveDefinite>;

/// A method of integration in time.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// use dynamics_core::sim::{ModelDynamics, Euler, Integrator};
/// let arm = ModelDynamics { robot: &Ur5e::MODEL, tau: [0.0; 6], effects: &RIGID_BODY };
/// let mut falling = State::at([0.0, -1.5, 0.0, 0.0, 0.0, 0.0]);
/// Euler::start(&arm, &falling).advance(&arm, &mut falling, 1e-3)?;
/// assert!(falling.qd[1] != 0.0);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
pub trait Integrator<R: Real, const Q: usize, const V: usize>: Default {
    /// The integrator of a motion that starts from this state.
    fn start(_robot: &impl Dynamics<R, Q, V>, _at: &State<R, Q, V>) -> Self {
        Self::default()
    }

    /// The mean rates of a step of h seconds, which is not 0; `at.qdd` is not read.
    ///
    /// # Errors
    /// As forward dynamics.
    fn step(&self, robot: &impl Dynamics<R, Q, V>, at: &State<R, Q, V>, h: R) -> Step<R, V>;

    /// Takes the step; `state.qdd` is left at the acceleration used.
    ///
    /// # Errors
    /// As forward dynamics; the state is then left as it was.
    fn advance(
        &self,
        robot: &impl Dynamics<R, Q, V>,
        state: &mut State<R, Q, V>,
        h: R,
    ) -> Result<(), NotPositiveDefinite> {
        *state = self.step(robot, state, h)?.end(robot, state, h);
        Ok(())
    }
}
