//! The connections: this is the one file with pins, clocks and timers.
//!
//! A line that ends in the number of a joint is that joint's own.

use board_support::encoders::{self, encoders};
use board_support::stm32f4::drives;
use embedded_hal_bus::util::AtomicCell;
use stm32f4xx_hal::gpio::{AnyPin, Input, Output, PA5, PB12, PC13};
use stm32f4xx_hal::hal::spi::MODE_1;
use stm32f4xx_hal::pac::{IWDG, Peripherals, SPI1, TIM1, TIM2, TIM8};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Rcc};
use stm32f4xx_hal::spi::Spi;

use crate::board;

pub use board_support::stm32f4 as chip;

/// The bus of the encoders.
pub type Bus = Spi<SPI1>;
/// An encoder's part of the bus.
type Encoder = encoders::Encoder<'static, Bus, AnyPin<Output>>;
/// A drive's channel of the timers: of the joints 1 to 4, and of those behind them.
type Channel = chip::Channel<TIM1, TIM8>;
/// A high level holds the joints.
pub type Brake = PB12<Output>;
/// The blue button, to ground.
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
    button.is_low()
}

/// 168 MHz from the 8 MHz of the ST-LINK: five wait states of the flash at 3.3 V, with its
/// accelerator.
pub fn clocks() -> Config {
    Config::hse(8.MHz())
        .bypass_hse_oscillator()
        .sysclk(168.MHz())
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
    let mut rcc = device.RCC.freeze(clocks());
    let (a, b, c) = (
        device.GPIOA.split(&mut rcc),
        device.GPIOB.split(&mut rcc),
        device.GPIOC.split(&mut rcc),
    );
    let high = true.into();
    // The brake first.
    let brake = b.pb12.into_push_pull_output_in_state(high);

    // SCK, MISO and MOSI. PB3 and PB4 are those of JTAG after a reset.
    let (clock, miso) = (b.pb3.into_floating_input(), b.pb4.into_floating_input());
    let pins = (Some(clock), Some(miso), Some(b.pb5));
    let spi = Spi::new(device.SPI1, pins, MODE_1, 10.MHz(), &mut rcc);
    let bus = kept.0.insert(AtomicCell::new(spi));
    let selects = [
        c.pc0.into_push_pull_output_in_state(high).erase(), // joint 1
        c.pc1.into_push_pull_output_in_state(high).erase(), // joint 2
        c.pc2.into_push_pull_output_in_state(high).erase(), // joint 3
        c.pc3.into_push_pull_output_in_state(high).erase(), // joint 4
        b.pb0.into_push_pull_output_in_state(high).erase(), // joint 5
        b.pb1.into_push_pull_output_in_state(high).erase(), // joint 6
    ];

    // 20 kHz.
    let (_, first) = device.TIM1.pwm_hz(20.kHz(), &mut rcc);
    let (_, second) = device.TIM8.pwm_hz(20.kHz(), &mut rcc); // joint 5
    let channels = [
        Channel::First(first.0.with(a.pa8).erase()),   // joint 1
        Channel::First(first.1.with(a.pa9).erase()),   // joint 2
        Channel::First(first.2.with(a.pa10).erase()),  // joint 3
        Channel::First(first.3.with(a.pa11).erase()),  // joint 4
        Channel::Second(second.0.with(c.pc6).erase()), // joint 5
        Channel::Second(second.1.with(c.pc7).erase()), // joint 6
    ];

    Connected {
        devices: Devices {
            encoders: encoders(bus, selects),
            drives: drives(channels),
            brake,
        },
        button: c.pc13.into_floating_input(),
        light: a.pa5.into_push_pull_output(),
        timer: device.TIM2,
        watchdog: device.IWDG,
        rcc,
    }
}
