//! The scene `ur5e` in place of a project's robot: what the firmware of `rtic.rs` and of the Pico 2
//! calls, which robot-import has as templates, with the pins.

use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;
use firmware_demo::scene::{self, Full, Scene, SceneLoop, SetupError, Start};
use firmware_demo::scenes::ur5e::PickAndPlace;
use motion_control::limits::Status;
use motion_control::motion::ResetError;
use motion_control::safety::{Detect, Detectors};

pub use firmware_demo::scenes::ur5e::plan;

/// A tick, s.
#[allow(dead_code, reason = "the Pico 2 has its period in microseconds")]
pub const TICK: f32 = PickAndPlace::TICK;
/// Joints.
pub const N: usize = 6;
#[allow(dead_code, reason = "the Pico 2 does not name them")]
pub type Gains = motion_control::law::Gains<f32, N>;
pub type Motion = <PickAndPlace as Scene<N, N, N, N>>::Reference;
pub type Found = Detectors<f32, N>;
pub type Law = Full<PickAndPlace, N, N, N>;
pub type Devices<Spi, Pwm, Brake> = scene::Devices<Spi, Pwm, Brake, N>;
pub type Control<Spi, Pwm, Brake, D> = SceneLoop<Spi, Pwm, Brake, N, D>;

#[inline(always)]
pub fn gains() -> Gains {
    PickAndPlace::gains(&())
}

#[inline(always)]
pub fn detectors(_: &Motion) -> Found {
    PickAndPlace::detectors()
}

/// Starts the robot by the button.
#[allow(dead_code, reason = "the Pico 2 does so in its tick")]
pub struct Operator;

#[allow(dead_code, reason = "the Pico 2 does so in its tick")]
impl Operator {
    pub const fn new(_: &Motion) -> Self {
        Self
    }

    #[cold]
    #[inline(never)]
    pub fn tick<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin, D: Detect<f32, N>>(
        &mut self,
        (_, _): (u32, &Status),
        control: &mut Control<Spi, Pwm, Brake, D>,
        motion: &Motion,
        is_pressed: bool,
        _: impl FnMut(()),
    ) -> Option<ResetError> {
        let refused = || control.reset(motion).err();
        is_pressed.then(refused).flatten()
    }
}

/// # Errors
/// As [`Scene::control_loop`].
#[inline(always)]
pub fn on_brake<Spi: SpiDevice, Pwm: SetDutyCycle, Brake: OutputPin, D: Detect<f32, N>>(
    devices: Devices<Spi, Pwm, Brake>,
    gains: Gains,
    detectors: D,
    _: &Motion,
) -> Result<Control<Spi, Pwm, Brake, D>, SetupError> {
    PickAndPlace::control_loop(devices, gains, detectors, Start::OnBrake)
}
