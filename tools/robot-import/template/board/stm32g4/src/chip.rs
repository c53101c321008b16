//! The period and the watchdog of the STM32G4, under the names that all chips have here.
//!
//! The HAL's timer tells a period that has ended only by clearing its flag: here are its registers.

use motion_control::safety::{CompletedTick, Watchdog};
use stm32g4xx_hal::independent_watchdog::IndependentWatchdog;
use stm32g4xx_hal::pac::{IWDG, TIM2};
use stm32g4xx_hal::rcc::{BusTimerClock, Enable, Rcc, RccBus, Reset};
use stm32g4xx_hal::time::ExtU32;

use crate::board::TICK;

#[allow(unused_imports, reason = "a board without encoders on SPI has no pins of any port")]
pub use stm32g4xx_hal::gpio::{AnyPin, Output};
pub use stm32g4xx_hal::pac;

#[path = "fast.rs"]
mod fast;

/// The timer whose interrupt begins a tick.
pub struct Period(TIM2);

impl Period {
    pub fn start(timer: TIM2, rcc: &mut Rcc) -> Option<Self> {
        TIM2::enable(rcc);
        TIM2::reset(rcc);
        let ticks_per_second = const { (1.0 / TICK + 0.5) as u32 };
        let clock = <TIM2 as RccBus>::Bus::timer_clock(&rcc.clocks);
        let cycles = clock.raw() / ticks_per_second;
        timer.arr().write(|w| w.arr().set(cycles - 1));
        timer.dier().write(|w| w.uie().set_bit());
        timer.cr1().write(|w| w.cen().set_bit());
        Some(Self(timer))
    }

    /// A tick has begun.
    pub fn begin(&mut self) {
        self.0.sr().write(|w| w.uif().clear_bit());
    }

    /// Whether the period of the tick has ended.
    pub fn has_ended(&self) -> bool {
        self.0.sr().read().uif().bit()
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
