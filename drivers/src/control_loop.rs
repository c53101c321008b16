//! The tick: read, reference, dynamics, safety, write.
//!
//! The loop owns encoders, drives and brake through [`JointEncoders`], [`JointDrives`] and
//! [`OutputPin`], and calls the [`MotionController`], which contains the state of the loop and the
//! reaction to faults.

use dynamics_core::state::State;
use embedded_hal::digital::OutputPin;
use motion_control::estimate::Estimate;
use motion_control::law::{Feedback, Gains};
use motion_control::limits::{
    Command, ConfigError, Fault, Mode, MotionLimits, SafetyLimits, Status,
};
use motion_control::motion::{
    Approach, ApproachError, MeasurementAge, MotionController, ObservedTick, OnCircles,
    ReferencedTick, ResetError,
};
use motion_control::reference::Reference;
use motion_control::safety::{CompletedTick, Detect, StopCategory, ThermalLimit, TickCounter};

#[cfg(feature = "async")]
use crate::asynch;
use crate::{DriveFault, DriveFaultKind, EncoderType, JointDrives, JointEncoders, JointError};

mod probe;

pub use probe::{Phase, Probe, Telemetry};

/// The feed-forward part of the control law; `X` is its input beside the reference (the payload,
/// the motion of the base), `G` its gains: those of another unit are another type.
///
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::{Engine, robots::Ur5e, state::State};
/// use joint_drivers::Law;
/// struct Model;
/// impl Law<6> for Model {
///     fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
///         Engine::<Ur5e>::rnea(reference, &RIGID_BODY)
///     }
/// }
/// ```
pub trait Law<const V: usize, X = (), G: Feedback<f32, V> = Gains<f32, V>> {
    /// Whether the feed-forward produces the acceleration of the reference. If so, it decelerates a
    /// held arm with all coupling; if not, only K_d of the feedback does.
    const ACCELERATES: bool = true;

    /// The torque for the reference, N·m or N.
    fn feedforward(reference: &State<f32, V, V>, environment: &X) -> [f32; V];

    /// The command, N·m or N: the feed-forward with the feedback of these gains, or that of another
    /// loop.
    #[inline(always)]
    fn torque(
        gains: &G,
        reference: &State<f32, V, V>,
        estimate: &Estimate<f32, V>,
        environment: &X,
    ) -> [f32; V] {
        gains.torque(|state| Self::feedforward(state, environment), reference, estimate)
    }
}

/// The last error of a device and its joint, in as few bytes as a small stack needs.
type LastError<E> = Option<(u8, E)>;

fn keep<E>(JointError { joint, error }: JointError<E>) -> LastError<E> {
    Some((u8::try_from(joint).unwrap_or(u8::MAX), error))
}

fn kept<E>(kept: &LastError<E>) -> Option<JointError<&E>> {
    let (joint, error) = kept.as_ref()?;
    let joint = usize::from(*joint);
    Some(JointError { joint, error })
}

