//! The parts of the STM32G4: the period, the watchdog, PWM, the bus of encoders, CAN.
//!
//! The HAL's timer tells a period that has ended only by clearing its flag: here are its registers.

use motion_control::safety::{CompletedTick, Watchdog};
use stm32g4xx_hal::independent_watchdog::IndependentWatchdog;
use stm32g4xx_hal::pac::{IWDG, TIM2};
use stm32g4xx_hal::rcc::{BusTimerClock, Enable, Rcc, RccBus, Reset};
use stm32g4xx_hal::time::ExtU32;

#[cfg(feature = "can")]
pub mod can;
mod fast;
pub mod spi_and_pwm;

pub use stm32g4xx_hal::pac;

/// The timer whose interrupt begins a tick.
pub struct Period(TIM2);

impl Period {
    /// Begins to count so many ticks a second.
    pub fn start(timer: TIM2, rate: u32, rcc: &mut Rcc) -> Option<Self> {
        TIM2::enable(rcc);
        TIM2::reset(rcc);
        let clock = <TIM2 as RccBus>::Bus::timer_clock(&rcc.clocks);
        let cycles = clock.raw() / rate;
        timer.arr().write(|w| w.arr().set(cycles - 1));
        timer.dier().write(|w| w.uie().set_bit());
        timer.cr1().write(|w| w.cen().set_bit());
        Some(Self(timer))
    }

    /// A tick has begun.
    #[inline]
    pub fn begin(&mut self) {
        self.0.sr().write(|w| w.uif().clear_bit());
    }

    /// Whether the period of the tick has ended.
    #[inline]
    pub fn has_ended(&self) -> bool {
        self.0.sr().read().uif().bit()
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
