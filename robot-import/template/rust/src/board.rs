//! Encoders, drives and the brake, on the traits of embedded-hal: adapt the frame and the scales to your parts.

use joint_drivers::MultiTurnEncoder;
use motion_control::{Command, Fault};
use embedded_hal::{digital::OutputPin, pwm::SetDutyCycle, spi::SpiDevice};

use crate::scene::N;

/// Bits of an encoder's angle.
pub const BITS: u32 = 14;
/// One count of an encoder, rad.
pub const RESOLUTION: f32 = core::f32::consts::TAU / (1_u32 << BITS) as f32;

/// An absolute encoder at a joint.
#[derive(Debug)]
pub struct Encoder<Spi> {
    spi: Spi,
    turns: MultiTurnEncoder<BITS>,
    /// The joint's position where the encoder reads zero, rad or m.
    zero: f32,
    /// Radians of the joint per radian of the encoder, or metres; negative if they turn in opposite directions.
    ratio: f32,
}

impl<Spi: SpiDevice> Encoder<Spi> {
    /// An encoder whose first angle lies within half a turn of zero.
    pub fn new(spi: Spi, zero: f32, ratio: f32) -> Self {
        let turns = MultiTurnEncoder::new();
        Self {
            spi,
            turns,
            zero,
            ratio,
        }
    }

    /// The joint's position, rad or m. Here a frame is the angle in two bytes; your part has others, with a check.
    fn position(&mut self) -> Option<f32> {
        let mut frame = [0; 2];
        self.spi.read(&mut frame).ok()?;
        self.turns.update(u16::from_be_bytes(frame));
        Some(self.zero + self.ratio * self.turns.angle::<f32>())
    }
}

/// A current-controlled drive: half duty is zero torque.
#[derive(Debug)]
pub struct Drive<Pwm> {
    pwm: Pwm,
    /// Steps of duty per torque, 1/(N·m) or 1/N.
    slope: f32,
    zero: f32,
    /// What the last duty left out, in steps.
    rest: f32,
}

impl<Pwm: SetDutyCycle> Drive<Pwm> {
    /// A drive that delivers `full_scale` at full duty, N·m or N.
    pub fn new(pwm: Pwm, full_scale: f32) -> Self {
        let zero = f32::from(pwm.max_duty_cycle()) * 0.5;
        let slope = zero / full_scale;
        Self {
            pwm,
            slope,
            zero,
            rest: 0.0,
        }
    }

    fn set(&mut self, torque: f32) -> Result<(), Pwm::Error> {
        // What a step of duty cannot express is left for the next tick: a light joint then has the mean torque.
        let wanted = self.zero + self.slope * torque + self.rest;
        // The conversion saturates, and the supervisor's torques are finite and within the full scale.
        let duty = (wanted + 0.5) as u16;
        self.rest = (wanted - f32::from(duty)).clamp(-0.5, 0.5);
        self.pwm.set_duty_cycle(duty)
    }
}

/// The devices of all joints.
#[derive(Debug)]
pub struct Board<Spi, Pwm, Brake> {
    /// The encoders, in the order of the joints.
    pub encoders: [Encoder<Spi>; N],
    /// The drives.
    pub drives: [Drive<Pwm>; N],
    /// High holds the joints.
    pub brake: Brake,
}

impl<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin> Board<Spi, Pwm, Brake> {
    /// The positions of the joints, rad or m.
    ///
    /// # Errors
    /// [`Fault::Encoder`].
    pub fn positions(&mut self) -> Result<[f32; N], Fault> {
        let mut positions = [0.0; N];
        let each = positions.iter_mut().zip(&mut self.encoders);
        for (joint, (position, encoder)) in each.enumerate() {
            *position = encoder.position().ok_or(Fault::Encoder { joint })?;
        }
        Ok(positions)
    }

    /// Writes a command.
    ///
    /// # Errors
    /// [`Fault::Drive`] or [`Fault::Brake`]; the brake is then set.
    pub fn drive(&mut self, command: &Command<f32, N>) -> Result<(), Fault> {
        let mut result = Ok(());
        let each = self.drives.iter_mut().zip(command.torque);
        for (joint, (drive, torque)) in each.enumerate() {
            if drive.set(torque).is_err() {
                result = result.and(Err(Fault::Drive { joint }));
            }
        }
        let held = match command.brake || result.is_err() {
            true => self.brake.set_high(),
            false => self.brake.set_low(),
        };
        result.and(held.map_err(|_| Fault::Brake))
    }
}