/// The control loop of a robot with V joints: its devices, a [`MotionController`] and its
/// detectors.
///
/// The age of the measurements is that of the encoders ([`EncoderType::Age`]), or
/// [`motion_control::motion::OnCircles`] of it for a robot with continuous joints. It has no heap
/// and no panic.
///
/// ```
/// use dynamics_core::state::State;
/// use embedded_hal_mock::eh1::pwm;
/// use joint_drivers::as5047p::{As5047p, FrameError};
/// use joint_drivers::h_bridge::{FullScale, LockedAntiphase};
/// use joint_drivers::{ControlLoop, Direction, JointError, JointMapping, JointRange, Law, NoBrake};
/// use motion_control::{law::*, limits::*, motion::*, reference::*, safety::*};
///
/// /// A joint of 2 kg·m² without gravity.
/// struct Wheel;
/// impl Law<1> for Wheel {
///     fn feedforward(reference: &State<f32, 1, 1>, (): &()) -> [f32; 1] {
///         reference.qdd.map(|qdd| 2.0 * qdd)
///     }
/// }
/// # let config = MotionControllerConfig {
/// #     supervisor: SupervisorConfig {
/// #         limits: SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-1.0], upper: [1.0] },
/// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
/// #     },
/// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
/// # };
/// # let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
/// # let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }];
/// # let trajectory = Trajectory::new(&[point(0.0, 0), point(0.0, 1000)], 1e-3, &limits)?;
/// // Two frames at the start, one each tick; the second tick's has a wrong parity, which costs two more.
/// # struct Bus(std::vec::IntoIter<u16>);
/// # impl embedded_hal::spi::ErrorType for Bus { type Error = core::convert::Infallible; }
/// # impl embedded_hal::spi::SpiDevice for Bus {
/// #     fn transaction(&mut self, all: &mut [embedded_hal::spi::Operation<'_, u8>]) -> Result<(), Self::Error> {
/// #         for operation in all {
/// #             if let embedded_hal::spi::Operation::TransferInPlace(words) = operation {
/// #                 words.copy_from_slice(&self.0.next().unwrap().to_be_bytes());
/// #             }
/// #         }
/// #         Ok(())
/// #     }
/// # }
/// # let spi = Bus(vec![0, 0, 0, 1, 0, 0].into_iter());
/// let range = JointRange::Within { lower: -1.0, upper: 1.0 };
/// let encoder = As5047p::new(spi, JointMapping::IDENTITY.with_range(range, 3.0 * 1e-3)?);
/// let pwm = pwm::Mock::new(&[
///     pwm::Transaction::max_duty_cycle(8400),
///     pwm::Transaction::set_duty_cycle(4200),
///     pwm::Transaction::set_duty_cycle(4200),
/// ]);
/// # let mut check = pwm.clone();
/// let drive = LockedAntiphase::new(pwm, FullScale::new(10.0)?, Direction::Forward);
/// let controller = MotionController::try_new(config)?;
/// let gains = Gains { kp: [0.0], kd: [0.0] };
/// let mut control = ControlLoop::new([encoder], [drive], NoBrake, gains, controller, ());
///
/// assert_eq!(control.tick::<Wheel, _, _>(&trajectory, &()).status.fault, None);
/// let telemetry = control.tick::<Wheel, _, _>(&trajectory, &());
/// assert_eq!(telemetry.status.fault, Some(Fault::Encoder { joint: 0 }));
/// assert_eq!(control.encoder_error(), Some(JointError { joint: 0, error: &FrameError::Parity }));
/// # check.done();
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ControlLoop<
    E,
    D,
    Brake,
    const V: usize,
    Detectors = (),
    A = <E as EncoderType>::Age,
    G = Gains<f32, V>,
> where
    E: EncoderType,
    D: JointDrives<V>,
{
    encoders: E,
    drives: D,
    /// A high level holds the joints.
    brake: Brake,
    gains: G,
    controller: MotionController<f32, V, A>,
    detectors: Detectors,
    counter: TickCounter,
    encoder_error: LastError<E::Error>,
    drive_error: LastError<D::Error>,
}

impl<E, D, Brake, const V: usize, Detectors, G> ControlLoop<E, D, Brake, V, Detectors, E::Age, G>
where
    E: EncoderType,
    D: JointDrives<V>,
    Brake: OutputPin,
    Detectors: Detect<f32, V>,
    G: Feedback<f32, V>,
{
    /// A loop at the start of its trajectory; starts the encoders. High at `brake` holds the
    /// joints.
    ///
    /// The first tick should follow within one tick, or the arm must stand still until then.
    pub fn new(
        mut encoders: E,
        drives: D,
        brake: Brake,
        gains: G,
        controller: MotionController<f32, V, E::Age>,
        detectors: Detectors,
    ) -> Self
    where
        E: JointEncoders<V>,
    {
        encoders.start();
        Self::started(encoders, drives, brake, gains, controller, detectors)
    }
}

