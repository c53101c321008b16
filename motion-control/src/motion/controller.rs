//! A control loop without its control law and devices: observer, supervisor, clock and the reaction
//! to faults.
//!
//! A tick has four steps: [`MotionController::observe`] checks the measurement and updates the
//! estimate, [`ObservedTick::reference`](crate::motion::ObservedTick::reference) gives the
//! reference of the joints, the caller's law computes torques, and
//! [`ReferencedTick::command`](crate::motion::ReferencedTick::command) limits them.
//! [`MotionController::tick`] does all four with the law as a closure.
//!
//! | a fault lasts | reference | estimate |
//! |---|---|---|
//! | up to `ride_through_ticks` | the trajectory, as if nothing had happened | predicted with the reference's acceleration |
//! | `hold_ticks` more | [`hold`](crate::motion::hold()): q̈ = −λ q̇ where the arm is; the trajectory's clock stands still | predicted |
//! | longer | the same, with zero torque on the brake, latched | as measured |
//!
//! After the fault a separate reference leads back onto the trajectory (`resume.rs`). The reasons,
//! with figures, are in `docs/decisions/0003-faults.md` of the repository.

use core::fmt;
use core::marker::PhantomData;

use crate::estimate::{Estimate, Observer};
use crate::limits::{Circles, ConfigError, Fault, Mode, SafetyLimits};
use crate::motion::hold;
use crate::motion::resume::ResumeTrajectory;
use crate::reference::Reference;
use crate::safety::supervisor::Supervisor;
use crate::safety::{StopCategory, ThermalLimit};
use dynamics_core::scalar::Real;
use dynamics_core::state::{State, all_finite};

pub(crate) mod circles;
pub(crate) mod config;
#[cfg(test)]
mod tests;
pub(crate) mod tick;

use config::MotionControllerConfig;

mod sealed {
    pub trait Sealed {}
}

/// The age of the measurements of a [`MotionController`], a property of the encoders, as a type;
/// [`OnCircles`](crate::motion::OnCircles) of it is that of a controller with joints that are
/// circles.
pub trait MeasurementAge: sealed::Sealed {
    /// The joints whose positions are points on a circle.
    #[doc(hidden)]
    const CIRCLES: Circles = Circles::NONE;

    /// Whether there are any: a constant, so that the branches of lines are not even compiled.
    #[doc(hidden)]
    const ON_CIRCLES: bool = Self::CIRCLES.any();

    /// Updates the estimate by positions that were accepted.
    #[doc(hidden)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]);

    /// Replaces the estimated positions after ticks without measurements.
    #[doc(hidden)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]);
}

/// The positions are those of the previous tick: for encoders that latch at the end of a frame and
/// send in the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreviousTick;

/// The positions are those of the tick in which they arrive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurrentTick;

impl sealed::Sealed for PreviousTick {}
impl sealed::Sealed for CurrentTick {}

impl MeasurementAge for PreviousTick {
    #[inline(always)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]) {
        observer.update_delayed(q, qdd);
    }

    #[inline(always)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]) {
        observer.correct_position_delayed(q);
    }
}

impl MeasurementAge for CurrentTick {
    #[inline(always)]
    fn correct<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V], qdd: &[R; V]) {
        observer.update(q, qdd);
    }

    #[inline(always)]
    fn correct_position<R: Real, const V: usize>(observer: &mut Observer<R, V>, q: &[R; V]) {
        observer.correct_position(q);
    }
}

/// The reason why a stopped arm is not restarted. Joints are numbered from 0.
///
/// ```
/// use motion_control::motion::ResetError;
/// assert_eq!(ResetError::TooFar { joint: 2 }.to_string(), "joint 2: it is too far from its reference");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ResetError {
    /// The arm is not stopped, nor held by a stop of category 2.
    NotStopped,
    /// There was no measurement in the last tick.
    NoMeasurement,
    /// There is a contact, or there was one too recently: see
    /// [`ContactReaction`](crate::motion::ContactReaction).
    Contact,
    /// The joint is outside its bounds: [`BackOff`](crate::motion::BackOff) leads it back, or a
    /// person moves it.
    OutOfBounds {
        /// The joint.
        joint: usize,
    },
    /// A joint is further than the restart distance from the point at which its trajectory
    /// continues.
    TooFar {
        /// The joint.
        joint: usize,
    },
}

