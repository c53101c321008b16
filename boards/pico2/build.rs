//! Puts the memory of the board and the start-up of its architecture where the linker looks for them, and the figures of
//! docs/boards.md where `replay` prints them.

use std::{env, error::Error, fs, path::PathBuf};

#[path = "../page.rs"]
mod page;

fn main() -> Result<(), Box<dyn Error>> {
    page::torques()?;
    // cortex-m-rt's script includes memory and interrupts itself, riscv-rt's does not.
    let (memory, scripts) = match (
        &*env::var("CARGO_CFG_TARGET_OS")?,
        &*env::var("CARGO_CFG_TARGET_ARCH")?,
    ) {
        ("none", "arm") => (
            "../../robot-import/template/board/pico2/memory.x",
            &["link.x", "defmt.x"][..],
        ),
        ("none", "riscv32") => ("riscv.x", &["board.x", "device.x", "link.x", "defmt.x"][..]),
        _ => return Ok(()),
    };
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy(memory, out.join("board.x"))?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed={memory}");
    for script in scripts {
        println!("cargo:rustc-link-arg-bins=-T{script}");
    }
    Ok(())
}
