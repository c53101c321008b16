//! The tick: read, reference, dynamics, safety, write.
//!
//! The loop owns its encoders, drives and brake through `embedded-hal` traits, and calls the library's
//! [`MotionController`], which contains the state of the loop and the reaction to faults.

use dynamics_core::state::State;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;
use joint_drivers::as5047p::{As5047p, FrameError};
use joint_drivers::h_bridge::LockedAntiphase;
use motion_control::{
    CompletedTick, Detect, Estimate, Fault, Gains, MotionController, ObservedTick, Reference,
    ReferencedTick, ResetError, StopCategory, TickCounter, feedback,
};

use crate::marker::measured;

mod record;

pub use record::{Recorder, Telemetry};

/// The measured regions of a tick; [`region::TICK`] holds the others.
pub mod region {
    /// The whole tick.
    pub const TICK: u8 = 0;
    /// Encoders, plausibility, observer: [`motion_control::MotionController::observe`].
    pub const READ: u8 = 1;
    /// The trajectory at this tick.
    pub const REFERENCE: u8 = 2;
    /// Feed-forward and feedback torque.
    pub const DYNAMICS: u8 = 3;
    /// Limits and state machine.
    pub const SAFETY: u8 = 4;
    /// Drives and brake.
    pub const WRITE: u8 = 5;
    /// Putting the record of the tick into the queue of the telemetry, after the tick.
    pub const RECORD: u8 = 6;
    /// What runs with interrupts masked, in firmware that measures it.
    pub const MASKED: u8 = 7;
}

/// The feed-forward part of the control law; `X` is its input beside the reference (the payload, the motion of the
/// base).
pub trait Law<const V: usize, X = ()> {
    /// Whether the feed-forward produces the acceleration of the reference. If so, it decelerates a held arm with all
    /// coupling; if not, only K_d of the feedback does.
    const ACCELERATES: bool = true;

    /// The torque for the reference, N·m or N.
    fn feedforward(reference: &State<f32, V, V>, environment: &X) -> [f32; V];

    /// The command, N·m or N: τ = feed-forward + K_p (q_d − q) + K_d (q̇_d − q̇), or that of another loop.
    #[inline(always)]
    fn torque(
        gains: &Gains<f32, V>,
        reference: &State<f32, V, V>,
        estimate: &Estimate<f32, V>,
        environment: &X,
    ) -> [f32; V] {
        let mut tau = Self::feedforward(reference, environment);
        let pd = feedback(gains, reference, estimate);
        for (tau, pd) in tau.iter_mut().zip(pd) {
            *tau += pd;
        }
        tau
    }
}

/// The control loop of a robot with V joints: its devices, a [`MotionController`] and its detectors.
#[derive(Debug)]
pub struct ControlLoop<Spi, Pwm, Brake, const V: usize, D = ()> {
    encoders: [As5047p<Spi>; V],
    drives: [LockedAntiphase<Pwm>; V],
    /// High holds the joints.
    brake: Brake,
    gains: Gains<f32, V>,
    controller: MotionController<f32, V>,
    detectors: D,
    counter: TickCounter,
    frame: Option<FrameError>,
}

