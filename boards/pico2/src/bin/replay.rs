//! The digest of the torques and the cycles of a tick on the board, beside the digest of `docs/boards.md`; no encoder and
//! no drive is needed. The same source is for both architectures of the RP2350.
//!
//! ```text
//! cargo build --release -p pico2 --target thumbv8m.main-none-eabihf
//! probe-rs run --chip RP235x target/thumbv8m.main-none-eabihf/release/replay
//!
//! cargo build --release -p pico2 --target riscv32imac-unknown-none-elf
//! ```
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod firmware {
    use defmt_rtt as _;
    use firmware_demo::replay::Replay;
    use firmware_demo::scenes::ur5e::PickAndPlace;
    use firmware_demo::sim_io::Wires;
    use panic_halt as _;
    use pico2::{CORE, DIGEST, MHZ, TICKS, cycles, start_clocks, start_cycles};
    use rp235x_hal::block::ImageDef;
    use rp235x_hal::{arch, pac};

    /// The image definition that the boot ROM looks for.
    #[unsafe(link_section = ".start_block")] // SAFETY: the linker's script has this section
    #[used]
    static IMAGE: ImageDef = ImageDef::secure_exe();

    #[rp235x_hal::entry]
    fn main() -> ! {
        static WIRES: Wires<6> = Wires::new();
        if let Some(chip) = pac::Peripherals::take() {
            let pac::Peripherals {
                XOSC,
                CLOCKS,
                PLL_SYS,
                PLL_USB,
                RESETS,
                WATCHDOG,
                ..
            } = chip;
            if start_clocks((XOSC, CLOCKS, PLL_SYS, PLL_USB, RESETS, WATCHDOG)) {
                let timing = chip.QMI.m0_timing().read();
                start_cycles();
                report(&WIRES, timing.clkdiv().bits());
            }
        }
        loop {
            arch::wfi();
        }
    }

    /// Runs the replay and prints what it was; the flash has one clock in so many of the processor.
    fn report(wires: &'static Wires<6>, flash: u8) {
        let Ok(mut replay) = Replay::<PickAndPlace, 6, 6, 6, 6>::new(wires) else {
            return defmt::println!("the scene does not start");
        };
        let (mut least, mut most) = (u32::MAX, 0);
        let ticks = replay.length();
        let digest = replay.run(ticks, |replay| {
            let start = cycles();
            let telemetry = replay.tick();
            let passed = cycles().wrapping_sub(start);
            (least, most) = (least.min(passed), most.max(passed));
            telemetry
        });
        let Ok(digest) = digest else {
            return defmt::println!("a tick had a fault");
        };
        let is_expected = u64::from_str_radix(DIGEST, 16) == Ok(digest.0);
        let verdict = if is_expected {
            "the same as"
        } else {
            "OTHER torques than"
        };
        defmt::println!("{=str}, {=u32} MHz", CORE, MHZ);
        defmt::println!("torques of {=u32} ticks: {=u64:016x}", ticks, digest.0);
        defmt::println!(
            "{=str} those of docs/boards.md, {=str} ticks: {=str}",
            verdict,
            TICKS,
            DIGEST
        );
        defmt::println!("cycles of a tick: {=u32} to {=u32}", least, most);
        defmt::println!(
            "code in flash behind the XIP cache of 16 KB: a miss waits for the flash, whose clock is {=u32} MHz / {=u8}; \
             data in SRAM without wait states",
            MHZ,
            flash
        );
    }
}

#[cfg(not(target_os = "none"))]
fn main() {}
