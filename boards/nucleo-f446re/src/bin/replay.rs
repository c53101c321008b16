//! The digest of the torques and the cycles of a tick on the board, beside those of `docs/boards.md`; no encoder and no
//! drive is needed.
//!
//! ```text
//! cargo build --release -p nucleo-f446re --target thumbv7em-none-eabihf
//! probe-rs run --chip STM32F446RETx target/thumbv7em-none-eabihf/release/replay
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
    use nucleo_f446re::{CYCLES, TORQUES, clocks};
    use panic_halt as _;
    use stm32f4xx_hal::pac;
    use stm32f4xx_hal::prelude::*;

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
        let (modelled, other) = TORQUES;
        defmt::println!("torques of {=u32} ticks: {=u64:016x}", ticks, digest.0);
        defmt::println!("of docs/boards.md, {=str} ticks: {=str}", modelled, other);
        defmt::println!("cycles of a tick: {=u32} to {=u32}", least, most);
        defmt::println!(
            "modelled, memory that does not wait: {=str}; this flash has five wait states",
            CYCLES
        );
    }
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
