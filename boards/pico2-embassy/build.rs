//! Puts the memory of the Pico 2 where the linker looks for it, behind cortex-m-rt's script.

use std::{env, error::Error, fs, path::PathBuf};

/// That of the projects for this board.
const MEMORY: &str = "../../robot-import/template/board/pico2/memory.x";

fn main() -> Result<(), Box<dyn Error>> {
    if env::var("CARGO_CFG_TARGET_ARCH")? != "arm" {
        return Ok(());
    }
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy(MEMORY, out.join("board.x"))?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed={MEMORY}");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    Ok(())
}
