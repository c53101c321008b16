//! The clocks of a Raspberry Pi Pico 2, the cycles of either of its cores, and the figures of `docs/boards.md`.
#![no_std]

/// The number of ticks of the replay, on every core.
pub const TICKS: &str = env!("TICKS");
/// The digest of their torques, on every core: 16 hexadecimal digits.
pub const DIGEST: &str = env!("DIGEST");

#[cfg(target_os = "none")]
mod board {
    use rp235x_hal::clocks::init_clocks_and_plls;
    use rp235x_hal::pac::{CLOCKS, PLL_SYS, PLL_USB, RESETS, WATCHDOG, XOSC};
    use rp235x_hal::watchdog::Watchdog;

    /// What sets the clocks.
    pub type Oscillators = (XOSC, CLOCKS, PLL_SYS, PLL_USB, RESETS, WATCHDOG);

    /// The crystal of a Pico 2, Hz.
    const CRYSTAL: u32 = 12_000_000;
    /// The processor's clock, MHz: what the HAL makes of that crystal.
    pub const MHZ: u32 = 150;

    /// Sets the processor's clock to [`MHZ`]; whether the crystal and both PLLs start.
    pub fn start_clocks(oscillators: Oscillators) -> bool {
        let (xosc, clocks, sys, usb, mut resets, watchdog) = oscillators;
        let mut watchdog = Watchdog::new(watchdog);
        init_clocks_and_plls(CRYSTAL, xosc, clocks, sys, usb, &mut resets, &mut watchdog).is_ok()
    }

    #[cfg(target_arch = "arm")]
    pub const CORE: &str = "Cortex-M33";
    #[cfg(target_arch = "riscv32")]
    pub const CORE: &str = "Hazard3";

    /// Starts the count of [`cycles`]: DWT's.
    #[cfg(target_arch = "arm")]
    pub fn start_cycles() {
        if let Some(mut core) = cortex_m::Peripherals::take() {
            core.DCB.enable_trace();
            core.DWT.enable_cycle_counter();
        }
    }

    /// The processor's cycles, modulo 2³².
    #[cfg(target_arch = "arm")]
    pub fn cycles() -> u32 {
        cortex_m::peripheral::DWT::cycle_count()
    }

    /// Starts the count of [`cycles`]: that of `mcycle`, which is inhibited after a reset.
    #[cfg(target_arch = "riscv32")]
    pub fn start_cycles() {
        // SAFETY: the counters of the core belong to nobody else.
        unsafe { riscv::register::mcountinhibit::clear_cy() };
    }

    /// The processor's cycles, modulo 2³².
    #[cfg(target_arch = "riscv32")]
    pub fn cycles() -> u32 {
        riscv::register::mcycle::read() as u32
    }
}

#[cfg(target_os = "none")]
pub use board::{CORE, MHZ, Oscillators, cycles, start_clocks, start_cycles};
