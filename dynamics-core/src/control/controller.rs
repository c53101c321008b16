//! A whole control loop but for the law and the devices: observer, supervisor, clock, and what happens on a fault.
//!
//! In this order a tick goes: [`MotionController::observe`] judges the measurement and updates the estimate,
//! [`ObservedTick::reference`] says what the joints are to follow, the caller's law computes torques, and
//! [`ReferencedTick::command`] limits them. [`MotionController::tick`] does all four with the law as a closure.
//!
//! | a fault lasts | reference | estimate |
//! |---|---|---|
//! | up to `ride_through_ticks` | the trajectory, as if nothing had happened | predicted with the reference's acceleration |
//! | `hold_ticks` more | [`hold`](super::hold()): q̈ = −λ q̇ where the arm is; the trajectory's clock stands still | predicted |
//! | longer | the same, with zero torque on the brake, latched | as measured |
//!
//! Afterwards a reference of its own leads back onto the trajectory ([`ResumeTrajectory`]). The reasons, with
//! figures, are in `docs/decisions/0003-faults.md` of the repository.

use core::marker::PhantomData;

use super::{
    Command, ConfigError, Estimate, Fault, Mode, Observer, Reference, ResumeTrajectory, Supervisor,
};
use crate::scalar::Real;
use crate::state::State;

mod age;
mod config;
mod recovery;
mod reset;
#[cfg(test)]
mod tests;
mod tick;

pub use age::{CurrentTick, MeasurementAge, PreviousTick};
pub use config::MotionControllerConfig;
pub use reset::ResetError;
pub use tick::{ObservedTick, ReferencedTick};

