//! Puts the memory of a board where the linker finds it. Each package of a board has this script.

use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let package = env::var("CARGO_PKG_NAME")?;
    // The framework follows the name that the board has in the projects.
    let board = package.strip_suffix("-embassy").unwrap_or(&package);
    let memory = format!("../../../tools/robot-import/template/board/{board}/memory.x");
    let out = PathBuf::from(env::var("OUT_DIR")?);
    // A project has its own name there.
    let text = fs::read_to_string(&memory)?.replace("{{crate_name}}", "firmware_demo");
    fs::write(out.join("memory.x"), text)?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed={memory}");
    Ok(())
}
