//! The digest of the torques and the cycles of a tick on the board, to compare with
//! `boards.md` of the laboratory and `docs/scenes.md`; no encoder and no drive is needed.
//!
//! ```text
//! cargo build --manifest-path firmware-demo/boards/Cargo.toml --target-dir target/boards \
//!     --release -p nucleo-f446re --bin replay --target thumbv7em-none-eabihf
//! probe-rs run --chip STM32F446RETx target/boards/thumbv7em-none-eabihf/release/replay
//! ```
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod firmware {
    use cortex_m::peripheral::DWT;
    use cortex_m_rt::entry;
    use defmt_rtt as _;
    use firmware_demo::replay::Replay;
    use firmware_demo::scenes::ur5e::PickAndPlace;
    use firmware_demo::sim_io::Wires;
    use panic_halt as _;
    use stm32f4xx_hal::pac;
    use stm32f4xx_hal::prelude::*;
    use stm32f4xx_hal::rcc::Config;

    /// 168 MHz from the 8 MHz of the ST-LINK: five wait states of the flash at 3.3 V, with its
    /// accelerator.
    fn clocks() -> Config {
        Config::hse(8.MHz()).bypass_hse_oscillator().sysclk(168.MHz())
    }

    #[entry]
    fn main() -> ! {
        static WIRES: Wires<6> = Wires::new();
        let (core, device) = (cortex_m::Peripherals::take(), pac::Peripherals::take());
        if let (Some(mut core), Some(device)) = (core, device) {
            device.RCC.freeze(clocks());
            core.DCB.enable_trace();
            core.DWT.enable_cycle_counter();
            report(&WIRES);
        }
        loop {
            cortex_m::asm::wfi();
        }
    }

    fn report(wires: &'static Wires<6>) {
        let Ok(mut replay) = Replay::<PickAndPlace, 6, 6, 6, 6>::new(wires) else {
            return defmt::println!("the scene does not start");
        };
        let (mut least, mut most) = (u32::MAX, 0);
        let ticks = replay.length();
        let digest = replay.run(ticks, |replay| {
            let start = DWT::cycle_count();
            let telemetry = replay.tick();
            let cycles = DWT::cycle_count().wrapping_sub(start);
            (least, most) = (least.min(cycles), most.max(cycles));
            telemetry
        });
        let Ok(digest) = digest else {
            return defmt::println!("a tick had a fault");
        };
        defmt::println!("torques of {=u32} ticks: {=u64:016x}", ticks, digest.0);
        defmt::println!("boards.md has the digest of other cores");
        defmt::println!("cycles of a tick: {=u32} to {=u32}", least, most);
        defmt::println!(
            "docs/scenes.md has those of memory that does not wait; this flash has five wait states"
        );
    }
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