/// The controller of a robot's motion: all that a control loop keeps from tick to tick, and what it does on a fault.
///
/// It knows no devices and no model: positions come in, torques go out, and the law in between is the caller's. `A` is
/// the age of the measurements: [`PreviousTick`] for encoders that answer with the angle of the tick before,
/// [`CurrentTick`] for those of this tick.
///
/// ```
/// use dynamics_core::control::*;
/// use dynamics_core::state::State;
///
/// let mut controller = MotionController::<f32, 1>::try_new(MotionControllerConfig {
///     supervisor: SupervisorConfig {
///         limits: SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
///         tick: 1e-3,
///         resolution: 0.0,
///         ride_through_ticks: 5,
///         hold_ticks: 100,
///         reentry_ticks: 200,
///     },
///     observer_bandwidth: 250.0,
///     decay_rate: 25.0,
///     restart_distance: 0.15,
/// })?;
/// let points = [
///     WayPoint { q: [0.0], qd: [0.0], ticks: 0 },
///     WayPoint { q: [0.5], qd: [0.0], ticks: 1000 },
/// ];
/// let trajectory = Trajectory::new(&points, 1e-3, &[MotionLimits { velocity: 3.0, acceleration: 10.0 }])?;
///
/// // A joint of 2 kg·m².
/// let law = |reference: &State<f32, 1, 1>, _: &Estimate<f32, 1>| reference.qdd.map(|qdd| 2.0 * qdd);
/// let command = controller.tick(Ok(&[0.0]), &trajectory, law);
/// assert_eq!((command.torque, command.brake), ([0.0], false));
/// let command = controller.tick(Err(Fault::Stale), &trajectory, law);
/// assert_eq!((command.status.mode, command.status.fault), (Mode::Full, Some(Fault::Stale)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "control loop")]
#[doc(alias = "motion control")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionController<R, const V: usize, A = PreviousTick> {
    observer: Observer<R, V>,
    supervisor: Supervisor<R, V>,
    resume: ResumeTrajectory<R, V>,
    /// What the joints follow; its acceleration acts until the next tick.
    reference: State<R, V, V>,
    restart_distance: R,
    /// The trajectory's tick, which stands still during a fault.
    clock: u32,
    /// The estimate has gone without a measurement for longer than is ridden through.
    dead_reckoning: bool,
    age: PhantomData<A>,
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// A controller at the start of the trajectory, of an arm that holds itself.
    ///
    /// The first tick should follow within a tick's time, or the arm stand still till then.
    ///
    /// # Errors
    /// [`ConfigError`]: of [`MotionControllerConfig::check`].
    pub fn try_new(config: MotionControllerConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self::new(config))
    }

    /// The same without a check, for configurations that are constants.
    ///
    /// With limits that allow nothing the arm stays stopped, see [`Supervisor::new`].
    pub fn new(config: MotionControllerConfig<R, V>) -> Self {
        Self {
            observer: Observer::new(config.observer()),
            supervisor: Supervisor::new(config.supervisor),
            resume: ResumeTrajectory::new(config.resume()),
            reference: State::at([R::ZERO; V]),
            restart_distance: config.restart_distance,
            clock: 0,
            dead_reckoning: false,
            age: PhantomData,
        }
    }

    /// Runs one tick: from the measured positions (rad, m), or why there are none, to what goes to the drives.
    ///
    /// `law` is called once, in every mode: from what the joints are to follow and where they are to torques (N·m, N).
    /// Its feed-forward has to bring the reference's acceleration about; for one that does not, see
    /// [`ReferencedTick::without_inertia`].
    ///
    /// # Cost
    /// 25 flops a joint beside the trajectory's and the law's, the same instructions whatever the data; more on a fault
    /// and on the return after it.
    #[inline]
    pub fn tick<T: Reference<R, V>>(
        &mut self,
        measured: Result<&[R; V], Fault>,
        trajectory: &T,
        law: impl FnOnce(&State<R, V, V>, &Estimate<R, V>) -> [R; V],
    ) -> Command<R, V> {
        let tick = self.observe(measured).reference(trajectory);
        let tau = law(tick.reference(), tick.estimate());
        tick.command(&tau)
    }

    /// Starts a tick: judges the measured positions (rad, m), or why there are none, and updates the estimate.
    ///
    /// The first of the three steps of [`Self::tick`], for loops that do something in between. A tick that is begun and
    /// gets no command is [`Fault::Unfinished`] in the next one.
    ///
    /// ```compile_fail
    /// # #![deny(unused_must_use)]
    /// # use dynamics_core::control::{MotionController, Reference};
    /// fn tick(controller: &mut MotionController<f32, 1>, trajectory: &impl Reference<f32, 1>) {
    ///     controller.observe(Ok(&[0.0])).reference(trajectory); // and the command?
    /// }
    /// ```
    #[inline]
    pub fn observe(&mut self, measured: Result<&[R; V], Fault>) -> ObservedTick<'_, R, V, A> {
        self.supervisor.accept_measurement(measured);
        let stopped = matches!(self.supervisor.mode(), Mode::Stopped);
        let usual = self.supervisor.measurement_accepted() & !self.dead_reckoning & !stopped;
        match measured {
            Ok(q) if usual => A::correct(&mut self.observer, q, &self.reference.qdd),
            _ => self.predict_estimate(measured),
        }
        self.supervisor.check_speed(&self.observer.estimate().qd);
        ObservedTick::new(self)
    }

    /// Counts so many ticks that have passed without a call, as a timer has counted them.
    ///
    /// Before the next tick: the estimate goes on, the joints may have moved, and so may the trajectory, unless the arm is
    /// held or on its return. What exceeds the ticks that a fault may last is not predicted.
    ///
    /// # Cost
    /// A prediction and a point of the trajectory for each tick missed.
    #[cold]
    pub fn missed<T: Reference<R, V>>(&mut self, ticks: u32, trajectory: &T) {
        self.supervisor.missed(ticks);
        let follows = matches!(self.supervisor.mode(), Mode::Full) & !self.resume.active();
        for _ in 0..ticks.min(self.supervisor.longest_fault()) {
            self.observer.predict(&self.reference.qdd);
            if follows {
                self.reference = trajectory.at(self.clock);
                self.clock = self.clock.saturating_add(1);
            }
        }
    }

    /// Stops the arm for a reason found outside, as a drive that fails or an emergency stop, from the next tick on.
    ///
    /// Latched until [`Self::reset`]; the first reason stays. A stop that is still demanded after a reset is to be called
    /// again, every tick. [`ReferencedTick::stop`] acts in the present tick.
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        self.supervisor.stop(fault);
    }

    /// What the joints were to follow in the last tick.
    #[inline(always)]
    pub fn reference(&self) -> &State<R, V, V> {
        &self.reference
    }

    /// Where the joints are and how fast, as the observer has it.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        self.observer.estimate()
    }

    /// What the arm did in the last tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.supervisor.mode()
    }

    /// The trajectory's tick that comes next; it stands still while the arm is held or returns.
    #[inline(always)]
    pub fn trajectory_tick(&self) -> u32 {
        self.clock
    }
}