impl fmt::Display for ResetError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotStopped => out.write_str("the arm is not stopped"),
            Self::NoMeasurement => out.write_str("there was no measurement in the last tick"),
            Self::Contact => out.write_str("there is a contact, or there was one too recently"),
            Self::OutOfBounds { joint } => write!(out, "joint {joint}: it is outside its bounds"),
            Self::TooFar { joint } => {
                write!(out, "joint {joint}: it is too far from its reference")
            }
        }
    }
}

impl core::error::Error for ResetError {}

/// The controller of a robot's motion: the state of a control loop, and its reaction to faults.
///
/// It is independent of devices and of the model: its inputs are positions, its outputs torques,
/// and the caller supplies the control law. `A` is the age of the measurements: [`PreviousTick`]
/// for encoders that answer with the angle of the tick before, [`CurrentTick`] for those of this
/// tick.
///
/// ```
/// use motion_control::{estimate::*, limits::*, motion::*, reference::*, safety::*};
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
    /// The first tick should follow within one tick, or the arm must stand still until then. For an
    /// arm on its brake, or at a position that is not known yet, use [`Self::on_brake`].
    ///
    /// # Errors
    /// [`ConfigError`], as [`MotionControllerConfig::check`], and as [`Circles::check`] for joints
    /// that are circles.
    pub fn try_new(config: MotionControllerConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        A::CIRCLES.check(&config.supervisor.limits)?;
        Ok(Self::new(config))
    }

    /// As [`Self::try_new`], without the check: for constant configurations.
    ///
    /// If a limit allows no motion or torque
    /// ([`SafetyLimits::check`](crate::limits::SafetyLimits::check)), or counts the turns of a
    /// circle ([`Circles::check`]), the arm is stopped by [`Fault::Limits`], and a reset does not
    /// restart it. If the tick is not a positive number, no step of the joints is plausible; a
    /// resolution that is not a positive number is treated as zero.
    pub fn new(config: MotionControllerConfig<R, V>) -> Self {
        let mut supervisor = Supervisor::new(config.supervisor);
        if let Err(error) = A::CIRCLES.check(&config.supervisor.limits) {
            supervisor.refuse(error.joint());
        }
        Self {
            observer: Observer::new(config.observer()),
            supervisor,
            resume: ResumeTrajectory::new(
                config.supervisor.tick,
                config.decay_rate,
                config.supervisor.reentry_ticks,
            ),
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
    /// It is stopped without a fault: its commands have zero torque and the brake set until
    /// [`Self::reset`], which compares the measured position with the first point of the
    /// trajectory.
    ///
    /// ```
    /// use motion_control::limits::Mode;
    /// use motion_control::motion::{MotionController, MotionControllerConfig, ResetError};
    /// # use motion_control::limits::{MotionLimits, SafetyLimits};
    /// # use motion_control::reference::{Trajectory, WayPoint};
    /// # use motion_control::safety::SupervisorConfig;
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
        // It does not leave its trajectory with a speed, so that it joins it at the first point.
        self.resume.stand();
        self
    }

    /// Reports ticks that have passed without a call, as counted by a timer.
    ///
    /// Call it before the next tick. The estimate is extrapolated, the plausible range of positions
    /// grows, and the trajectory advances, unless the arm is held or returns. Ticks beyond the
    /// longest tolerated fault are not predicted: more of them stop the arm by [`Fault::Missed`],
    /// since its drives have applied an old torque for as long.
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
                self.turn_reference();
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

/// Stops and faults from outside the controller.
impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Stops the arm from the next tick on, for an external reason such as a failed drive or an
    /// emergency stop.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. While a stop is still
    /// required after a reset, call this function in every tick.
    /// [`ReferencedTick::stop`](crate::motion::ReferencedTick::stop) acts in the present tick.
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        self.supervisor.stop(fault);
    }

    /// The same controller with another stop category for lasting faults than
    /// [`StopCategory::ControlledOff`].
    ///
    /// ```
    /// use motion_control::limits::{Fault, Mode};
    /// use motion_control::motion::{MotionController, MotionControllerConfig};
    /// use motion_control::safety::StopCategory;
    /// # use motion_control::limits::{MotionLimits, SafetyLimits};
    /// # use motion_control::reference::{Trajectory, WayPoint};
    /// # use motion_control::safety::SupervisorConfig;
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
    /// let sinks = StopCategory::DampedLowering { damping: [4.0] };
    /// let mut controller = MotionController::<f32, 1>::try_new(config)?.with_stop(sinks);
    /// controller.tick(Ok(&[0.0]), &trajectory, |_, _| [1.0]);
    /// controller.stop(Fault::External);
    /// for tick in 0..50 {
    ///     // The arm sinks at 0.5 rad/s: −4 N·m·s/rad of it are 2 N·m.
    ///     let command = controller.tick(Ok(&[-5e-4 * tick as f32]), &trajectory, |_, _| [1.0]);
    ///     assert_eq!(command.status.mode, Mode::Stopped);
    ///     assert!(tick < 40 || (command.torque[0] - 2.0).abs() < 0.01);
    /// }
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_stop(mut self, category: StopCategory<R, V>) -> Self {
        self.supervisor = self.supervisor.with_stop(category);
        self
    }

    /// Stops the arm by a category, for a reason that leaves the drives usable: an operator, a
    /// safety controller, a lost connection. The stop begins in the next tick.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. A later call with
    /// [`StopCategory::TorqueOff`] ends a controlled stop at once.
    #[cold]
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        self.supervisor.stop_by(fault, category);
    }

    /// Reports a fault that the controller cannot detect, which is then a fault of the next tick:
    /// ridden through, held and stopped as any other. While it lasts, report it in every tick.
    ///
    /// For faults that allow no deceleration, see [`Self::stop`]; for a stop without ride-through,
    /// [`Self::stop_by`].
    #[cold]
    pub fn report(&mut self, fault: Fault) {
        self.supervisor.report(fault);
    }

    /// Reacts to a fault that the controller cannot detect, by its [`Fault::reaction`]. Between two
    /// ticks the reaction begins in the next one. While the fault lasts, call this function in
    /// every tick.
    ///
    /// ```
    /// use motion_control::limits::{Fault, Mode};
    /// use motion_control::motion::{MotionController, MotionControllerConfig};
    /// # use dynamics_core::state::State;
    /// # use motion_control::{limits::SafetyLimits, safety::SupervisorConfig};
    /// # let config = MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits: SafetyLimits { torque: [10.0], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
    /// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 1, hold_ticks: 2, reentry_ticks: 4,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
    /// # };
    /// # let reference = State::at([0.5]);
    /// let overrun = [Mode::Full, Mode::Hold, Mode::Hold, Mode::Stopped];
    /// let external = [Mode::Hold, Mode::Hold, Mode::Stopped, Mode::Stopped];
    /// let drive = [Mode::Stopped; 4];
    /// let faults = [Fault::Overrun, Fault::External, Fault::Drive { joint: 0 }];
    /// for (fault, modes) in faults.into_iter().zip([overrun, external, drive]) {
    ///     let mut controller = MotionController::<f32, 1>::try_new(config)?;
    ///     controller.tick(Ok(&[0.5]), &reference, |_, _| [7.0]);
    ///     for mode in modes {
    ///         controller.react(fault);
    ///         let status = controller.tick(Ok(&[0.5]), &reference, |_, _| [7.0]).status;
    ///         assert_eq!((status.mode, status.fault), (mode, Some(fault)));
    ///     }
    /// }
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    #[cold]
    pub fn react(&mut self, fault: Fault) {
        self.supervisor.react(fault);
    }
}

