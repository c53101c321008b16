//! Pins and PWM channels of the chip whose registers are chosen when they are made.
//!
//! The HAL's own choose them at each call by a number, and panic for one that does not exist: no
//! tick may reach that.

use core::convert::Infallible;
use core::mem::forget;

use embassy_rp::Peri;
use embassy_rp::gpio::{Input, Level, Output, Pin, Pull};
use embassy_rp::pac::{self, pwm};
use embassy_rp::pwm::{ChannelAPin, Config, Pwm, Slice};
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self as duty, SetDutyCycle};

/// The bit of a pin in the registers of GP0 to GP31, which are all pins of the RP2350A.
fn bit(pin: &Peri<'static, impl Pin>) -> u32 {
    1 << (pin.pin() % 32)
}

/// An output.
#[derive(Debug)]
pub struct Line {
    bit: u32,
}

impl Line {
    /// A pin as an output of this level, for good.
    pub fn new(pin: Peri<'static, impl Pin>, level: Level) -> Self {
        let line = Self { bit: bit(&pin) };
        // The HAL sets the pin of a dropped output back.
        forget(Output::new(pin, level));
        line
    }
}

impl digital::ErrorType for Line {
    type Error = Infallible;
}

impl OutputPin for Line {
    #[inline]
    fn set_low(&mut self) -> Result<(), Infallible> {
        pac::SIO.gpio_out(0).value_clr().write_value(self.bit);
        Ok(())
    }

    #[inline]
    fn set_high(&mut self) -> Result<(), Infallible> {
        pac::SIO.gpio_out(0).value_set().write_value(self.bit);
        Ok(())
    }
}

/// The select of an encoder: its clock begins later than 350 ns after its fall, which the AS5048A
/// needs and faster parts of the family do not mind.
#[derive(Debug)]
pub struct Select(Line);

impl Select {
    /// 350 ns of the processor's 150 MHz, rounded up.
    const CYCLES: u32 = 53;

    /// A pin as a select that is high, for good.
    pub fn new(pin: Peri<'static, impl Pin>) -> Self {
        Self(Line::new(pin, Level::High))
    }
}

impl digital::ErrorType for Select {
    type Error = Infallible;
}

impl OutputPin for Select {
    #[inline]
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set_low()?;
        cortex_m::asm::delay(Self::CYCLES);
        Ok(())
    }

    #[inline]
    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set_high()
    }
}

/// A button to ground.
#[derive(Debug)]
pub struct Button {
    bit: u32,
}

impl Button {
    /// A pin as an input that is pulled up, for good.
    pub fn new(pin: Peri<'static, impl Pin>) -> Self {
        let button = Self { bit: bit(&pin) };
        forget(Input::new(pin, Pull::Up));
        button
    }

    /// Whether the button is pressed.
    #[inline]
    pub fn is_pressed(&self) -> bool {
        pac::SIO.gpio_in(0).read() & self.bit == 0
    }
}

/// The first output of a PWM slice.
pub struct Channel(pwm::Channel);

impl Channel {
    /// A pin as the output of its slice with this configuration, for good.
    pub fn new<T: Slice>(
        slice: Peri<'static, T>,
        pin: Peri<'static, impl ChannelAPin<T>>,
        config: &Config,
    ) -> Self {
        let registers = pac::PWM.ch(slice.number());
        forget(Pwm::new_output_a(slice, pin, config.clone()));
        Self(registers)
    }
}

impl duty::ErrorType for Channel {
    type Error = Infallible;
}

impl SetDutyCycle for Channel {
    #[inline]
    fn max_duty_cycle(&self) -> u16 {
        self.0.top().read().top()
    }

    #[inline]
    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0.cc().modify(|compare| compare.set_a(duty));
        Ok(())
    }
}
