//! The tick: read, reference, dynamics, safety, write.
//!
//! The loop owns its encoders, drives and brake through `embedded-hal` traits and keeps nothing
//! else from tick to tick but its clock, observer, supervisor and way back.
//!
//! A measurement that is lost now and then is ridden through: the arm goes on as the observer
//! expects. When more are lost, the clock stands still and the arm is brought to rest, from where the
//! observer expects it to be, by inverse dynamics of a speed that decays; on the way back a reference leads from
//! there onto the trajectory.

use dynamics_core::control::{
    Fault, Gains, Mode, Observer, Reference, Rejoin, Status, Supervisor, feedback, hold,
};
use dynamics_core::state::State;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;

use crate::drive::Drive;
use crate::encoder::{Encoder, FrameError};
use crate::marker::measured;

/// The measured regions of a tick; [`region::TICK`] holds the others.
pub mod region {
    /// The whole tick.
    pub const TICK: u8 = 0;
    /// Encoders, plausibility, observer.
    pub const READ: u8 = 1;
    /// The trajectory at this tick.
    pub const REFERENCE: u8 = 2;
    /// Feed-forward and feedback torque.
    pub const DYNAMICS: u8 = 3;
    /// JointLimits and state machine.
    pub const SAFETY: u8 = 4;
    /// Drives and brake.
    pub const WRITE: u8 = 5;
}

/// How far a joint may be from its reference for [`ControlLoop::reset`], rad or m.
pub const NEAR: f32 = 0.15;

/// Where the torque that the feedback need not supply comes from; `X` is what it has to know beside the
/// reference (what the hand holds, how the base moves).
pub trait Law<const V: usize, X = ()> {
    /// Whether the feed-forward brings about the reference's acceleration. If so an arm that is held
    /// is slowed down by it, coupling and all; if not, by the feedback's K_d alone.
    const ACCELERATES: bool = true;

    /// The torque for the reference, N·m or N.
    fn feedforward(reference: &State<f32, V, V>, around: &X) -> [f32; V];
}

/// Why a stopped arm does not start again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// It is not stopped.
    Running,
    /// There was no measurement in the last tick.
    Unseen,
    /// A joint is further than [`NEAR`] from where its trajectory waits.
    Far {
        /// The joint.
        joint: usize,
    },
}

/// What a tick did, for whoever logs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Telemetry<const V: usize> {
    /// Ticks since the trajectory's start, held during a fault.
    pub tick: u32,
    /// Where the joints should be, rad or m.
    pub reference: [f32; V],
    /// Where the observer has them, rad or m.
    pub estimate: [f32; V],
    /// Torque commanded, N·m or N.
    pub torque: [f32; V],
    /// What the supervisor says.
    pub status: Status,
    /// What the first encoder that gave no angle said.
    pub frame: Option<FrameError>,
}

/// The control loop of a robot with V joints.
#[derive(Debug)]
pub struct ControlLoop<Spi, Pwm, Brake, const V: usize> {
    encoders: [Encoder<Spi>; V],
    drives: [Drive<Pwm>; V],
    /// High holds the joints.
    brake: Brake,
    gains: Gains<f32, V>,
    observer: Observer<f32, V>,
    supervisor: Supervisor<f32, V>,
    rejoin: Rejoin<f32, V>,
    /// The reference's acceleration, which acts until the next tick.
    expected: [f32; V],
    clock: u32,
    /// The estimate has gone without a measurement for longer than is ridden through.
    blind: bool,
    frame: Option<FrameError>,
}

