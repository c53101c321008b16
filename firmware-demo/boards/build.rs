//! Puts the memory of a board where the linker finds it. Each package of a board has this script.

use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    // A project has its own name there.
    let text = fs::read_to_string("memory.x")?.replace("{{crate_name}}", "firmware_demo");
    fs::write(out.join("memory.x"), text)?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed=memory.x");
    Ok(())
}
