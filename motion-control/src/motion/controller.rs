//! A control loop without its control law and devices: observer, supervisor, clock and the reaction to faults.
//!
//! A tick has four steps: [`MotionController::observe`] checks the measurement and updates the estimate,
//! [`ObservedTick::reference`] gives the reference of the joints, the caller's law computes torques, and
//! [`ReferencedTick::command`] limits them. [`MotionController::tick`] does all four with the law as a closure.
//!
//! | a fault lasts | reference | estimate |
//! |---|---|---|
//! | up to `ride_through_ticks` | the trajectory, as if nothing had happened | predicted with the reference's acceleration |
//! | `hold_ticks` more | [`hold`](crate::hold()): q̈ = −λ q̇ where the arm is; the trajectory's clock stands still | predicted |
//! | longer | the same, with zero torque on the brake, latched | as measured |
//!
//! After the fault a separate reference leads back onto the trajectory ([`ResumeTrajectory`]). The reasons, with
//! figures, are in `docs/decisions/0003-faults.md` of the repository.

use core::marker::PhantomData;

use crate::estimate::{Estimate, Observer};
use crate::limits::{Command, ConfigError, Fault, Mode};
use crate::motion::ResumeTrajectory;
use crate::reference::Reference;
use crate::safety::Supervisor;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

mod advice;
mod age;
mod config;
mod recovery;
mod reset;
mod stop;
#[cfg(test)]
mod tests;
mod tick;

pub use age::{CurrentTick, MeasurementAge, PreviousTick};
pub use config::MotionControllerConfig;
pub use reset::ResetError;
pub use tick::{ObservedTick, ReferencedTick};