impl<E, D, Brake, const V: usize, Detectors, const CIRCLES: u128, G>
    ControlLoop<E, D, Brake, V, Detectors, OnCircles<CIRCLES, E::Age>, G>
where
    E: EncoderType,
    D: JointDrives<V>,
    Brake: OutputPin,
    Detectors: Detect<f32, V>,
    G: Feedback<f32, V>,
{
    /// As [`ControlLoop::new`], of a controller with joints that are circles. Its detectors are
    /// those [`on_circles`](motion_control::safety::Detectors::on_circles), too.
    pub fn on_circles(
        mut encoders: E,
        drives: D,
        brake: Brake,
        gains: G,
        controller: MotionController<f32, V, OnCircles<CIRCLES, E::Age>>,
        detectors: Detectors,
    ) -> Self
    where
        E: JointEncoders<V>,
    {
        encoders.start();
        Self::started(encoders, drives, brake, gains, controller, detectors)
    }
}

impl<E, D, Brake, const V: usize, Detectors, A, G> ControlLoop<E, D, Brake, V, Detectors, A, G>
where
    E: EncoderType,
    A: MeasurementAge,
    D: JointDrives<V>,
    Brake: OutputPin,
    Detectors: Detect<f32, V>,
    G: Feedback<f32, V>,
{
    #[inline(always)]
    fn started(
        encoders: E,
        drives: D,
        brake: Brake,
        gains: G,
        controller: MotionController<f32, V, A>,
        detectors: Detectors,
    ) -> Self {
        Self {
            encoders,
            drives,
            brake,
            gains,
            controller,
            detectors,
            counter: TickCounter::new(),
            encoder_error: None,
            drive_error: None,
        }
    }

    /// One tick under the law `L`.
    #[inline(never)]
    pub fn tick<L: Law<V, X, G>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
    ) -> Telemetry<V>
    where
        E: JointEncoders<V>,
    {
        self.tick_probed::<L, T, X>(trajectory, environment, &mut ())
    }

    /// One tick under the law `L`, watched by a probe. It is inlined: call it from a function that
    /// is not.
    #[inline(always)]
    pub fn tick_probed<L: Law<V, X, G>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
        probe: &mut impl Probe<V>,
    ) -> Telemetry<V>
    where
        E: JointEncoders<V>,
    {
        probe.begin(Phase::Tick);
        probe.begin(Phase::Read);
        let (encoders, controller) = (&mut self.encoders, &mut self.controller);
        let (error, detectors) = (&mut self.encoder_error, &mut self.detectors);
        let tick = read(encoders, error, controller, detectors);
        probe.end(Phase::Read);
        let gains = &self.gains;
        let computed =
            compute::<L, T, X, _, _, _, V>(tick, detectors, gains, trajectory, environment, probe);
        self.complete(computed, probe)
    }

    /// The end of a tick: drives, brake and the record.
    #[inline(always)]
    fn complete(
        &mut self,
        (clock, command, found): (u32, Command<f32, V>, Result<(), Fault>),
        probe: &mut impl Probe<V>,
    ) -> Telemetry<V> {
        if let Err(fault) = found {
            self.controller.react(fault);
        }
        probe.begin(Phase::Write);
        let is_usual = || {
            let Status { mode, fault, limited: _ } = command.status;
            matches!(mode, Mode::Full) && fault.is_none() && found.is_ok() && !command.brake
        };
        if D::HAVE_PD && is_usual() {
            self.write_with_pd(&command.torque);
        } else {
            self.write(&command.torque, command.brake);
        }
        probe.end(Phase::Write);
        let telemetry = Telemetry {
            tick: clock,
            reference: self.controller.reference().q,
            estimate: self.controller.estimate().q,
            torque: command.torque,
            status: command.status,
        };
        probe.record(&telemetry);
        probe.end(Phase::Tick);
        telemetry
    }

    /// One tick under the law `L` at the count of a timer that advances by one per period.
    ///
    /// Missed ticks are reported to the controller, and so is a tick that ends after its period. A
    /// tick that ends in time gives what feeds a [`Watchdog`](motion_control::safety::Watchdog).
    pub fn tick_at<L: Law<V, X, G>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
        timer: impl Fn() -> u32,
    ) -> (Telemetry<V>, Option<CompletedTick>)
    where
        E: JointEncoders<V>,
    {
        let tick = self.counter.begin(timer());
        if tick.missed() > 0 {
            self.encoders.missed(tick.missed());
            self.controller.missed(tick.missed(), trajectory);
            self.detectors.restart();
        }
        let telemetry = self.tick::<L, T, X>(trajectory, environment);
        let completed = tick.end(timer(), &telemetry.status);
        let completed = completed.map_err(|fault| self.controller.react(fault));
        (telemetry, completed.ok())
    }

    /// The mode of the arm: [`MotionController::mode`].
    pub fn mode(&self) -> Mode {
        self.controller.mode()
    }

    /// The tick of the trajectory that comes next, in which a goal is set:
    /// [`MotionController::trajectory_tick`].
    pub fn trajectory_tick(&self) -> u32 {
        self.controller.trajectory_tick()
    }

    /// The estimate of the last tick, from which the reference of an arm that is led begins.
    pub fn estimate(&self) -> &Estimate<f32, V> {
        self.controller.estimate()
    }

    /// The way back onto a trajectory of a stopped arm, for [`Self::reset`]:
    /// [`MotionController::approach`].
    ///
    /// # Errors
    /// [`ApproachError`].
    pub fn approach<'a, T: Reference<f32, V>>(
        &mut self,
        trajectory: &'a T,
        limits: &[MotionLimits<f32>; V],
        bounds: &SafetyLimits<f32, V>,
    ) -> Result<Approach<'a, f32, V, T>, ApproachError> {
        self.controller.approach(trajectory, limits, bounds)
    }

    /// Switches the torque off and sets the brake in the next tick: [`MotionController::stop`].
    pub fn stop(&mut self, fault: Fault) {
        self.controller.stop(fault);
    }

    /// A fault that your loop detects, with its reaction: [`MotionController::react`].
    pub fn react(&mut self, fault: Fault) {
        self.controller.react(fault);
    }

    /// Stops the arm from outside, by a category.
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<f32, V>) {
        self.controller.stop_by(fault, category);
    }

    /// Replaces the limits, those of speed along a ramp: as [`MotionController::set_limits`], in
    /// every tick.
    ///
    /// # Errors
    /// [`ConfigError`]; nothing is changed then.
    pub fn set_limits(
        &mut self,
        limits: &SafetyLimits<f32, V>,
        deceleration: f32,
    ) -> Result<bool, ConfigError> {
        self.controller.set_limits(limits, deceleration)
    }

    /// Replaces the limits of torque before a tick: as [`MotionController::limit_torques`].
    pub fn limit_torques(&mut self, thermal: &ThermalLimit<f32, V>) {
        self.controller.limit_torques(thermal);
    }

    /// Restarts a stopped arm: clears the fault and leads the arm back onto its trajectory. The
    /// brake holds until the torque that keeps the arm at rest is reached, a few ticks later.
    ///
    /// # Errors
    /// [`ResetError`]; the controller is then unchanged.
    pub fn reset<T: Reference<f32, V>>(&mut self, trajectory: &T) -> Result<(), ResetError> {
        self.detectors.restart();
        self.controller.reset(trajectory)
    }

    /// The encoders, to tell one that has lost its turn where its joint is:
    /// [`crate::MultiTurnEncoder::place_near`].
    pub fn encoders(&mut self) -> &mut E {
        &mut self.encoders
    }

    /// The error of the first encoder without a position in the last tick, which was the fault of
    /// [`EncoderType::fault`]. Joints above 255 are called 255.
    pub fn encoder_error(&self) -> Option<JointError<&E::Error>> {
        kept(&self.encoder_error)
    }

    /// The last error of a drive, which was [`Fault::Drive`] or [`Fault::NotReady`]. Joints above
    /// 255 are called 255.
    pub fn drive_error(&self) -> Option<JointError<&D::Error>> {
        kept(&self.drive_error)
    }

    #[inline(never)]
    fn write(&mut self, torque: &[f32; V], brake: bool) {
        let failed = self.drives.set_torques(torque).err();
        self.brake_and_react(failed, brake);
    }

    /// As [`Self::write`] in full operation without a fault.
    #[inline(never)]
    fn write_with_pd(&mut self, torque: &[f32; V]) {
        let (reference, estimate) = (self.controller.reference(), self.controller.estimate());
        let failed = self.drives.set_with_pd(torque, reference, estimate).err();
        self.brake_and_react(failed, false);
    }

    #[inline(always)]
    fn brake_and_react(&mut self, failed: Option<JointError<D::Error>>, brake: bool) {
        // A drive that may have failed: the brake at once, the other drives from the next tick on.
        let is_lost = |failed: &JointError<D::Error>| failed.error.kind() == DriveFaultKind::Failed;
        let set = if brake | failed.as_ref().is_some_and(is_lost) {
            self.brake.set_high()
        } else {
            self.brake.set_low()
        };
        if let Some(error) = failed {
            self.controller.react(error.drive_fault());
            self.drive_error = keep(error);
        } else if set.is_err() {
            self.controller.react(Fault::Brake);
        }
    }
}

