//! The connections: this is the one file with pins, clocks and timers.
//!
//! A line that ends in the number of a joint is that joint's own. PA11 and PA12 are left for FDCAN1,
//! PB12 and PB13 for FDCAN2.

use board_support::encoders::{self, encoders};
use board_support::stm32g4::spi_and_pwm::{Bus, Channel};
use embedded_hal_bus::util::AtomicCell;
use stm32g4xx_hal::gpio::{AnyPin, Input, Output, PA5, PB10, PC13, Speed};
use stm32g4xx_hal::pac::{IWDG, Peripherals, TIM1, TIM2, TIM8};
use stm32g4xx_hal::prelude::*;
use stm32g4xx_hal::pwr::VoltageScale;
use stm32g4xx_hal::rcc::{Config, PllConfig, PllMDiv, PllNMul, PllRDiv, PllSrc, Rcc};
use stm32g4xx_hal::time::RateExtU32;

use crate::board::{self, N};

pub use board_support::stm32g4 as chip;

/// An encoder's part of the bus.
type Encoder = encoders::Encoder<'static, Bus, AnyPin<Output>>;

/// A high level holds the joints.
pub type Brake = PB10<Output>;
/// The blue button, to the supply.
pub type Button = PC13<Input>;
/// The green light.
pub type Light = PA5<Output>;

/// The memory of the bus.
pub struct Kept(Option<AtomicCell<Bus>>);

impl Kept {
    pub const NONE: Self = Self(None);
}

pub type Devices = board::Devices<Encoder, Channel, Brake>;
pub type Control<Detect> = board::Control<Encoder, Channel, Brake, Detect>;

/// Whether the button is pressed.
pub fn is_pressed(button: &Button) -> bool {
    button.is_high()
}

/// 170 MHz from the crystal's 24 MHz.
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

/// Configures the pins: the brake set, the drives without torque.
#[inline(always)]
pub fn connect(device: Peripherals, kept: &'static mut Kept) -> Connected {
    let high = true.into();
    // The flash has four wait states, and reads ahead; its caches are on after a reset.
    device.FLASH.acr().modify(|_, w| w.prften().set_bit());
    // PB4 is pulled down after a reset, for USB.
    device.PWR.cr3().modify(|_, w| w.ucpd1_dbdis().set_bit());
    let boost = VoltageScale::Range1 { enable_boost: true };
    let power = device.PWR.constrain().vos(boost).freeze();
    let mut rcc = device.RCC.freeze(clocks(), power);
    let (a, b, c) = (
        device.GPIOA.split(&mut rcc),
        device.GPIOB.split(&mut rcc),
        device.GPIOC.split(&mut rcc),
    );
    // The brake first.
    let brake = b.pb10.into_push_pull_output_in_state(high);

    // SCK, MISO and MOSI. PB3 and PB4 are those of JTAG after a reset.
    let pins = (
        b.pb3.into_alternate().speed(Speed::High),
        b.pb4.into_alternate(),
        b.pb5.into_alternate().speed(Speed::High),
    );
    let spi = Bus::new(device.SPI1, pins, &mut rcc);
    let bus = kept.0.insert(AtomicCell::new(spi));
    let selects = [
        c.pc0.into_push_pull_output_in_state(high).erase(), // joint 1
        c.pc1.into_push_pull_output_in_state(high).erase(), // joint 2
        c.pc2.into_push_pull_output_in_state(high).erase(), // joint 3
        c.pc3.into_push_pull_output_in_state(high).erase(), // joint 4
        b.pb0.into_push_pull_output_in_state(high).erase(), // joint 5
        b.pb1.into_push_pull_output_in_state(high).erase(), // joint 6
    ];

    // 20 kHz. A channel that no joint has stays off.
    let pins = (
        a.pa8.into_alternate(),
        a.pa9.into_alternate(),
        a.pa10.into_alternate(),
    );
    let first = device.TIM1.pwm(pins, 20.kHz(), &mut rcc);
    let pins = (
        c.pc6.into_alternate(),
        c.pc7.into_alternate(),
        c.pc8.into_alternate(),
    );
    let second = device.TIM8.pwm(pins, 20.kHz(), &mut rcc);
    // SAFETY: from here on only the channels use these timers, each its own register.
    let (one, two) = unsafe { (&*TIM1::ptr(), &*TIM8::ptr()) };
    let channels: [Channel; N] = [
        Channel::new(first.0, one.ccr1()),  // joint 1
        Channel::new(first.1, one.ccr2()),  // joint 2
        Channel::new(first.2, one.ccr3()),  // joint 3
        Channel::new(second.0, two.ccr1()), // joint 4
        Channel::new(second.1, two.ccr2()), // joint 5
        Channel::new(second.2, two.ccr3()), // joint 6
    ];

    Connected {
        devices: Devices {
            encoders: encoders(bus, selects),
            drives: channels,
            brake,
        },
        button: c.pc13.into_floating_input(),
        light: a.pa5.into_push_pull_output(),
        timer: device.TIM2,
        watchdog: device.IWDG,
        rcc,
    }
}
