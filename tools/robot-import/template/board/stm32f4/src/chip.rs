//! The parts of the STM32F4 under the names that all chips have here: the period, the watchdog, PWM.
//!
//! A line that ends in the number of a joint is for this joint and those after it.

use core::convert::Infallible;

use motion_control::safety::{CompletedTick, Watchdog};
use stm32f4xx_hal::hal::pwm::{ErrorType, SetDutyCycle};
use stm32f4xx_hal::pac::{IWDG, TIM2};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::Rcc;
use stm32f4xx_hal::timer::pwm::ErasedChannel;
use stm32f4xx_hal::timer::{CounterHz, Event, Flag};
use stm32f4xx_hal::watchdog::IndependentWatchdog;

use crate::board::N;
use crate::pins::First;
use crate::pins::Second; // joint 5

pub use stm32f4xx_hal::gpio::{AnyPin, Output};
pub use stm32f4xx_hal::pac;

/// The timer whose interrupt begins a tick, every millisecond.
pub struct Period(CounterHz<TIM2>);

impl Period {
    pub fn start(timer: TIM2, rcc: &mut Rcc) -> Option<Self> {
        let mut timer = timer.counter_hz(rcc);
        timer.start(1.kHz()).ok()?;
        timer.listen(Event::Update);
        Some(Self(timer))
    }

    /// A tick has begun.
    pub fn begin(&mut self) {
        self.0.clear_flags(Flag::Update);
    }

    /// Whether the period of the tick has ended.
    pub fn has_ended(&self) -> bool {
        self.0.flags().contains(Flag::Update)
    }
}

/// The watchdog of the board, which only a completed tick feeds.
pub struct Starved(IndependentWatchdog);

impl Starved {
    pub fn start(watchdog: IWDG) -> Self {
        let mut watchdog = IndependentWatchdog::new(watchdog);
        watchdog.start(20.millis());
        Self(watchdog)
    }
}

impl Watchdog for Starved {
    fn feed(&mut self, _: CompletedTick) {
        self.0.feed();
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
