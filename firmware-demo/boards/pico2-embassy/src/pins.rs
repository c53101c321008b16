//! The connections: this is the one file with pins, buses and PWM slices.
//!
//! A line that ends in the number of a joint is that joint's own.

use board_support::encoders;
use board_support::rp2350::{Button, Channel, Line, Select};
use embassy_rp::Peri;
use embassy_rp::Peripherals;
use embassy_rp::gpio::Level;
use embassy_rp::peripherals::{PWM_SLICE7, SPI0, WATCHDOG};
use embassy_rp::pwm;
use embassy_rp::spi::{self, Blocking, Phase, Polarity, Spi};
use embedded_hal_bus::util::AtomicCell;

use crate::board::N;

/// The processor's clock after `embassy_rp::init`, MHz.
pub const MHZ: u8 = 150;

/// The bus of the encoders.
pub type Bus = Spi<'static, SPI0, Blocking>;
/// An encoder's part of the bus.
pub type Encoder<'a> = encoders::Encoder<'a, Bus, Select>;

/// The board and what is connected to it.
pub struct Connected {
    pub bus: AtomicCell<Bus>,
    pub selects: [Select; N],
    pub drives: [Channel; N],
    /// High holds the joints. While the chip restarts, a pull-up on the board of the brake does.
    pub brake: Line,
    /// A button to ground.
    pub button: Button,
    /// The green light.
    pub light: Line,
    /// Counts the period, without a pin.
    pub period: Peri<'static, PWM_SLICE7>,
    pub watchdog: Peri<'static, WATCHDOG>,
}

/// Configures the pins: the brake set, the drives without torque.
#[inline(always)]
pub fn connect(chip: Peripherals) -> Connected {
    // The brake first.
    let brake = Line::new(chip.PIN_12, Level::High);
    let light = Line::new(chip.PIN_25, Level::Low);

    // SCK, MOSI and MISO, in mode 1.
    let mut config = spi::Config::default();
    config.frequency = 10_000_000;
    (config.polarity, config.phase) = (Polarity::IdleLow, Phase::CaptureOnSecondTransition);
    let bus = Spi::new_blocking(chip.SPI0, chip.PIN_18, chip.PIN_19, chip.PIN_16, config);
    let selects = [
        Select::new(chip.PIN_17), // joint 1
        Select::new(chip.PIN_20), // joint 2
        Select::new(chip.PIN_21), // joint 3
        Select::new(chip.PIN_22), // joint 4
        Select::new(chip.PIN_26), // joint 5
        Select::new(chip.PIN_27), // joint 6
    ];

    // 20 kHz, and 50 % from the start.
    let mut config = pwm::Config::default();
    config.top = 1000 * u16::from(MHZ) / 20 - 1;
    config.compare_a = config.top / 2 + 1;
    let drives = [
        Channel::new(chip.PWM_SLICE0, chip.PIN_0, &config), // joint 1
        Channel::new(chip.PWM_SLICE1, chip.PIN_2, &config), // joint 2
        Channel::new(chip.PWM_SLICE2, chip.PIN_4, &config), // joint 3
        Channel::new(chip.PWM_SLICE3, chip.PIN_6, &config), // joint 4
        Channel::new(chip.PWM_SLICE4, chip.PIN_8, &config), // joint 5
        Channel::new(chip.PWM_SLICE5, chip.PIN_10, &config), // joint 6
    ];

    Connected {
        bus: AtomicCell::new(bus),
        selects,
        drives,
        brake,
        button: Button::new(chip.PIN_13),
        light,
        period: chip.PWM_SLICE7,
        watchdog: chip.WATCHDOG,
    }
}
