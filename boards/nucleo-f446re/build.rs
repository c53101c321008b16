//! Puts memory.x where the linker looks for it, and the figures of docs/boards.md where `replay` prints them.

use std::{env, error::Error, fs, path::PathBuf};

const PAGE: &str = "../../docs/boards.md";

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy("memory.x", out.join("memory.x"))?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed=memory.x");
    println!("cargo:rerun-if-changed={PAGE}");
    let page = fs::read_to_string(PAGE)?;
    let of = |start: &str| page.lines().find(|line| line.starts_with(start));
    // "- `ur5e`, 6,700 ticks: digest `…`"
    let scene = of("- `ur5e`, ").ok_or("docs/boards.md has no digest of ur5e")?;
    let digest = scene.rsplit('`').nth(1).ok_or("no digest")?;
    let ticks: String = (scene.split(" ticks").next().unwrap_or_default())
        .chars()
        .filter(char::is_ascii_digit)
        .skip(1) // that of "ur5e"
        .collect();
    // "| Cortex-M4F | machine | target | flags | instructions | instructions | cycles | flash |"
    let row = of("| Cortex-M4F ").ok_or("docs/boards.md has no row of the Cortex-M4F")?;
    let cycles = row.split('|').nth(7).ok_or("no cycles")?.trim();
    println!("cargo:rustc-env=DIGEST={digest}");
    println!("cargo:rustc-env=TICKS={ticks}");
    println!("cargo:rustc-env=CYCLES={cycles}");
    Ok(())
}
