//! The wires of a simulated robot: encoders that quantise and drives that know only their duty,
//! behind the same `embedded-hal` traits as the real ones. Their transfers are inside the measured
//! regions.

use core::convert::Infallible;
use core::sync::atomic::{AtomicU16, AtomicU32, Ordering::Relaxed};

use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};
use joint_drivers::as5047p::{ERROR, READ_ANGLE, READ_ERRORS, encode, quantise, with_parity};

/// The duty that a simulated timer counts to: 20 kHz from 168 MHz.
pub const MAX_DUTY: u16 = 8400;

/// The wires between firmware and robot: one encoder and one duty per joint.
#[derive(Debug)]
pub struct Wires<const N: usize> {
    /// The answers that hold the angles of now, and above them [`FLAG`].
    encoders: [AtomicU32; N],
    duties: [AtomicU16; N],
}

impl<const N: usize> Wires<N> {
    /// Encoders at zero, drives at zero torque.
    pub const fn new() -> Self {
        Self {
            encoders: [const { AtomicU32::new(encode(0) as u32) }; N],
            duties: [const { AtomicU16::new(MAX_DUTY / 2) }; N],
        }
    }

    /// The SPI device of joint j's encoder.
    pub fn encoder(&'static self, j: usize) -> SimEncoder {
        SimEncoder { wire: &self.encoders[j], answer: GARBAGE }
    }

    /// Lets joint j's encoder find an error: its answers carry the error flag until its error
    /// register is read.
    pub fn flag(&self, j: usize) {
        let encoder = &self.encoders[j];
        encoder.store(encoder.load(Relaxed) | FLAG, Relaxed);
    }

    /// Shows the encoders these positions, rad or m.
    pub fn publish(&self, positions: &[f32; N]) {
        for (encoder, &q) in self.encoders.iter().zip(positions) {
            let flag = encoder.load(Relaxed) & FLAG;
            encoder.store(u32::from(encode(quantise(q))) | flag, Relaxed);
        }
    }

    /// Lets the encoders answer with these frames, from the first joint on.
    pub fn answer(&self, frames: &[u16]) {
        for (encoder, &frame) in self.encoders.iter().zip(frames) {
            encoder.store(frame.into(), Relaxed);
        }
    }

    /// The duties of the drives, in counts of their timers.
    pub fn counts(&self) -> [u16; N] {
        self.duties.each_ref().map(|duty| duty.load(Relaxed))
    }

    /// The commanded share of the full torque of each drive, -1 to 1.
    pub fn duties(&self) -> [f32; N] {
        (self.duties.each_ref())
            .map(|duty| f32::from(duty.load(Relaxed)) * (2.0 / f32::from(MAX_DUTY)) - 1.0)
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

/// The answer of an encoder before the first request: not a valid angle.
const GARBAGE: u16 = encode(0x2a5a);

/// The encoder has found an error that has not been read yet.
const FLAG: u32 = 1 << 31;

/// A simulated encoder on SPI, which answers the frame before.
#[derive(Clone, Debug)]
pub struct SimEncoder {
    wire: &'static AtomicU32,
    /// The content of the next frame.
    answer: u16,
}

impl SimEncoder {
    /// The answer that is latched at the end of a frame with this command.
    #[inline(always)]
    fn latch(&self, command: u16) -> u16 {
        let wire = self.wire.load(Relaxed);
        if command == READ_ANGLE && wire & FLAG == 0 {
            return wire as u16;
        }
        self.latch_rare(command, wire)
    }

    #[cold]
    fn latch_rare(&self, command: u16, wire: u32) -> u16 {
        let flagged = wire & FLAG != 0;
        let error = if flagged { ERROR } else { 0 };
        let (answer, flag) = match command {
            READ_ANGLE => (wire as u16, wire & FLAG),
            READ_ERRORS => (u16::from(flagged), 0),
            _ => (0, FLAG),
        };
        self.wire.store(wire & !FLAG | flag, Relaxed);
        with_parity(answer | error)
    }
}

impl spi::ErrorType for SimEncoder {
    type Error = Infallible;
}

impl SpiDevice for SimEncoder {
    /// Frames are transfers in place of two bytes, which is all that the firmware sends.
    #[inline(always)]
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            if let Operation::TransferInPlace([high, low]) = operation {
                let command = u16::from_be_bytes([*high, *low]);
                [*high, *low] = self.answer.to_be_bytes();
                self.answer = self.latch(command);
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