/// Limits that change while the arm moves.
impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Replaces the limits from the next tick on, such as by those of a reduced speed while a door
    /// is open. Call it in every tick with the limits that are required: it returns whether they
    /// have been reached.
    ///
    /// Limits of torque, rate and position hold at once, a torque falls to its limit at that rate.
    /// A limit of torque above that of the configuration, which the drives and gears bear, does not
    /// lift it: the least of both holds, and of those of [`Self::limit_torques`].
    /// In each call a limit of speed falls by `deceleration` (rad/s² or m/s², which may be infinite)
    /// times a tick, and rises at once; an infinite one begins at twice the estimated speed. An arm
    /// that decelerates as fast has no fault, one that does not has [`Fault::Speed`]: lead the
    /// motion down at no less than this deceleration, and a hand by
    /// [`HandGuiding::set_config`](crate::law::HandGuiding::set_config). A
    /// [`BackOff`](crate::motion::BackOff) that has begun keeps its bounds.
    ///
    /// # Errors
    /// [`ConfigError`]: limits or a deceleration that allow nothing, and a range that a joint is
    /// outside of ([`SafetyLimitsError::Outside`](crate::limits::SafetyLimitsError::Outside)).
    /// Nothing is changed then.
    ///
    /// # Cost
    /// Some 15 comparisons and flops a joint in a tick with a call, nothing in others.
    ///
    /// ```
    /// use motion_control::{limits::*, motion::*, safety::*};
    /// # use dynamics_core::state::State;
    /// let fast = SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let config = MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits: fast, tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
    /// # };
    /// let mut controller = MotionController::<f64, 1>::try_new(config)?;
    /// let slow = fast.with_speed_share(0.1);
    /// let mut ticks = 0;
    /// loop {
    ///     let door_is_open = true;
    ///     let required = if door_is_open { &slow } else { &fast };
    ///     let reached = controller.set_limits(required, 10.0)?;
    ///     controller.tick(Ok(&[0.0]), &State::at([0.0]), |_, _| [0.0]);
    ///     ticks += 1;
    ///     if reached {
    ///         break;
    ///     }
    /// }
    /// assert!((270..=271).contains(&ticks)); // from 3 to 0.3 rad/s at 10 rad/s²
    /// let beyond = SafetyLimits { lower: [0.5], ..slow };
    /// let error = controller.set_limits(&beyond, 10.0).unwrap_err();
    /// assert_eq!(error.to_string(), "joint 0: its position, 0, is outside its new range");
    /// # Ok::<(), ConfigError>(())
    /// ```
    #[doc(alias = "reduced speed")]
    #[cold]
    pub fn set_limits(
        &mut self,
        limits: &SafetyLimits<R, V>,
        deceleration: R,
    ) -> Result<bool, ConfigError> {
        A::CIRCLES.check(limits)?;
        let tick = self.observer.tick();
        let qd = &self.observer.estimate().qd;
        self.supervisor.relimit(limits, deceleration * tick, tick, qd, A::CIRCLES)
    }

    /// Lowers the limits of torque to those of a thermal model, before each tick; the tick's
    /// [`Command::torque`](crate::limits::Command::torque) then goes to [`ThermalLimit::update`]. The
    /// least of these limits, of the configuration's and of those of [`Self::set_limits`] holds, in
    /// whatever order they are given.
    ///
    /// ```
    /// # use motion_control::limits::{Reaction, SafetyLimits};
    /// # use motion_control::motion::{MotionController, MotionControllerConfig};
    /// # use motion_control::safety::SupervisorConfig;
    /// use motion_control::limits::{Fault, Mode};
    /// use motion_control::safety::{ThermalConfig, ThermalLimit, ThermalStatus};
    /// # use dynamics_core::state::State;
    /// # let limits = SafetyLimits { torque: [9.0], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut controller = MotionController::<f32, 1>::try_new(MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 1, hold_ticks: 2, reentry_ticks: 4,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
    /// # })?;
    /// # let motor = ThermalConfig {
    /// #     tick: 1e-3, continuous: [3.0], peak: [9.0], winding_time: [12.0], housing_time: [600.0],
    /// #     share: [0.4], hottest: [120.0], ambient: 30.0,
    /// # };
    /// # let (reference, law, celsius) = (State::at([0.5]), |_: &_, _: &_| [2.0], Some(140.0));
    /// let mut thermal = ThermalLimit::try_new(motor, &limits)?;
    /// for _ in 0..40 {
    ///     controller.limit_torques(&thermal);
    ///     let command = controller.tick(Ok(&[0.5]), &reference, law);
    ///     thermal.update(&command.torque);
    ///     if let Some(celsius) = celsius {
    ///         thermal.measured(0, celsius); // of joint 0, by its drive
    ///     }
    ///     if let ThermalStatus::Hot { joint } = thermal.status() {
    ///         controller.react(Fault::Hot { joint });
    ///     }
    /// }
    /// assert_eq!(controller.tick(Ok(&[0.5]), &reference, law).status.fault, Some(Fault::Hot { joint: 0 }));
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    ///
    /// # Cost
    /// Two comparisons a joint.
    #[inline]
    pub fn limit_torques(&mut self, thermal: &ThermalLimit<R, V>) {
        self.supervisor.limit_torques(thermal.torque());
    }
}

