//! The control tick in a timer interrupt, with cortex-m-rt only.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod program {
    use cortex_m::peripheral::syst::SystClkSource;
    use cortex_m_rt::{entry, exception};
    use guide_firmware::{Arm, board};
    use panic_halt as _;

    // page: begin
    #[entry]
    fn main() -> ! {
        let mut core = cortex_m::Peripherals::take().expect("called only once");
        core.SYST.set_clock_source(SystClkSource::Core);
        core.SYST.set_reload(168_000 - 1); // 1 kHz at 168 MHz
        core.SYST.enable_counter();
        core.SYST.enable_interrupt();
        loop {
            cortex_m::asm::wfi();
        }
    }

    #[exception]
    fn SysTick() {
        static mut ARM: Option<Arm> = None; // local to this handler: cortex-m-rt makes it a `&mut`
        let arm = ARM.get_or_insert_with(Arm::new);
        let measured = board::positions();
        board::drive(&arm.tick(measured.as_ref().map_err(|fault| *fault)));
    }
    // page: end
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
