//! The sources of the libraries that a project carries, as a list in the program: it stands alone
//! wherever it was installed. A package of crates.io is built without the repository; its program
//! carries nothing, and its projects have their libraries from there.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The folders of the crates of the repository that a project may use.
const CRATES: [&str; 6] = [
    "c",
    "drivers",
    "dynamics-core",
    "firmware-demo/boards/support",
    "motion-control",
    "telemetry",
];
/// The files of a crate that are carried beside its sources.
const BESIDE: [&str; 3] = ["build.rs", "Cargo.toml", "NOTATION.md"];
/// The files of the repository that `src/project/libraries.rs` names by their place here.
const FILES: [&str; 6] = [
    "Cargo.toml",
    "Cargo.lock",
    "firmware-demo/boards/Cargo.lock",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "rustfmt.toml",
];

fn main() -> Result<(), Box<dyn Error>> {
    // Projects are written by the program alone; the wheel's sources have not all of these crates.
    if env::var_os("CARGO_FEATURE_PROGRAM").is_none() {
        return Ok(());
    }
    let own = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let root = own.ancestors().nth(2).ok_or("the repository")?;
    let is_there = CRATES.iter().all(|name| root.join(name).join("Cargo.toml").is_file());
    let text = |name: &&str| match is_there {
        true => format!("include_str!({:?})", root.join(name)),
        false => "\"\"".to_owned(),
    };
    fs::write(
        out.join("files.rs"),
        format!("[{}]", FILES.iter().map(text).collect::<Vec<_>>().join(", ")),
    )?;
    let mut list = "&[\n".to_owned();
    for name in CRATES.iter().filter(|_| is_there) {
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
        // A project has all of them beside each other.
        let own = folder.file_name().unwrap_or_default().to_string_lossy();
        writeln!(list, "Crate {{ folder: {own:?}, files: &[")?;
        for file in &files {
            let path = file.strip_prefix(&folder)?.to_string_lossy();
            let path = path.replace('\\', "/");
            writeln!(list, "({path:?}, include_str!({file:?})),")?;
        }
        list += "] },\n";
    }
    list += "]\n";
    fs::write(out.join("crates.rs"), list)?;
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
