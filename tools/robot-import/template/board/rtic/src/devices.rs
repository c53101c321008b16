//! Encoders on one bus and drives on the channels of two timers, of the STM32F4.
//!
//! A line that ends in the number of a joint is for this joint and those after it.

use core::convert::Infallible;

use embedded_hal_bus::spi::AtomicDevice;
use embedded_hal_bus::util::AtomicCell;
use stm32f4xx_hal::gpio::{AnyPin, Output};
use stm32f4xx_hal::hal::delay::DelayNs;
use stm32f4xx_hal::hal::pwm::{ErrorType, SetDutyCycle};
use stm32f4xx_hal::timer::pwm::ErasedChannel;

use crate::board::N;
use crate::pins::Second; // joint 5
use crate::pins::{Bus, First};

/// An encoder's part of the bus.
pub type Encoder = AtomicDevice<'static, Bus, AnyPin<Output>, Spin>;

/// Delays within a transaction, which the encoders do not have. The bus' own placeholder for them
/// panics.
#[derive(Clone, Copy)]
pub struct Spin;

impl DelayNs for Spin {
    fn delay_ns(&mut self, ns: u32) {
        // 168 MHz are 6 ns a cycle, rounded up.
        cortex_m::asm::delay(ns / 6 + 1);
    }
}

/// A PWM channel of either timer.
pub enum Channel {
    First(ErasedChannel<First>),
    Second(ErasedChannel<Second>), // joint 5
}

impl ErrorType for Channel {
    type Error = Infallible;
}

impl SetDutyCycle for Channel {
    fn max_duty_cycle(&self) -> u16 {
        match self {
            Self::First(channel) => channel.max_duty_cycle(),
            Self::Second(channel) => channel.max_duty_cycle(), // joint 5
        }
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        match self {
            Self::First(channel) => channel.set_duty_cycle(duty),
            Self::Second(channel) => channel.set_duty_cycle(duty), // joint 5
        }
    }
}

/// The encoders on their bus. Not inlined, as all that start-up calls: it then needs the stack of
/// one function at a time.
#[inline(never)]
pub fn encoders(bus: &'static AtomicCell<Bus>, selects: [AnyPin<Output>; N]) -> [Encoder; N] {
    selects.map(|select| {
        let Ok(encoder) = AtomicDevice::new(bus, select, Spin);
        encoder
    })
}

/// The drives are set to no torque.
#[inline(never)]
pub fn drives(mut drives: [Channel; N]) -> [Channel; N] {
    for drive in &mut drives {
        let Ok(()) = drive.set_duty_cycle_percent(50);
        match drive {
            Channel::First(channel) => channel.enable(),
            Channel::Second(channel) => channel.enable(), // joint 5
        }
    }
    drives
}
