//! The connections: this is the one file with pins and clocks.

use board_support::stm32g4::can::Bus;
use stm32g4xx_hal::gpio::{AF9, Input, Output, PA5, PA11, PA12, PB10, PC13};
use stm32g4xx_hal::pac::{IWDG, Peripherals, TIM2};
use stm32g4xx_hal::prelude::*;
use stm32g4xx_hal::pwr::VoltageScale;
use stm32g4xx_hal::rcc::{Config, PllConfig, PllMDiv, PllNMul, PllRDiv, PllSrc, Rcc};
use stm32g4xx_hal::time::RateExtU32;

use crate::board::{self, Joints};

pub use board_support::stm32g4 as chip;

/// A high level holds the joints.
pub type Brake = PB10<Output>;
/// The blue button, to the supply.
pub type Button = PC13<Input>;
/// The green light.
pub type Light = PA5<Output>;

/// The memory of the drives.
pub struct Kept(Option<Joints<Bus>>);

impl Kept {
    pub const NONE: Self = Self(None);
}

pub type Devices = board::Devices<Bus, Brake>;
pub type Control<Detect> = board::Control<Bus, Brake, Detect>;

/// Whether the button is pressed.
pub fn is_pressed(button: &Button) -> bool {
    button.is_high()
}

/// 170 MHz from the crystal's 24 MHz, which are the clock of CAN, too.
pub fn clocks() -> Config {
    Config::pll().boost(true).pll_cfg(PllConfig {
        mux: PllSrc::HSE(24.MHz()),
        m: PllMDiv::DIV_6,
        n: PllNMul::MUL_85,
        r: Some(PllRDiv::DIV_2),
        ..PllConfig::default()
    })
}

/// The board and what is connected to it.
pub struct Connected {
    pub devices: Devices,
    pub button: Button,
    pub light: Light,
    pub timer: TIM2,
    pub watchdog: IWDG,
    pub rcc: Rcc,
}

/// Configures the pins: the brake set.
#[inline(always)]
pub fn connect(device: Peripherals, kept: &'static mut Kept) -> Connected {
    // The flash has four wait states, and reads ahead; its caches are on after a reset.
    device.FLASH.acr().modify(|_, w| w.prften().set_bit());
    let boost = VoltageScale::Range1 { enable_boost: true };
    let power = device.PWR.constrain().vos(boost).freeze();
    let mut rcc = device.RCC.freeze(clocks(), power);
    let (a, b, c) = (
        device.GPIOA.split(&mut rcc),
        device.GPIOB.split(&mut rcc),
        device.GPIOC.split(&mut rcc),
    );
    // The brake first.
    let brake = b.pb10.into_push_pull_output_in_state(true.into());
    let _: (PA12<AF9>, PA11<AF9>) = (a.pa12.into_alternate(), a.pa11.into_alternate());
    let bus = Bus::start(device.FDCAN1, &mut rcc);
    let joints = &mut kept.0;
    Connected {
        devices: Devices { bus, joints, brake },
        button: c.pc13.into_floating_input(),
        light: a.pa5.into_push_pull_output(),
        timer: device.TIM2,
        watchdog: device.IWDG,
        rcc,
    }
}