impl<Spi, Pwm, Brake, const V: usize, D> ControlLoop<Spi, Pwm, Brake, V, D>
where
    Spi: SpiDevice,
    Pwm: SetDutyCycle,
    Brake: OutputPin,
    D: Detect<f32, V>,
{
    /// A loop at the start of its trajectory; starts the encoders. The first tick should follow within one tick, or the
    /// arm must stand still until then.
    pub fn new(
        mut encoders: [As5047p<Spi>; V],
        drives: [LockedAntiphase<Pwm>; V],
        brake: Brake,
        gains: Gains<f32, V>,
        controller: MotionController<f32, V>,
        detectors: D,
    ) -> Self {
        encoders.iter_mut().for_each(As5047p::start);
        Self {
            encoders,
            drives,
            brake,
            gains,
            controller,
            detectors,
            counter: TickCounter::new(),
            frame: None,
        }
    }

    /// One tick under the law `L`.
    #[inline(never)]
    pub fn tick<L: Law<V, X>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
    ) -> Telemetry<V> {
        self.phases::<L, T, X>(trajectory, environment, || 0, &mut ())
    }

    /// One tick under the law `L`, recorded with the counts of a timer. Reading the timer adds to the tick what six loads
    /// from a device take.
    #[inline(never)]
    pub fn tick_timed<L: Law<V, X>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
        timer: impl Fn() -> u32,
        recorder: &mut impl Recorder<V>,
    ) {
        self.phases::<L, T, X>(trajectory, environment, timer, recorder);
    }

    #[inline(always)]
    fn phases<L: Law<V, X>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
        timer: impl Fn() -> u32,
        recorder: &mut impl Recorder<V>,
    ) -> Telemetry<V> {
        measured::<{ region::TICK }, _>(|| {
            let (encoders, controller) = (&mut self.encoders, &mut self.controller);
            let (frame, detectors) = (&mut self.frame, &mut self.detectors);
            recorder.count(0, timer());
            let tick =
                measured::<{ region::READ }, _>(|| read(encoders, frame, controller, detectors));
            recorder.count(1, timer());
            let mut tick =
                measured::<{ region::REFERENCE }, _>(|| follow(tick, trajectory, detectors));
            recorder.count(2, timer());
            if !L::ACCELERATES {
                tick = tick.without_inertia();
            }
            let clock = tick.trajectory_tick();
            let torque = measured::<{ region::DYNAMICS }, _>(|| {
                torque::<L, X, V>(&self.gains, tick.reference(), tick.estimate(), environment)
            });
            recorder.count(3, timer());
            let (command, found) = measured::<{ region::SAFETY }, _>(|| {
                let command = tick.command(&torque);
                (command, detectors.commanded(&command))
            });
            if let Err(fault) = found {
                self.controller.react(fault);
            }
            recorder.count(4, timer());
            measured::<{ region::WRITE }, _>(|| self.write(&command.torque, command.brake));
            recorder.count(5, timer());
            let telemetry = Telemetry {
                tick: clock,
                reference: self.controller.reference().q,
                estimate: self.controller.estimate().q,
                torque: command.torque,
                status: command.status,
                frame: self.frame,
            };
            recorder.record(&telemetry);
            telemetry
        })
    }

    /// One tick under the law `L` at the count of a timer that advances by one per period.
    ///
    /// Missed ticks are reported to the controller, and so is a tick that ends after its period. A tick that ends in
    /// time gives what feeds a [`Watchdog`](motion_control::Watchdog).
    pub fn tick_at<L: Law<V, X>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        environment: &X,
        timer: impl Fn() -> u32,
    ) -> (Telemetry<V>, Option<CompletedTick>) {
        let tick = self.counter.begin(timer());
        if tick.missed() > 0 {
            self.controller.missed(tick.missed(), trajectory);
            self.detectors.restart();
        }
        let telemetry = self.tick::<L, T, X>(trajectory, environment);
        let completed = tick.end(timer(), &telemetry.status);
        let completed = completed.map_err(|fault| self.controller.react(fault));
        (telemetry, completed.ok())
    }

    /// Stops the arm from outside, by a category.
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<f32, V>) {
        self.controller.stop_by(fault, category);
    }

    /// Restarts a stopped arm: clears the fault and leads the arm back onto its trajectory. The brake holds until the
    /// torque that keeps the arm at rest is reached, a few ticks later.
    ///
    /// # Errors
    /// [`ResetError`]; the controller is then unchanged.
    pub fn reset<T: Reference<f32, V>>(&mut self, trajectory: &T) -> Result<(), ResetError> {
        self.detectors.restart();
        self.controller.reset(trajectory)
    }

    #[inline(never)]
    fn write(&mut self, torque: &[f32; V], brake: bool) {
        let mut duties = [0; V];
        for ((duty, drive), &torque) in duties.iter_mut().zip(&self.drives).zip(torque) {
            *duty = drive.duty(torque);
        }
        let mut failed = None;
        for (joint, (drive, duty)) in self.drives.iter_mut().zip(duties).enumerate() {
            if drive.set(duty).is_err() {
                failed = failed.or(Some(Fault::Drive { joint }));
            }
        }
        // A drive that may have failed: the brake at once, the other drives from the next tick on.
        let set = if brake | failed.is_some() {
            self.brake.set_high()
        } else {
            self.brake.set_low()
        };
        if let Some(fault) = failed.or(set.err().map(|_| Fault::Brake)) {
            self.controller.react(fault);
        }
    }
}

/// Reads the encoders and starts the controller's tick.
#[inline(never)]
fn read<'a, Spi: SpiDevice, D: Detect<f32, V>, const V: usize>(
    encoders: &mut [As5047p<Spi>; V],
    frame: &mut Option<FrameError>,
    controller: &'a mut MotionController<f32, V>,
    detectors: &mut D,
) -> ObservedTick<'a, f32, V> {
    let mut bad = None;
    for (joint, encoder) in encoders.iter_mut().enumerate() {
        if let Err(error) = encoder.read() {
            bad = bad.or(Some((joint, error)));
        }
    }
    *frame = bad.map(|(_, error)| error);
    // All angles at once, after the transfers: the conversion of one joint fills the time in which the FPU is at another.
    let q = encoders.each_ref().map(As5047p::angle);
    let measured = match bad {
        Some((joint, _)) => Err(Fault::Encoder { joint }),
        None => detectors.measured(&q, &controller.reference().q),
    };
    controller.observe(measured.map(|()| &q))
}

/// The reference of the joints.
#[inline(never)]
fn follow<'a, T: Reference<f32, V>, D: Detect<f32, V>, const V: usize>(
    tick: ObservedTick<'a, f32, V>,
    trajectory: &T,
    detectors: &mut D,
) -> ReferencedTick<'a, f32, V> {
    let mut tick = tick.reference(trajectory);
    if let Err(fault) = detectors.referenced(tick.reference(), tick.mode()) {
        stop(&mut tick, fault);
    }
    tick
}

/// Stops the arm in this tick: in a function of its own, so that the usual tick keeps no registers for it.
#[cold]
#[inline(never)]
fn stop<const V: usize>(tick: &mut ReferencedTick<'_, f32, V>, fault: Fault) {
    tick.stop_by(fault, StopCategory::ControlledOff);
}

/// The law's command, in a function of its own.
#[inline(never)]
fn torque<L: Law<V, X>, X, const V: usize>(
    gains: &Gains<f32, V>,
    reference: &State<f32, V, V>,
    estimate: &Estimate<f32, V>,
    environment: &X,
) -> [f32; V] {
    L::torque(gains, reference, estimate, environment)
}
