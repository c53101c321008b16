//! Puts the oracle's recorded states and torques (inputs only) where `recorded` and `hard` include
//! them.

use std::fmt::Write;
use std::fs::{self, File};
use std::{env, error::Error, io, path::PathBuf};

use flate2::read::GzDecoder;

/// The recorded inputs of a state, in this order.
const INPUTS: [&str; 4] = ["q", "qd", "qdd", "tau"];

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let mut source = String::new();
    for robot in ["ur5e", "panda", "iiwa14", "a1"] {
        let path = format!("../../host-tests/recordings/{robot}.json.gz");
        println!("cargo:rerun-if-changed={path}");
        let recording: serde_json::Value = serde_json::from_str(&recorded(&path)?)?;
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
    fs::write(out.join("torques.rs"), torques()?)?;
    Ok(())
}

/// The text of a compressed recording.
fn recorded(path: &str) -> io::Result<String> {
    io::read_to_string(GzDecoder::new(File::open(path)?))
}

/// The torques that the oracle gives to forward dynamics in the hard cases of six joints, as bits.
fn torques() -> Result<String, Box<dyn Error>> {
    const FOLDER: &str = "../../host-tests/recordings/hard";
    println!("cargo:rerun-if-changed={FOLDER}");
    let mut files = fs::read_dir(FOLDER)?.collect::<Result<Vec<_>, _>>()?;
    files.sort_by_key(fs::DirEntry::path);
    let mut source = String::from("/// Case, name, and the bits of τ by states.\n");
    writeln!(
        source,
        "pub static TORQUES: &[(u32, &str, &[[u32; 6]])] = &["
    )?;
    for path in files.iter().map(fs::DirEntry::path) {
        println!("cargo:rerun-if-changed={}", path.display());
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let Some(case) = stem.and_then(|stem| stem.parse::<u32>().ok()) else {
            continue; // of another kind
        };
        let setups: Vec<serde_json::Value> = serde_json::from_str(&fs::read_to_string(&path)?)?;
        for setup in setups {
            let states = setup["states"].as_array().cloned().unwrap_or_default();
            let tau = states.into_iter().map(|state| {
                let bits: Vec<String> = serde_json::from_value(state["tau"].clone())?;
                let bits = bits.iter().map(|bits| u32::from_str_radix(bits, 16));
                Ok(bits.collect::<Result<Vec<u32>, _>>()?)
            });
            let tau: Vec<Vec<u32>> = tau.collect::<Result<_, Box<dyn Error>>>()?;
            if tau.iter().all(|tau| tau.len() == 6) {
                writeln!(source, "({case}, {}, &{tau:?}),", setup["name"])?;
            }
        }
    }
    writeln!(source, "];")?;
    Ok(source)
}
