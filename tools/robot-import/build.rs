//! The sources of the libraries that a project carries, as a list in the program: it stands alone
//! wherever it was installed.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The folders of the crates of the repository that a project may use.
const CRATES: [&str; 5] = ["c", "drivers", "dynamics-core", "motion-control", "telemetry"];
/// The files of a crate that are carried beside its sources.
const BESIDE: [&str; 3] = ["build.rs", "Cargo.toml", "NOTATION.md"];

fn main() -> Result<(), Box<dyn Error>> {
    // Projects are written by the program alone; the wheel's sources have not all of these crates.
    if env::var_os("CARGO_FEATURE_PROGRAM").is_none() {
        return Ok(());
    }
    let own = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let root = own.ancestors().nth(2).ok_or("the repository")?;
    let mut list = "&[\n".to_owned();
    for name in CRATES {
        let folder = root.join(name);
        let mut files = Vec::new();
        for beside in BESIDE.map(|name| folder.join(name)) {
            if beside.exists() {
                files.push(beside);
            }
        }
        for below in ["src", "include"].map(|name| folder.join(name)) {
            if below.exists() {
                walk(&below, &mut files)?;
            }
        }
        files.sort();
        writeln!(list, "Crate {{ folder: {name:?}, files: &[")?;
        for file in &files {
            let path = file.strip_prefix(&folder)?.to_string_lossy();
            let path = path.replace('\\', "/");
            writeln!(list, "({path:?}, include_str!({file:?})),")?;
        }
        list += "] },\n";
    }
    list += "]\n";
    fs::write(Path::new(&env::var("OUT_DIR")?).join("crates.rs"), list)?;
    println!("cargo:rerun-if-changed=build.rs");
    Ok(())
}

/// The files below a folder; cargo watches each folder for others.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed={}", folder.display());
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}