impl<Spi, Pwm, Brake, const V: usize> ControlLoop<Spi, Pwm, Brake, V>
where
    Spi: SpiDevice,
    Pwm: SetDutyCycle,
    Brake: OutputPin,
{
    /// A loop at the start of its trajectory; starts the encoders. The first tick should follow
    /// within a tick's time, or the arm stand still till then.
    pub fn new(
        mut encoders: [Encoder<Spi>; V],
        drives: [Drive<Pwm>; V],
        brake: Brake,
        gains: Gains<f32, V>,
        observer: Observer<f32, V>,
        supervisor: Supervisor<f32, V>,
        rejoin: Rejoin<f32, V>,
    ) -> Self {
        encoders.iter_mut().for_each(Encoder::start);
        Self {
            encoders,
            drives,
            brake,
            gains,
            observer,
            supervisor,
            rejoin,
            expected: [0.0; V],
            clock: 0,
            blind: false,
            frame: None,
        }
    }

    /// One tick under the law `L`.
    #[inline(never)]
    pub fn tick<L: Law<V, X>, T: Reference<f32, V>, X>(
        &mut self,
        trajectory: &T,
        around: &X,
    ) -> Telemetry<V> {
        measured::<{ region::TICK }, _>(|| {
            measured::<{ region::READ }, _>(|| self.read());
            let reference =
                measured::<{ region::REFERENCE }, _>(|| self.reference(trajectory, L::ACCELERATES));
            let torque =
                measured::<{ region::DYNAMICS }, _>(|| self.torque::<L, X>(&reference, around));
            let command = measured::<{ region::SAFETY }, _>(|| self.supervisor.pass(&torque));
            measured::<{ region::WRITE }, _>(|| self.write(&command.torque, command.brake));
            let telemetry = Telemetry {
                tick: self.clock,
                reference: reference.q,
                estimate: self.observer.estimate().q,
                torque: command.torque,
                status: command.status,
                frame: self.frame,
            };
            let moving = matches!(command.status.mode, Mode::Full) & !self.rejoin.active();
            self.clock = self.clock.saturating_add(u32::from(moving));
            telemetry
        })
    }

    /// Starts a stopped arm again: clears the fault, and leads the arm back onto its trajectory. The
    /// brake holds until the torque of rest is there, a few ticks.
    ///
    /// # Errors
    /// [`Refusal`]: nothing has changed then.
    pub fn reset<T: Reference<f32, V>>(&mut self, trajectory: &T) -> Result<(), Refusal> {
        if !matches!(self.supervisor.mode(), Mode::Stopped) {
            return Err(Refusal::Running);
        }
        if self.blind {
            return Err(Refusal::Unseen);
        }
        let goal = trajectory.at(self.clock).q;
        let mut joints = goal.iter().zip(&self.observer.estimate().q);
        let near = |(goal, q): (&f32, &f32)| (goal - q).abs() <= NEAR;
        if let Some(joint) = joints.position(|joint| !near(joint)) {
            return Err(Refusal::Far { joint });
        }
        self.supervisor.reset();
        self.rejoin.start(self.observer.estimate(), self.clock);
        self.expected = [0.0; V];
        Ok(())
    }

    /// Measures, and brings the observer and the supervisor up to date.
    #[inline(never)]
    fn read(&mut self) {
        let (mut bad, mut joint) = (None, 0);
        let q = self.encoders.each_mut().map(|encoder| {
            let angle = encoder.read();
            if let Err(error) = angle {
                bad = bad.or(Some((joint, error)));
            }
            joint += 1;
            angle.unwrap_or(0.0)
        });
        self.frame = bad.map(|(_, error)| error);
        let fault = bad.map(|(joint, _)| Fault::Encoder { joint });
        self.supervisor.admit(fault.map_or(Ok(&q), Err));
        let stopped = matches!(self.supervisor.mode(), Mode::Stopped);
        if self.supervisor.seen() & !self.blind & !stopped {
            self.observer.update_late(&q, &self.expected);
        } else {
            self.improvise(&q, fault.is_some());
        }
        self.supervisor.watch(&self.observer.estimate().qd);
    }

    /// The estimate when there is no measurement, or no torque from it.
    #[cold]
    fn improvise(&mut self, q: &[f32; V], lost: bool) {
        match self.supervisor.mode() {
            // The brake holds the arm where it is.
            Mode::Stopped => {
                self.blind = lost;
                if !lost {
                    self.observer.reset(q);
                }
            }
            _ if self.supervisor.seen() => {
                self.blind = false;
                self.observer.relocate(q);
            }
            mode => {
                self.blind |= matches!(mode, Mode::Hold);
                self.observer.predict(&self.expected);
            }
        }
    }

    /// Where the joints should be.
    #[inline(never)]
    fn reference<T: Reference<f32, V>>(
        &mut self,
        trajectory: &T,
        accelerates: bool,
    ) -> State<f32, V, V> {
        let full = matches!(self.supervisor.mode(), Mode::Full);
        if (!full | self.rejoin.active()) && !self.arrived(full) {
            return self.detour(trajectory, full, accelerates);
        }
        let reference = trajectory.at(self.clock);
        self.expected = reference.qdd;
        reference
    }

    /// Whether the way back ends in this tick.
    #[cold]
    fn arrived(&mut self, full: bool) -> bool {
        let arrived = full & (self.supervisor.authority() >= 1.0);
        if arrived {
            self.clock = self.rejoin.finish();
        }
        arrived
    }

    /// While the arm is held: where it is, its speed decaying, so that the same law brings all joints to
    /// rest together. Then the way back.
    #[cold]
    #[inline(never)]
    fn detour<T: Reference<f32, V>>(
        &mut self,
        trajectory: &T,
        full: bool,
        accelerates: bool,
    ) -> State<f32, V, V> {
        let reference = if full {
            let share = self.supervisor.authority();
            self.rejoin.at(trajectory, share)
        } else {
            self.halt(accelerates)
        };
        self.expected = reference.qdd;
        reference
    }

    /// Slows the arm down where it is. The clock stops when that begins; the way back starts anew in
    /// each of these ticks.
    fn halt(&mut self, accelerates: bool) -> State<f32, V, V> {
        if self.rejoin.active() {
            self.clock = self.rejoin.abandon();
        } else {
            self.clock = self.rejoin.meet(self.clock);
        }
        let estimate = *self.observer.estimate();
        self.rejoin.start(&estimate, self.clock);
        let mut reference = hold(&estimate, self.rejoin.decay());
        if !accelerates {
            // K_d slows the joints down.
            reference.qd = [0.0; V];
        }
        reference
    }

    /// τ = feed-forward + K_p (q_d − q) + K_d (q̇_d − q̇).
    #[inline(never)]
    fn torque<L: Law<V, X>, X>(&self, reference: &State<f32, V, V>, around: &X) -> [f32; V] {
        let mut tau = L::feedforward(reference, around);
        let estimate = self.observer.estimate();
        let pd = feedback(&self.gains, reference, &estimate.q, &estimate.qd);
        for (tau, pd) in tau.iter_mut().zip(pd) {
            *tau += pd;
        }
        tau
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
        // A drive that may not obey: the brake at once, the other drives from the next tick on.
        let set = if brake | failed.is_some() {
            self.brake.set_high()
        } else {
            self.brake.set_low()
        };
        if let Some(fault) = failed.or(set.err().map(|_| Fault::Brake)) {
            self.supervisor.stop(fault);
        }
    }
}