#[cfg(feature = "async")]
impl<E, D, Brake, const V: usize, Detectors, G> ControlLoop<E, D, Brake, V, Detectors, E::Age, G>
where
    E: asynch::JointEncoders<V>,
    D: JointDrives<V>,
    Brake: OutputPin,
    Detectors: Detect<f32, V>,
    G: Feedback<f32, V>,
{
    /// As [`ControlLoop::new`], with encoders over `embedded-hal-async`.
    pub async fn new_async(
        mut encoders: E,
        drives: D,
        brake: Brake,
        gains: G,
        controller: MotionController<f32, V, E::Age>,
        detectors: Detectors,
    ) -> Self {
        encoders.start().await;
        Self::started(encoders, drives, brake, gains, controller, detectors)
    }
}

#[cfg(feature = "async")]
impl<E, D, Brake, const V: usize, Detectors, const CIRCLES: u128, G>
    ControlLoop<E, D, Brake, V, Detectors, OnCircles<CIRCLES, E::Age>, G>
where
    E: asynch::JointEncoders<V>,
    D: JointDrives<V>,
    Brake: OutputPin,
    Detectors: Detect<f32, V>,
    G: Feedback<f32, V>,
{
    /// As [`ControlLoop::on_circles`], with encoders over `embedded-hal-async`.
    pub async fn on_circles_async(
        mut encoders: E,
        drives: D,
        brake: Brake,
        gains: G,
        controller: MotionController<f32, V, OnCircles<CIRCLES, E::Age>>,
        detectors: Detectors,
    ) -> Self {
        encoders.start().await;
        Self::started(encoders, drives, brake, gains, controller, detectors)
    }
}

