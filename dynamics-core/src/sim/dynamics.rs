//! The dynamics of a robot, as an integrator uses them.

use super::StepIncrement;
use super::step_increment::add_scaled;
use crate::algorithms::{NotPositiveDefinite, aba, kinetic_energy, potential_energy};
use crate::effects::{AtMeanVelocity, Declared, Effect, Implicit};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{JointTrig, State};

/// A robot under given torques and effects, for an [`Integrator`](super::Integrator).
pub trait Dynamics<R, const Q: usize, const V: usize> {
    /// q̈ of q and q̇.
    ///
    /// # Errors
    /// As forward dynamics.
    fn acceleration(&self, at: &State<R, Q, V>) -> Result<[R; V], NotPositiveDefinite>;

    /// q̈ of a linearly implicit step of h seconds: [`Implicit`]; `at.qdd` may be used as that of
    /// the step before.
    ///
    /// # Errors
    /// As forward dynamics.
    fn implicit_acceleration(
        &self,
        at: &State<R, Q, V>,
        h: R,
    ) -> Result<[R; V], NotPositiveDefinite>;

    /// Kinetic and potential energy, J.
    fn energies(&self, at: &State<R, Q, V>) -> (R, R);

    /// The configuration after h seconds at these rates: [`StepIncrement::configuration_after`].
    fn configuration_after(&self, q: &[R; Q], at: &StepIncrement<R, V>, h: R) -> [R; Q];
}

impl<R: Real, const V: usize> StepIncrement<R, V> {
    /// State after h seconds; its q̈ is the step's mean.
    #[cfg_attr(optimised, inline(always))]
    pub fn end<const Q: usize>(
        &self,
        mechanics: &impl Dynamics<R, Q, V>,
        from: &State<R, Q, V>,
        h: R,
    ) -> State<R, Q, V> {
        State {
            q: mechanics.configuration_after(&from.q, self, h),
            qd: add_scaled(from.qd, h, &self.qdd),
            qdd: self.qdd,
        }
    }
}

/// A robot by its description, under constant torques.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// use dynamics_core::sim::{ModelDynamics, Dynamics};
/// let arm = ModelDynamics { robot: &Ur5e::MODEL, tau: [0.0; 6], effects: &RIGID_BODY };
/// assert!(arm.acceleration(&State::at([0.0; 6]))?[1] > 1.0); // falls
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ModelDynamics<'a, D, E, R, const B: usize, const V: usize> {
    /// The robot.
    pub robot: &'a D,
    /// Torques of its motors, N·m or N.
    pub tau: [R; V],
    /// The effects that act on it.
    pub effects: &'a E,
}

impl<R: Real, D, E, const B: usize, const Q: usize, const V: usize> Dynamics<R, Q, V>
    for ModelDynamics<'_, D, E, R, B, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    fn acceleration(&self, at: &State<R, Q, V>) -> Result<[R; V], NotPositiveDefinite> {
        aba(self.robot, at, &self.tau, self.effects)
    }

    fn implicit_acceleration(
        &self,
        at: &State<R, Q, V>,
        h: R,
    ) -> Result<[R; V], NotPositiveDefinite> {
        let effects = Implicit::under(self.robot, at, self.effects, &self.tau, h);
        // Friction that depends on the load knows no other velocity than that of the bodies.
        if const { E::LOAD_DEPENDENT } {
            return aba(self.robot, at, &self.tau, &effects);
        }
        let half = R::from_f64(0.5) * h;
        let mean = State { qd: add_scaled(at.qd, half, &at.qdd), ..*at };
        let effects = AtMeanVelocity::new(&effects, at.qd);
        aba(self.robot, &mean, &self.tau, &effects)
    }

    fn energies(&self, at: &State<R, Q, V>) -> (R, R) {
        let trig = JointTrig::new(self.robot, &at.q);
        (
            kinetic_energy(self.robot, trig.with(at), self.effects),
            potential_energy(self.robot, &trig, self.effects),
        )
    }

    fn configuration_after(&self, q: &[R; Q], at: &StepIncrement<R, V>, h: R) -> [R; Q] {
        at.configuration_after(self.robot, q, h)
    }
}