/// The reaction to a fault, and the return after it: decision 3.
impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// The estimate without a measurement, or without a torque computed from it.
    #[cold]
    fn predict_estimate(&mut self, measured: Result<&[R; V], Fault>) {
        match (self.supervisor.mode(), measured) {
            (Mode::Stopped, measured) => {
                self.dead_reckoning = measured.is_err();
                self.stopped_estimate(measured);
            }
            (_, Ok(q)) if self.supervisor.measurement_accepted() => {
                self.dead_reckoning = false;
                A::correct_position(&mut self.observer, q);
            }
            (mode, _) => {
                self.dead_reckoning |= matches!(mode, Mode::Hold);
                self.observer.predict(&self.reference.qdd);
            }
        }
    }

    /// The estimate of a stopped arm: at rest where the brake holds it, or the motion of one that
    /// sinks. Without a usable measurement the velocity is zero, and with it the damping.
    fn stopped_estimate(&mut self, measured: Result<&[R; V], Fault>) {
        let last = self.observer.estimate().q;
        match measured {
            Ok(q) if self.observer.started() && self.supervisor.lowers(&last, q) => {
                self.observer.follow(q);
            }
            Ok(q) if all_finite(q) => self.observer.reset(q),
            _ if self.supervisor.knows_positions() => self.observer.reset(&last),
            _ => {}
        }
    }

    /// Updates the reference of the joints in this tick.
    #[inline(always)]
    fn next_reference<T: Reference<R, V>>(&mut self, trajectory: &T) {
        let full = matches!(self.supervisor.mode(), Mode::Full);
        if (!full | self.resume.active()) && !self.recovery_done(full) {
            self.recovery_reference(trajectory, full);
        } else {
            self.reference = trajectory.at(self.clock);
            self.turn_reference();
        }
    }

    /// Whether the return onto the trajectory ends in this tick.
    #[cold]
    fn recovery_done(&mut self, full: bool) -> bool {
        let done = full & (self.supervisor.authority() >= R::ONE);
        if done {
            self.clock = self.resume.finish();
        }
        done
    }

    /// While the arm is held, the reference is its estimated position with a decaying velocity, so
    /// that the same law brings all joints to rest together. Then the return onto the trajectory.
    #[cold]
    #[inline(never)]
    fn recovery_reference<T: Reference<R, V>>(&mut self, trajectory: &T, full: bool) {
        let State { q, qd, qdd } = if full {
            let share = self.supervisor.authority();
            self.resume_reference(trajectory, share)
        } else {
            self.stop_reference()
        };
        // A state of six joints in one piece would be copied by `memcpy`, which adds 0.9 kB to a
        // tick's code.
        self.reference.q = q;
        self.reference.qd = qd;
        self.reference.qdd = qdd;
    }

    /// The reference of a stop that began after that of the tick was computed.
    fn hold_now(&mut self) {
        if !matches!(self.supervisor.mode(), Mode::Full) {
            self.reference = self.stop_reference();
        }
    }

    /// Updates the reference of the joints by one that is not the trajectory's, whose clock stands
    /// still: a return onto it begins in each of these ticks.
    #[cold]
    fn replace_reference(&mut self, reference: &State<R, V, V>) {
        if self.resume.active() {
            self.clock = self.resume.cancel();
        }
        self.resume.start(self.observer.estimate(), self.clock);
        self.standing = false;
        self.reference.q = reference.q;
        self.reference.qd = reference.qd;
        self.reference.qdd = reference.qdd;
        self.turn_reference();
    }

    /// The rate at which the speed of a held arm decays, 1/s.
    pub(crate) fn decay_rate(&self) -> R {
        self.resume.decay_rate()
    }

    /// Decelerates the arm at its present position. The clock stops when the deceleration begins,
    /// and the return is initialised again in each of these ticks.
    fn stop_reference(&mut self) -> State<R, V, V> {
        if self.resume.active() {
            self.clock = self.resume.cancel();
        } else {
            self.clock = self.resume.resume_tick(self.clock);
        }
        let estimate = *self.observer.estimate();
        self.resume.start(&estimate, self.clock);
        // With a reference at the estimate, errors of the model would let an arm that is held for
        // long drift.
        self.standing =
            self.supervisor.stands() & (self.standing | self.supervisor.at_rest(&estimate.qd));
        if self.standing {
            return State::at(self.reference.q);
        }
        hold(&estimate, self.resume.decay_rate())
    }
}

