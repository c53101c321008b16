//! The tick: read, reference, dynamics, safety, write.
//!
//! The loop owns its encoders, drives and brake through `embedded-hal` traits and keeps nothing
//! else from tick to tick but its clock, observer and supervisor.

use dynamics_core::control::{
    Estimate, Fault, Gains, Mode, Observer, Status, Supervisor, Trajectory, feedback,
};
use dynamics_core::state::State;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;

use crate::drive::Drive;
use crate::encoder::Encoder;
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
    /// Limits and state machine.
    pub const SAFETY: u8 = 4;
    /// Drives and brake.
    pub const WRITE: u8 = 5;
}

/// Where the torque that the feedback need not supply comes from.
pub trait Law<const V: usize> {
    /// The torque for the reference, N·m or N.
    fn feedforward(reference: &State<f32, V, V>) -> [f32; V];
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
    expected: [f32; V],
    clock: u32,
}

impl<Spi, Pwm, Brake, const V: usize> ControlLoop<Spi, Pwm, Brake, V>
where
    Spi: SpiDevice,
    Pwm: SetDutyCycle,
    Brake: OutputPin,
{
    /// A loop at the start of its trajectory.
    pub fn new(
        encoders: [Encoder<Spi>; V],
        drives: [Drive<Pwm>; V],
        brake: Brake,
        gains: Gains<f32, V>,
        observer: Observer<f32, V>,
        supervisor: Supervisor<f32, V>,
    ) -> Self {
        let expected = [0.0; V];
        Self {
            encoders,
            drives,
            brake,
            gains,
            observer,
            supervisor,
            expected,
            clock: 0,
        }
    }

    /// One tick under the law `L`.
    #[inline(never)]
    pub fn tick<L: Law<V>, const W: usize>(
        &mut self,
        trajectory: &Trajectory<f32, V, W>,
    ) -> Telemetry<V> {
        measured::<{ region::TICK }, _>(|| {
            let (mode, estimate) = measured::<{ region::READ }, _>(|| self.read());
            let reference =
                measured::<{ region::REFERENCE }, _>(|| self.reference(trajectory, mode));
            let torque =
                measured::<{ region::DYNAMICS }, _>(|| self.torque::<L>(&reference, &estimate));
            let command = measured::<{ region::SAFETY }, _>(|| self.supervisor.pass(&torque));
            measured::<{ region::WRITE }, _>(|| self.write(&command.torque, command.brake));
            let telemetry = Telemetry {
                tick: self.clock,
                reference: reference.q,
                estimate: estimate.q,
                torque: command.torque,
                status: command.status,
            };
            self.clock += u32::from(matches!(command.status.mode, Mode::Full));
            telemetry
        })
    }

    /// Clears a latched fault; the brake stays until the next tick.
    pub fn reset(&mut self) {
        self.supervisor.reset();
    }

    /// Measured positions, whether they may be used, and the estimate to act on.
    #[inline(never)]
    fn read(&mut self) -> (Mode, Estimate<f32, V>) {
        let mut q = [0.0; V];
        let mut fault = None;
        for (j, (q, encoder)) in q.iter_mut().zip(&mut self.encoders).enumerate() {
            match encoder.read() {
                Ok(angle) => *q = angle,
                Err(_) => fault = Some(Fault::Encoder { joint: j }),
            }
        }
        let estimate = match self.supervisor.admit(fault.map_or(Ok(&q), Err)) {
            Mode::Full => self.observer.update(&q, &self.expected),
            _ => self.observer.predict(&[0.0; V]),
        };
        let mode = self.supervisor.watch(&estimate.qd);
        if matches!(mode, Mode::Full) {
            return (mode, estimate);
        }
        // Without a measurement: the last good position, and damping on a speed that fades.
        let fade = self.supervisor.hold_fade();
        let held = Estimate {
            q: *self.supervisor.last_good(),
            qd: estimate.qd.map(|qd| qd * fade),
        };
        (mode, held)
    }

    /// Where the joints should be; rest at the last good position while a fault lasts, so that the
    /// same dynamics then yields the gravity torque.
    #[inline(never)]
    fn reference<const W: usize>(
        &mut self,
        trajectory: &Trajectory<f32, V, W>,
        mode: Mode,
    ) -> State<f32, V, V> {
        let reference = if matches!(mode, Mode::Full) {
            trajectory.at(self.clock)
        } else {
            State::at(*self.supervisor.last_good())
        };
        self.expected = reference.qdd;
        reference
    }

    /// τ = feed-forward + K_p (q_d − q) + K_d (q̇_d − q̇).
    #[inline(never)]
    fn torque<L: Law<V>>(
        &self,
        reference: &State<f32, V, V>,
        estimate: &Estimate<f32, V>,
    ) -> [f32; V] {
        let mut tau = L::feedforward(reference);
        let pd = feedback(&self.gains, reference, &estimate.q, &estimate.qd);
        for (tau, pd) in tau.iter_mut().zip(pd) {
            *tau += pd;
        }
        tau
    }

    #[inline(never)]
    fn write(&mut self, torque: &[f32; V], brake: bool) {
        for (drive, &torque) in self.drives.iter_mut().zip(torque) {
            // A PWM channel that refuses leaves its joint to the supervisor's limits.
            let _ = drive.set(torque);
        }
        let _ = if brake {
            self.brake.set_high()
        } else {
            self.brake.set_low()
        };
    }
}