#[cfg(feature = "async")]
impl<E, D, Brake, const V: usize, Detectors, A, G> ControlLoop<E, D, Brake, V, Detectors, A, G>
where
    E: asynch::JointEncoders<V>,
    A: MeasurementAge,
    D: JointDrives<V>,
    Brake: OutputPin,
    Detectors: Detect<f32, V>,
    G: Feedback<f32, V>,
{
    /// As [`Self::tick`]; other tasks run while the encoders' bus is busy.
    pub async fn tick_async<L: Law<V, X, G>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
    ) -> Telemetry<V> {
        let read = self.encoders.read().await;
        let (error, detectors) = (&mut self.encoder_error, &mut self.detectors);
        let tick = observe::<E, _, _, V>(read, error, &mut self.controller, detectors);
        let gains = &self.gains;
        let computed = compute::<L, T, X, _, _, _, V>(
            tick,
            detectors,
            gains,
            trajectory,
            environment,
            &mut (),
        );
        self.complete(computed, &mut ())
    }
}

/// Reads the encoders and starts the controller's tick.
#[inline(never)]
fn read<'a, E: JointEncoders<V>, D: Detect<f32, V>, A: MeasurementAge, const V: usize>(
    encoders: &mut E,
    last: &mut LastError<E::Error>,
    controller: &'a mut MotionController<f32, V, A>,
    detectors: &mut D,
) -> ObservedTick<'a, f32, V, A> {
    observe::<E, _, _, V>(encoders.read(), last, controller, detectors)
}