/// The start of an arm that is stopped, at power-up or after a fault.
impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Whether the last tick had a measurement, which need not be within the bounds.
    pub(crate) fn measured(&self) -> bool {
        !self.dead_reckoning & self.observer.started()
    }

    /// Starts a stopped arm, at power-up or after a fault: clears the fault and leads the arm onto
    /// its trajectory.
    ///
    /// The brake holds until the torque that keeps the arm at rest is reached, a few ticks later.
    /// An arm that is held by a stop of category 2 stays under power.
    ///
    /// # Errors
    /// [`ResetError`]; the controller is then unchanged.
    pub fn reset<T: Reference<R, V>>(&mut self, trajectory: &T) -> Result<(), ResetError> {
        let stands = self.supervisor.stands();
        if !matches!(self.supervisor.mode(), Mode::Stopped) & !stands {
            return Err(ResetError::NotStopped);
        }
        if !self.measured() {
            return Err(ResetError::NoMeasurement);
        }
        if let Some(joint) = self.supervisor.outside(&self.observer.estimate().q) {
            return Err(ResetError::OutOfBounds { joint });
        }
        if !self.supervisor.knows_positions() {
            return Err(ResetError::NoMeasurement);
        }
        let goal = self.turned(trajectory.at(self.clock).q);
        let mut joints = goal.iter().zip(&self.observer.estimate().q);
        let near = |(goal, q): (&R, &R)| (*goal - *q).abs() <= self.restart_distance;
        if let Some(joint) = joints.position(|joint| !near(joint)) {
            return Err(ResetError::TooFar { joint });
        }
        if stands {
            self.supervisor.release();
            self.resume.start(self.observer.estimate(), self.clock);
            self.reference.qdd = [R::ZERO; V];
        } else {
            self.restart();
        }
        Ok(())
    }

    /// Sets the clock of a stopped arm to the begin of another trajectory. Further ticks without a
    /// reset keep it.
    pub(crate) fn begin_anew(&mut self) {
        self.clock = 0;
        // The clock of a stop is that of the return, which begins again in each of its ticks.
        self.resume.start(self.observer.estimate(), self.clock);
    }

    /// Clears a stop; the reference begins at the estimated position.
    pub(crate) fn restart(&mut self) {
        self.supervisor.reset();
        self.resume.start(self.observer.estimate(), self.clock);
        self.reference.qdd = [R::ZERO; V];
    }
}
