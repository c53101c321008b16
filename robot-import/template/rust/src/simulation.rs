//! The robot and its devices, simulated: replaced by your board.

use core::cell::Cell;
use core::convert::Infallible;
use core::f32::consts::TAU;

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::model::Calibrated;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};
use joint_drivers::Direction;

use crate::board::{BITS, Drive, Encoder};
use crate::control::{SetupError, encoder_mappings};
use crate::scene::{Arm, EFFECTS, Effects, Motion, N, TICK, encoder_ratios};

/// Steps of the simulation in a tick.
const STEPS: u8 = 2;
/// The duty that a simulated timer counts to.
const MAX_DUTY: u16 = 16_800;

/// The wires between the board and the simulated robot.
#[derive(Debug)]
pub struct Wires {
    angles: [Cell<u16>; N],
    duties: [Cell<u16>; N],
    brake: Cell<bool>,
}

impl Wires {
    /// Encoders at zero, drives at zero torque, no brake.
    pub fn new() -> Self {
        Self {
            angles: [const { Cell::new(0) }; N],
            duties: [const { Cell::new(MAX_DUTY / 2) }; N],
            brake: Cell::new(false),
        }
    }

    /// The encoders, which read zero at the positions `zero`, rad or m.
    ///
    /// # Errors
    /// [`SetupError::Encoder`].
    pub fn encoders(
        &self,
        motion: &Motion,
        zero: &[f32; N],
    ) -> Result<[Encoder<SimEncoder<'_>>; N], SetupError> {
        let ratio = encoder_ratios();
        let at_zero = core::array::from_fn(|joint| -zero[joint] / ratio[joint]);
        let mappings = encoder_mappings(motion, &at_zero, &[Direction::Forward; N])?;
        Ok(core::array::from_fn(|joint| {
            Encoder::new(SimEncoder(&self.angles[joint]), mappings[joint])
        }))
    }

    /// The drives, which deliver `full_scale` at full duty, N·m or N.
    pub fn drives(&self, full_scale: &[f32; N]) -> [Drive<SimDrive<'_>>; N] {
        core::array::from_fn(|joint| Drive::new(SimDrive(&self.duties[joint]), full_scale[joint]))
    }

    /// The brake.
    pub fn brake(&self) -> SimBrake<'_> {
        SimBrake(&self.brake)
    }
}

impl Default for Wires {
    fn default() -> Self {
        Self::new()
    }
}

/// The simulated robot.
#[derive(Debug)]
pub struct Plant {
    robot: Calibrated<Arm, f32, N, N, N>,
    effects: Effects,
    zero: [f32; N],
    ratio: [f32; N],
    full_scale: [f32; N],
    /// Where it is.
    pub state: State<f32, N, N>,
}

impl Plant {
    /// At rest at `zero`, where its encoders read zero.
    pub fn new(zero: [f32; N], full_scale: [f32; N]) -> Self {
        Self {
            robot: Calibrated::nominal(),
            effects: EFFECTS,
            zero,
            ratio: encoder_ratios(),
            full_scale,
            state: State::at(zero),
        }
    }

    /// Moves on by a tick under the duties of now, and shows the encoders where the robot is.
    ///
    /// # Errors
    /// A joint moves no inertia.
    pub fn advance(&mut self, wires: &Wires) -> Result<(), NotPositiveDefinite> {
        if wires.brake.get() {
            self.state = State::at(self.state.q);
            return Ok(());
        }
        let half = f32::from(MAX_DUTY) * 0.5;
        let torque = core::array::from_fn(|joint| {
            (f32::from(wires.duties[joint].get()) / half - 1.0) * self.full_scale[joint]
        });
        for _ in 0..STEPS {
            let step = TICK / f32::from(STEPS);
            linearly_implicit(
                &self.robot,
                &mut self.state,
                &torque,
                &mut self.effects,
                step,
            )?;
        }
        for (joint, angle) in wires.angles.iter().enumerate() {
            let turned = (self.state.q[joint] - self.zero[joint]) / self.ratio[joint];
            let counts = turned * ((1_u32 << BITS) as f32 / TAU);
            let nearest = counts + if counts < 0.0 { -0.5 } else { 0.5 };
            angle.set((nearest as i32 & ((1 << BITS) - 1)) as u16);
        }
        Ok(())
    }
}

/// An encoder.
#[derive(Debug)]
pub struct SimEncoder<'a>(&'a Cell<u16>);

impl spi::ErrorType for SimEncoder<'_> {
    type Error = Infallible;
}

impl SpiDevice for SimEncoder<'_> {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            if let Operation::Read([high, low]) = operation {
                [*high, *low] = self.0.get().to_be_bytes();
            }
        }
        Ok(())
    }
}

/// The PWM channel of a drive.
#[derive(Debug)]
pub struct SimDrive<'a>(&'a Cell<u16>);

impl pwm::ErrorType for SimDrive<'_> {
    type Error = Infallible;
}

impl SetDutyCycle for SimDrive<'_> {
    fn max_duty_cycle(&self) -> u16 {
        MAX_DUTY
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0.set(duty);
        Ok(())
    }
}

/// The pin of the brake.
#[derive(Debug)]
pub struct SimBrake<'a>(&'a Cell<bool>);

impl digital::ErrorType for SimBrake<'_> {
    type Error = Infallible;
}

impl OutputPin for SimBrake<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set(false);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set(true);
        Ok(())
    }
}
