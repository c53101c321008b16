//! The clocks of the board, and the figures of `docs/boards.md`.
#![no_std]

/// The number of ticks of the replay, and the digest of their torques, on every core.
pub const TORQUES: (&str, &str) = (env!("TICKS"), env!("DIGEST"));
/// The modelled cycles of a tick of a Cortex-M4F whose memory does not wait.
pub const CYCLES: &str = env!("CYCLES");

/// 168 MHz from the 8 MHz of the ST-LINK: five wait states of the flash at 3.3 V, with its accelerator.
#[cfg(target_arch = "arm")]
pub fn clocks() -> stm32f4xx_hal::rcc::Config {
    use stm32f4xx_hal::prelude::*;
    stm32f4xx_hal::rcc::Config::hse(8.MHz())
        .bypass_hse_oscillator()
        .sysclk(168.MHz())
}
