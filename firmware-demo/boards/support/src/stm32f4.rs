//! The parts of the STM32F4: the period, the watchdog, PWM.

use core::convert::Infallible;

use motion_control::safety::{CompletedTick, Watchdog};
use stm32f4xx_hal::hal::pwm::{ErrorType, SetDutyCycle};
use stm32f4xx_hal::pac::{IWDG, TIM2};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::Rcc;
use stm32f4xx_hal::timer::pwm::ErasedChannel;
use stm32f4xx_hal::timer::{CounterHz, Event, Flag, PwmExt};
use stm32f4xx_hal::watchdog::IndependentWatchdog;

pub use stm32f4xx_hal::pac;

/// The timer whose interrupt begins a tick.
pub struct Period(CounterHz<TIM2>);

impl Period {
    /// Begins to count so many ticks a second, if the timer can.
    pub fn start(timer: TIM2, rate: u32, rcc: &mut Rcc) -> Option<Self> {
        let mut timer = timer.counter_hz(rcc);
        timer.start(rate.Hz()).ok()?;
        timer.listen(Event::Update);
        Some(Self(timer))
    }

    /// A tick has begun.
    #[inline]
    pub fn begin(&mut self) {
        self.0.clear_flags(Flag::Update);
    }

    /// Whether the period of the tick has ended.
    #[inline]
    pub fn has_ended(&self) -> bool {
        self.0.flags().contains(Flag::Update)
    }
}

/// The watchdog of the board, which only a completed tick feeds.
pub struct Starved(IndependentWatchdog);

impl Starved {
    /// A processor that completes no tick for 20 ms restarts from here on.
    pub fn start(watchdog: IWDG) -> Self {
        let mut watchdog = IndependentWatchdog::new(watchdog);
        watchdog.start(20.millis());
        Self(watchdog)
    }
}

impl Watchdog for Starved {
    #[inline]
    fn feed(&mut self, _: CompletedTick) {
        self.0.feed();
    }
}

/// A PWM channel of either of two timers.
pub enum Channel<A, B> {
    /// A channel of the first timer.
    First(ErasedChannel<A>),
    /// A channel of the second timer.
    Second(ErasedChannel<B>),
}

impl<A: PwmExt, B: PwmExt> ErrorType for Channel<A, B> {
    type Error = Infallible;
}

impl<A: PwmExt, B: PwmExt> SetDutyCycle for Channel<A, B> {
    fn max_duty_cycle(&self) -> u16 {
        match self {
            Self::First(channel) => channel.max_duty_cycle(),
            Self::Second(channel) => channel.max_duty_cycle(),
        }
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        match self {
            Self::First(channel) => channel.set_duty_cycle(duty),
            Self::Second(channel) => channel.set_duty_cycle(duty),
        }
    }
}

/// The drives are set to no torque.
#[inline(never)]
pub fn drives<A: PwmExt, B: PwmExt, const N: usize>(
    mut drives: [Channel<A, B>; N],
) -> [Channel<A, B>; N] {
    for drive in &mut drives {
        let Ok(()) = drive.set_duty_cycle_percent(50);
        match drive {
            Channel::First(channel) => channel.enable(),
            Channel::Second(channel) => channel.enable(),
        }
    }
    drives
}
