//! Puts the workspace's memory.x where the linker looks for it, and the oracle's recorded states
//! (inputs only) where `bits` includes them.

use std::fmt::Write;
use std::{env, error::Error, fs, path::PathBuf};

/// The recorded inputs of a state, in this order.
const INPUTS: [&str; 4] = ["q", "qd", "qdd", "tau"];

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy("../memory.x", out.join("memory.x"))?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed=../memory.x");

    let mut source = String::new();
    for robot in ["ur5e", "panda", "iiwa14", "a1"] {
        let path = format!("../host-tests/recordings/{robot}.json");
        println!("cargo:rerun-if-changed={path}");
        let recording: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path)?)?;
        let rows = |input: &str| recording[input].as_array().cloned().unwrap_or_default();
        let (states, joints) = (rows("q").len(), rows("q")[0].as_array().map_or(0, Vec::len));
        let name = robot.to_uppercase();
        writeln!(source, "/// Recorded q, q̇, q̈ and τ of {robot}, as bits.")?;
        writeln!(
            source,
            "pub static {name}: [[[u32; {joints}]; 4]; {states}] = ["
        )?;
        for state in 0..states {
            write!(source, "[")?;
            for input in INPUTS {
                let row: Vec<f64> = serde_json::from_value(recording[input][state].clone())?;
                let bits: Vec<u32> = row.iter().map(|&x| (x as f32).to_bits()).collect();
                write!(source, "{bits:?},")?;
            }
            writeln!(source, "],")?;
        }
        writeln!(source, "];")?;
    }
    fs::write(out.join("states.rs"), source)?;
    Ok(())
}
