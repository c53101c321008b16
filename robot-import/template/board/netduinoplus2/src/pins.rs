//! What is connected where: the one file with pins, clocks and timers.
//!
//! A line that ends in the number of a joint is that joint's own.

use embedded_hal_bus::util::AtomicCell;
use stm32f4xx_hal::gpio::{Input, Output, PA10, PB11, PB12};
use stm32f4xx_hal::hal::spi::MODE_1;
use stm32f4xx_hal::pac::TIM4; // joint 5
use stm32f4xx_hal::pac::{IWDG, Peripherals, SPI2, TIM2, TIM5};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Rcc};
use stm32f4xx_hal::spi::Spi;

use crate::board::Devices;
use crate::devices::{Channel, Encoder, drives, encoders};

/// The bus of the encoders.
pub type Bus = Spi<SPI2>;
/// The timers of the drives: of the joints 1 to 4, and of those behind them.
pub type First = TIM5;
pub type Second = TIM4; // joint 5
/// High holds the joints.
pub type Brake = PB12<Output>;
/// The button, to the supply.
pub type Button = PB11<Input>;
/// The blue light.
pub type Light = PA10<Output>;

/// Whether the button is pressed.
pub fn is_pressed(button: &Button) -> bool {
    button.is_high()
}

/// 168 MHz from the crystal of 25 MHz: five wait states of the flash at 3.3 V, with its accelerator.
pub fn clocks() -> Config {
    Config::hse(25.MHz()).sysclk(168.MHz())
}

/// The board and what is connected to it.
pub struct Connected {
    pub devices: Devices<Encoder, Channel, Brake>,
    pub button: Button,
    pub light: Light,
    pub timer: TIM2,
    pub watchdog: IWDG,
    pub rcc: Rcc,
}

/// Configures the pins: the brake set, the drives without torque.
#[inline(always)]
pub fn connect(device: Peripherals, bus: &'static mut Option<AtomicCell<Bus>>) -> Connected {
    let mut rcc = device.RCC.freeze(clocks());
    let (a, b, c) = (
        device.GPIOA.split(&mut rcc),
        device.GPIOB.split(&mut rcc),
        device.GPIOC.split(&mut rcc),
    );
    let high = true.into();
    // The brake first.
    let brake = b.pb12.into_push_pull_output_in_state(high);
    // The supply of the headers.
    b.pb2.into_push_pull_output_in_state(high);

    // SCK, MISO and MOSI.
    let pins = (Some(b.pb13), Some(b.pb14), Some(b.pb15));
    let spi = Spi::new(device.SPI2, pins, MODE_1, 10.MHz(), &mut rcc);
    let bus = bus.insert(AtomicCell::new(spi));
    let selects = [
        c.pc0.into_push_pull_output_in_state(high).erase(), // joint 1
        c.pc1.into_push_pull_output_in_state(high).erase(), // joint 2
        c.pc2.into_push_pull_output_in_state(high).erase(), // joint 3
        c.pc3.into_push_pull_output_in_state(high).erase(), // joint 4
        c.pc4.into_push_pull_output_in_state(high).erase(), // joint 5
        c.pc5.into_push_pull_output_in_state(high).erase(), // joint 6
    ];

    // 20 kHz.
    let (_, first) = device.TIM5.pwm_hz(20.kHz(), &mut rcc);
    let (_, second) = device.TIM4.pwm_hz(20.kHz(), &mut rcc); // joint 5
    let channels = [
        Channel::First(first.0.with(a.pa0).erase()),   // joint 1
        Channel::First(first.1.with(a.pa1).erase()),   // joint 2
        Channel::First(first.2.with(a.pa2).erase()),   // joint 3
        Channel::First(first.3.with(a.pa3).erase()),   // joint 4
        Channel::Second(second.2.with(b.pb8).erase()), // joint 5
        Channel::Second(second.3.with(b.pb9).erase()), // joint 6
    ];

    Connected {
        devices: Devices {
            encoders: encoders(bus, selects),
            drives: drives(channels),
            brake,
        },
        button: b.pb11.into_pull_down_input(),
        light: a.pa10.into_push_pull_output(),
        timer: device.TIM2,
        watchdog: device.IWDG,
        rcc,
    }
}
