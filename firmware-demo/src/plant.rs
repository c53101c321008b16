//! A simulated robot behind the same `embedded-hal` traits as the real one.
//!
//! Forward dynamics under the scene's effects at a finer step than the tick, encoders that
//! quantise, drives that know only their duty. Nothing here is in a measured region.

use core::convert::Infallible;
use core::sync::atomic::{AtomicU16, Ordering::Relaxed};

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::Effect;
use dynamics_core::model::Model;
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};

use crate::encoder::{encode, quantise};

/// The duty that a simulated timer counts to: 20 kHz from 168 MHz.
pub const MAX_DUTY: u16 = 8400;

/// The wires between firmware and robot: one encoder count and one duty per joint.
#[derive(Debug)]
pub struct Wires<const N: usize> {
    counts: [AtomicU16; N],
    duties: [AtomicU16; N],
}

impl<const N: usize> Wires<N> {
    /// Encoders at zero, drives at zero torque.
    pub const fn new() -> Self {
        Self {
            counts: [const { AtomicU16::new(0) }; N],
            duties: [const { AtomicU16::new(MAX_DUTY / 2) }; N],
        }
    }

    /// The SPI device of joint j's encoder.
    pub fn encoder(&'static self, j: usize) -> SimEncoder {
        SimEncoder(&self.counts[j])
    }

    /// The PWM channel of joint j's drive.
    pub fn drive(&'static self, j: usize) -> SimDrive {
        SimDrive(&self.duties[j])
    }
}

impl<const N: usize> Default for Wires<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// A simulated encoder on SPI.
#[derive(Clone, Copy, Debug)]
pub struct SimEncoder(&'static AtomicU16);

impl spi::ErrorType for SimEncoder {
    type Error = Infallible;
}

impl SpiDevice for SimEncoder {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        let answer = encode(self.0.load(Relaxed)).to_be_bytes();
        for operation in operations {
            match operation {
                Operation::Read(words)
                | Operation::TransferInPlace(words)
                | Operation::Transfer(words, _) => {
                    for (word, byte) in words.iter_mut().zip(answer) {
                        *word = byte;
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// A simulated PWM channel.
#[derive(Clone, Copy, Debug)]
pub struct SimDrive(&'static AtomicU16);

impl pwm::ErrorType for SimDrive {
    type Error = Infallible;
}

impl SetDutyCycle for SimDrive {
    fn max_duty_cycle(&self) -> u16 {
        MAX_DUTY
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0.store(duty, Relaxed);
        Ok(())
    }
}

/// The simulated robot.
#[derive(Debug)]
pub struct Plant<E, const B: usize, const N: usize> {
    model: Model<f32, B, N, N>,
    effects: E,
    full_scale: [f32; N],
    /// Position, velocity and acceleration, beyond what the encoders tell.
    pub state: State<f32, N, N>,
}

impl<E: Effect<f32, B, N>, const B: usize, const N: usize> Plant<E, B, N> {
    /// A robot at rest at q, whose drives deliver `full_scale` at full duty.
    pub fn new(model: Model<f32, B, N, N>, effects: E, full_scale: [f32; N], q: [f32; N]) -> Self {
        Self {
            model,
            effects,
            full_scale,
            state: State::at(q),
        }
    }

    /// Shows the encoders the present positions.
    pub fn publish(&self, wires: &Wires<N>) {
        for (count, &q) in wires.counts.iter().zip(&self.state.q) {
            count.store(quantise(q), Relaxed);
        }
    }

    /// Moves on by `steps` steps of `h` seconds under the duties of now, and publishes.
    ///
    /// # Errors
    /// As forward dynamics.
    pub fn advance(
        &mut self,
        wires: &Wires<N>,
        steps: u32,
        h: f32,
    ) -> Result<(), NotPositiveDefinite> {
        let mut tau = self.full_scale;
        for (tau, duty) in tau.iter_mut().zip(&wires.duties) {
            *tau *= f32::from(duty.load(Relaxed)) * (2.0 / f32::from(MAX_DUTY)) - 1.0;
        }
        for _ in 0..steps {
            semi_implicit(&self.model, &mut self.state, &tau, &self.effects, h)?;
        }
        self.publish(wires);
        Ok(())
    }
}