/// The controller of a robot's motion: the state of a control loop, and its reaction to faults.
///
/// It is independent of devices and of the model: its inputs are positions, its outputs torques, and the caller
/// supplies the control law. `A` is the age of the measurements: [`PreviousTick`] for encoders that answer with the
/// angle of the tick before, [`CurrentTick`] for those of this tick.
///
/// ```
/// use motion_control::*;
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
    pub(crate) observer: Observer<R, V>,
    pub(crate) supervisor: Supervisor<R, V>,
    resume: ResumeTrajectory<R, V>,
    /// The reference of the joints; its acceleration acts until the next tick.
    reference: State<R, V, V>,
    restart_distance: R,
    /// The tick of the trajectory, which does not advance during a fault.
    pub(crate) clock: u32,
    /// Whether the estimate has been without a measurement for longer than the ride-through.
    dead_reckoning: bool,
    /// The reference stands still: category 2.
    standing: bool,
    age: PhantomData<A>,
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// A controller at the start of the trajectory, for an arm that holds its position there.
    ///
    /// The first tick should follow within one tick, or the arm must stand still until then. For an arm on its brake, or
    /// at a position that is not known yet, use [`Self::on_brake`].
    ///
    /// # Errors
    /// [`ConfigError`], as [`MotionControllerConfig::check`].
    pub fn try_new(config: MotionControllerConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self::new(config))
    }

    /// As [`Self::try_new`], without the check: for constant configurations.
    ///
    /// If a limit allows no motion or torque, the arm stays stopped: see [`Supervisor::new`].
    pub fn new(config: MotionControllerConfig<R, V>) -> Self {
        Self {
            observer: Observer::new(config.observer()),
            supervisor: Supervisor::new(config.supervisor),
            resume: ResumeTrajectory::new(config.resume()),
            reference: State::at([R::ZERO; V]),
            restart_distance: config.restart_distance,
            clock: 0,
            dead_reckoning: false,
            standing: false,
            age: PhantomData,
        }
    }

    /// The same controller for an arm that is on its brake when the firmware starts.
    ///
    /// It is stopped without a fault: its commands have zero torque and the brake set until [`Self::reset`], which
    /// compares the measured position with the first point of the trajectory.
    ///
    /// ```
    /// use motion_control::{Mode, MotionController, MotionControllerConfig, ResetError};
    /// # use motion_control::{SafetyLimits, SupervisorConfig, MotionLimits, Trajectory, WayPoint};
    /// # let config = MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits: SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
    /// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
    /// # };
    /// # let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
    /// # let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }];
    /// # let trajectory = Trajectory::new(&[point(0.0, 0), point(0.5, 1000)], 1e-3, &limits)?;
    /// let mut controller = MotionController::<f32, 1>::try_new(config)?.on_brake();
    /// assert_eq!(controller.reset(&trajectory), Err(ResetError::NoMeasurement));
    /// let command = controller.tick(Ok(&[0.4]), &trajectory, |_, _| [1.0]);
    /// assert_eq!((command.torque, command.brake), ([0.0], true));
    /// // The trajectory starts at zero: [`MotionController::approach`] plans the way there.
    /// assert_eq!(controller.reset(&trajectory), Err(ResetError::TooFar { joint: 0 }));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[doc(alias = "power-up")]
    #[doc(alias = "start-up")]
    #[must_use]
    pub fn on_brake(mut self) -> Self {
        self.supervisor = self.supervisor.on_brake();
        self
    }

    /// Runs one tick: from the measured positions (rad, m), or the fault that prevented them, to the command to the
    /// drives.
    ///
    /// `law` is called once, in every mode; it computes torques (N·m, N) from the reference and the estimate of the
    /// joints. Its feed-forward must produce the acceleration of the reference; for a law without inertia, see
    /// [`ReferencedTick::without_inertia`].
    ///
    /// # Cost
    /// 25 flops per joint in addition to the trajectory and the law, with the same instructions for all data; more
    /// during a fault and the return after it.
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

    /// Starts a tick: checks the measured positions (rad, m), or accepts the fault that prevented them, and updates the
    /// estimate.
    ///
    /// The first of the three steps of [`Self::tick`], for loops that do other work between them. A tick that ends
    /// without a command is [`Fault::Unfinished`] in the next one.
    ///
    /// ```compile_fail
    /// # #![deny(unused_must_use)]
    /// # use motion_control::{MotionController, Reference};
    /// fn tick(controller: &mut MotionController<f32, 1>, trajectory: &impl Reference<f32, 1>) {
    ///     controller.observe(Ok(&[0.0])).reference(trajectory); // and the command?
    /// }
    /// ```
    #[inline]
    pub fn observe(&mut self, measured: Result<&[R; V], Fault>) -> ObservedTick<'_, R, V, A> {
        match measured {
            Ok(q) => self.observe_positions(q),
            Err(fault) => self.observe_fault(fault),
        }
        ObservedTick::new(self)
    }

    #[inline(always)]
    fn observe_positions(&mut self, q: &[R; V]) {
        self.supervisor.accept_positions(q);
        let stopped = matches!(self.supervisor.mode(), Mode::Stopped);
        if !self.supervisor.measurement_accepted() | self.dead_reckoning | stopped {
            self.observe_otherwise(Ok(q));
            return;
        }
        A::correct(&mut self.observer, q, &self.reference.qdd);
        self.supervisor.check_speed(&self.observer.estimate().qd);
    }

    #[cold]
    fn observe_fault(&mut self, fault: Fault) {
        self.supervisor.accept_fault(fault);
        self.observe_otherwise(Err(fault));
    }

    /// A tick during or after a fault: in a function of its own, so that the usual one has no case for it.
    #[cold]
    #[inline(never)]
    fn observe_otherwise(&mut self, measured: Result<&[R; V], Fault>) {
        self.predict_estimate(measured);
        self.supervisor.check_speed(&self.observer.estimate().qd);
    }

    /// Reports ticks that have passed without a call, as counted by a timer.
    ///
    /// Call it before the next tick. The estimate is extrapolated, the plausible range of positions grows, and the
    /// trajectory advances, unless the arm is held or returns. Ticks beyond the longest tolerated fault are not
    /// predicted: more of them stop the arm by [`Fault::Missed`], since its drives have applied an old torque for as
    /// long.
    ///
    /// # Cost
    /// One prediction and one point of the trajectory per missed tick.
    #[cold]
    pub fn missed<T: Reference<R, V>>(&mut self, ticks: u32, trajectory: &T) {
        self.supervisor.missed(ticks);
        let follows = matches!(self.supervisor.mode(), Mode::Full) & !self.resume.active();
        if ticks > self.supervisor.longest_fault() {
            self.supervisor.stop(Fault::Missed);
        }
        for _ in 0..ticks.min(self.supervisor.longest_fault()) {
            self.observer.predict(&self.reference.qdd);
            if follows {
                self.reference = trajectory.at(self.clock);
                self.clock = self.clock.saturating_add(1);
            }
        }
    }

    /// The reference of the joints in the last tick.
    #[inline(always)]
    pub fn reference(&self) -> &State<R, V, V> {
        &self.reference
    }

    /// The estimated positions and velocities of the joints.
    #[inline(always)]
    pub fn estimate(&self) -> &Estimate<R, V> {
        self.observer.estimate()
    }

    /// The mode of the arm in the last tick.
    #[inline(always)]
    pub fn mode(&self) -> Mode {
        self.supervisor.mode()
    }

    /// The next tick of the trajectory; it does not advance while the arm is held or returns.
    #[inline(always)]
    pub fn trajectory_tick(&self) -> u32 {
        self.clock
    }
}
