//! Puts the memory of the emulated board where the workspace's memory.x includes it.

use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    if env::var_os("CARGO_FEATURE_NETDUINOPLUS2").is_some() {
        fs::copy("netduinoplus2.x", out.join("board.x"))?;
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
