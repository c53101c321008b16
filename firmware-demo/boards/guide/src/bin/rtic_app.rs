//! The control tick as a hardware task of RTIC.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
use panic_halt as _;

// page: begin
#[cfg(target_arch = "arm")]
#[rtic::app(device = lm3s6965)]
mod app {
    use cortex_m::peripheral::syst::SystClkSource;
    use guide_firmware::{Arm, board};

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        arm: Arm,
    }

    #[init]
    fn init(mut cx: init::Context) -> (Shared, Local) {
        cx.core.SYST.set_clock_source(SystClkSource::Core);
        cx.core.SYST.set_reload(168_000 - 1); // 1 kHz at 168 MHz
        cx.core.SYST.enable_counter();
        cx.core.SYST.enable_interrupt();
        (Shared {}, Local { arm: Arm::new() })
    }

    #[task(binds = SysTick, local = [arm], priority = 2)]
    fn tick(cx: tick::Context) {
        let measured = board::positions();
        board::drive(&cx.local.arm.tick(measured.as_ref().map_err(|fault| *fault)));
    }
}
// page: end

#[cfg(not(target_arch = "arm"))]
fn main() {}