/// Starts the controller's tick with what the encoders have read.
#[inline(always)]
fn observe<'a, E: EncoderType, D: Detect<f32, V>, A: MeasurementAge, const V: usize>(
    read: Result<[f32; V], JointError<E::Error>>,
    last: &mut LastError<E::Error>,
    controller: &'a mut MotionController<f32, V, A>,
    detectors: &mut D,
) -> ObservedTick<'a, f32, V, A> {
    match read {
        Ok(q) => {
            *last = None;
            let measured = detectors.measured(&q, &controller.reference().q);
            controller.observe(measured.map(|()| &q))
        }
        Err(error) => {
            let fault = E::fault(&error.error, error.joint);
            *last = keep(error);
            controller.observe(Err(fault))
        }
    }
}

/// Reference, law and limits: the tick of the trajectory, the command, and what the detectors say
/// of it.
#[inline(always)]
fn compute<L, T, X, A, D, G, const V: usize>(
    tick: ObservedTick<'_, f32, V, A>,
    detectors: &mut D,
    gains: &G,
    trajectory: &T,
    environment: &X,
    probe: &mut impl Probe<V>,
) -> (u32, Command<f32, V>, Result<(), Fault>)
where
    L: Law<V, X, G>,
    G: Feedback<f32, V>,
    T: Reference<f32, V>,
    A: MeasurementAge,
    D: Detect<f32, V>,
{
    probe.begin(Phase::Reference);
    let mut tick = follow(tick, trajectory, detectors);
    probe.end(Phase::Reference);
    if !L::ACCELERATES {
        tick = tick.without_inertia();
    }
    let clock = tick.trajectory_tick();
    probe.begin(Phase::Dynamics);
    let tau = torque::<L, X, _, V>(gains, tick.reference(), tick.estimate(), environment);
    probe.end(Phase::Dynamics);
    probe.begin(Phase::Safety);
    let command = tick.command(&tau);
    let found = detectors.commanded(&command);
    probe.end(Phase::Safety);
    (clock, command, found)
}

/// The reference of the joints.
#[inline(never)]
fn follow<'a, T: Reference<f32, V>, D: Detect<f32, V>, A: MeasurementAge, const V: usize>(
    tick: ObservedTick<'a, f32, V, A>,
    trajectory: &T,
    detectors: &mut D,
) -> ReferencedTick<'a, f32, V, A> {
    let mut tick = tick.reference(trajectory);
    if let Err(fault) = detectors.referenced(tick.reference(), tick.mode()) {
        stop(&mut tick, fault);
    }
    tick
}

/// Stops the arm in this tick: in a function of its own, so that the usual tick keeps no registers
/// for it.
#[cold]
#[inline(never)]
fn stop<A: MeasurementAge, const V: usize>(tick: &mut ReferencedTick<'_, f32, V, A>, fault: Fault) {
    tick.stop_by(fault, StopCategory::ControlledOff);
}

/// The law's command, in a function of its own.
#[inline(never)]
fn torque<L: Law<V, X, G>, X, G: Feedback<f32, V>, const V: usize>(
    gains: &G,
    reference: &State<f32, V, V>,
    estimate: &Estimate<f32, V>,
    environment: &X,
) -> [f32; V] {
    L::torque(gains, reference, estimate, environment)
}
