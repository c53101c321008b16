//! Puts the memory of the emulated board where the workspace's memory.x includes it.

use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    if env::var_os("CARGO_FEATURE_NETDUINOPLUS2").is_some() {
        let mut memory = fs::read_to_string("netduinoplus2.x")?;
        if env::var_os("CARGO_FEATURE_IN_CCM").is_some() {
            memory += &placement()?;
        }
        fs::write(out.join("board.x"), memory)?;
        println!("cargo:rustc-link-search={}", out.display());
        println!("cargo:rerun-if-changed=netduinoplus2.x");
    }
    // ARMv6-M lacks the hint that marks a region; stable Rust has no `cfg` for it.
    println!("cargo:rustc-check-cfg=cfg(armv6m)");
    if env::var("TARGET")?.starts_with("thumbv6m") {
        println!("cargo:rustc-cfg=armv6m");
    }
    Ok(())
}

/// The section that a Nucleo-G474RE has in CCM. The emulated board has no such memory for code: its
/// RAM from `cycle_meter::COUPLED` on stands for it, below which is the stack, and there is more of
/// it, since a scene has the tick once for each set of effects.
fn placement() -> Result<String, Box<dyn Error>> {
    let board = "boards/nucleo-g474re/memory.x";
    println!("cargo:rerun-if-changed={board}");
    let text = fs::read_to_string(board)?.replace("{{crate_name}}", "firmware_demo");
    let text = text.replace(".text.TIM2", ".text.*marked_tick*");
    let (_, section) = text.split_once("\n}\n").ok_or("the board has no memory")?;
    let memory = "MEMORY { CCM : ORIGIN = 0x20010000, LENGTH = 64K }\n_stack_start = ORIGIN(CCM);";
    Ok(format!("{memory}\n{section}"))
}
