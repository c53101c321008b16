//! Puts memory.x where that of the workspace includes it, and the figures of docs/boards.md where `replay` prints them.

use std::{env, error::Error, fs, path::PathBuf};

#[path = "../page.rs"]
mod page;

/// That of the projects for this board.
const MEMORY: &str = "../../robot-import/template/board/nucleo-f446re/memory.x";

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy(MEMORY, out.join("board.x"))?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed={MEMORY}");
    let page = page::torques()?;
    // "| Cortex-M4F | machine | target | flags | instructions | instructions | cycles | flash |"
    let row =
        page::row(&page, "| Cortex-M4F ").ok_or("docs/boards.md has no row of the Cortex-M4F")?;
    let cycles = row.split('|').nth(7).ok_or("no cycles")?.trim();
    println!("cargo:rustc-env=CYCLES={cycles}");
    Ok(())
}
