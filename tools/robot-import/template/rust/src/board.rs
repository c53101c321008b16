//! Encoders and drives, on the traits of embedded-hal: adapt the frame and the scales to your
//! parts.
//!
//! `joint-drivers` has the common ones, which the control loop takes as they are.

use embedded_hal::pwm::{Error as _, SetDutyCycle};
use embedded_hal::spi::{Error as _, SpiDevice};
use joint_drivers::as5047p::FrameError;
use joint_drivers::h_bridge::DriveError;
use joint_drivers::{
    EncoderMapping, EncoderType, JointDrive, JointEncoder, LostTurn, MultiTurnEncoder,
};
use motion_control::{limits::Fault, motion::CurrentTick};

/// Bits of an encoder's angle.
pub const BITS: u32 = 14;
/// One count of an encoder, rad.
pub const RESOLUTION: f32 = core::f32::consts::TAU / (1_u32 << BITS) as f32;

/// An absolute encoder at a joint.
#[derive(Debug)]
pub struct Encoder<Spi> {
    spi: Spi,
    turns: MultiTurnEncoder<BITS>,
}

impl<Spi: SpiDevice> Encoder<Spi> {
    /// An encoder that has not been read yet; the first angle is where the mapping says that the
    /// joint can be.
    pub fn new(spi: Spi, mapping: EncoderMapping) -> Self {
        let turns = MultiTurnEncoder::new(mapping);
        Self { spi, turns }
    }
}

impl<Spi> EncoderType for Encoder<Spi> {
    type Error = FrameError;
    /// The age of the angle that it answers with: `PreviousTick` for one that was latched in the
    /// frame before.
    type Age = CurrentTick;

    fn missed(&mut self, ticks: u32) {
        self.turns.missed(ticks);
    }

    fn fault(error: &FrameError, joint: usize) -> Fault {
        match error {
            FrameError::LostTurn => Fault::LostTurn { joint },
            _ => Fault::Encoder { joint },
        }
    }
}

impl<Spi: SpiDevice> JointEncoder for Encoder<Spi> {
    /// Here a frame is the angle in two bytes; your part has others, with a check.
    fn sample(&mut self) -> Result<(), FrameError> {
        let mut frame = [0; 2];
        if let Err(error) = self.spi.read(&mut frame) {
            self.turns.missed(1);
            return Err(FrameError::Bus(error.kind()));
        }
        let update = self.turns.update(u16::from_be_bytes(frame));
        update.map_err(|LostTurn| FrameError::LostTurn)
    }

    fn position(&self) -> f32 {
        self.turns.position()
    }
}

/// A current-controlled drive: half duty is zero torque.
#[derive(Debug)]
pub struct Drive<Pwm> {
    pwm: Pwm,
    /// Steps of duty per torque, 1/(N·m) or 1/N.
    slope: f32,
    zero: f32,
    /// The remainder of the last duty, in steps.
    rest: f32,
}

impl<Pwm: SetDutyCycle> Drive<Pwm> {
    /// A drive that delivers `full_scale` at full duty, N·m or N.
    pub fn new(pwm: Pwm, full_scale: f32) -> Self {
        let zero = f32::from(pwm.max_duty_cycle()) * 0.5;
        let slope = zero / full_scale;
        Self { pwm, slope, zero, rest: 0.0 }
    }
}

impl<Pwm: SetDutyCycle> JointDrive for Drive<Pwm> {
    type Error = DriveError;
    /// The setpoint is in steps of duty.
    type Setpoint = f32;

    fn setpoint(&self, torque: f32) -> f32 {
        self.zero + self.slope * torque
    }

    fn set(&mut self, steps: f32) -> Result<(), DriveError> {
        // The remainder that a step of duty cannot express is left for the next tick: a light joint
        // then has the mean torque.
        let wanted = steps + self.rest;
        // The conversion saturates, and the controller's torques are finite and within the full
        // scale.
        let duty = (wanted + 0.5) as u16;
        self.rest = (wanted - f32::from(duty)).clamp(-0.5, 0.5);
        let set = self.pwm.set_duty_cycle(duty);
        set.map_err(|error| DriveError::Pwm(error.kind()))
    }
}
