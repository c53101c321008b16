//! Builds the tests of the copy; sites that do not compile are found by where the compiler's errors are.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::copy::Places;
use crate::error::{Error, Result};
use crate::suite::{OWN, UNOPTIMISED};

/// The packages whose tests are run. The full run of the tests adds robots and scalars to `specialised-tests`, which
/// take longer to compile than all else.
const PACKAGES: [&str; 13] = [
    "dynamics-core",
    "motion-control",
    "joint-drivers",
    "host-tests",
    "cluster-tests",
    "cycle-meter",
    "flexible-tests",
    "hard-cases",
    "loop-tests",
    "simulation-tests",
    "history",
    "specialised-tests",
    "xtask",
];
const FEATURES: &str = "host-tests/full,simulation-tests/full";
/// A folder that this workspace has.
const MEMBER: &str = "host-tests/specialised";

/// A program of tests and the folder in which cargo would run it.
#[derive(Clone, Debug)]
pub struct Program {
    pub name: String,
    pub path: PathBuf,
    pub folder: PathBuf,
}

pub enum Built {
    Programs(Vec<Program>),
    /// The numbers of sites whose changes are no valid Rust there.
    Refused(BTreeSet<u32>),
}

/// Builds the tests of the packages that the copy has.
pub fn build(copy: &Path, target: &Path, places: &Places, kind: &str) -> Result<Built> {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(copy).env("CARGO_TARGET_DIR", target);
    cargo
        .env("CARGO_PROFILE_DEV_DEBUG", "0")
        .env("CARGO_INCREMENTAL", "0");
    cargo.args("build --lib --tests --keep-going --message-format=json".split(' '));
    if kind == UNOPTIMISED {
        let packages = ["", "_BUILD_OVERRIDE"];
        cargo.envs(packages.map(|of| (format!("CARGO_PROFILE_DEV{of}_OPT_LEVEL"), "0")));
    }
    // Another workspace, such as that of a test, is built as a whole.
    if kind == OWN {
        cargo.args(["--package", "motion-control", "--profile", "simulated"]);
    } else if copy.join(MEMBER).is_dir() {
        cargo.args(PACKAGES.iter().flat_map(|package| ["--package", package]));
        cargo.args(["--features", FEATURES]);
        if kind != UNOPTIMISED {
            cargo.args(["--profile", "simulated"]);
        }
    } else {
        cargo.arg("--workspace");
    }
    let output = cargo
        .stdin(Stdio::null())
        .output()
        .map_err(Error::file(copy))?;
    let (mut programs, mut refused, mut errors) = (Vec::new(), BTreeSet::new(), String::new());
    let text = String::from_utf8_lossy(&output.stdout);
    for message in text
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
    {
        programs.extend(program(&message));
        let error = &message["message"];
        if message["reason"] == "compiler-message" && error["level"] == "error" {
            refused.extend(sites_of(error, places));
            errors += error["rendered"].as_str().unwrap_or_default();
        }
    }
    if output.status.success() {
        return Ok(Built::Programs(programs));
    }
    if refused.is_empty() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(Error(format!("the copy does not compile: {errors} {said}")));
    }
    Ok(Built::Refused(refused))
}

/// The test program that a message of cargo names, if it does.
fn program(message: &Value) -> Option<Program> {
    let is_test = message["reason"] == "compiler-artifact" && message["profile"]["test"] == true;
    let path = message["executable"].as_str().filter(|_| is_test)?;
    let folder = Path::new(message["manifest_path"].as_str()?).parent()?;
    let package = folder.file_name()?.to_string_lossy();
    Some(Program {
        name: format!("{package}/{}", message["target"]["name"].as_str()?),
        path: path.into(),
        folder: folder.into(),
    })
}

/// The sites that an error is about: the innermost at each of its spans, those of macros included.
fn sites_of(error: &Value, places: &Places) -> BTreeSet<u32> {
    // The primary spans first: others may be mere context.
    let of = |is_primary: bool| {
        let spans = error["spans"].as_array().into_iter().flatten();
        let mut found = BTreeSet::new();
        for span in spans.filter(|span| span["is_primary"] == is_primary) {
            at_span(span, places, &mut found);
        }
        found
    };
    Some(of(true))
        .filter(|found| !found.is_empty())
        .unwrap_or_else(|| of(false))
}

fn at_span(span: &Value, places: &Places, found: &mut BTreeSet<u32>) {
    let byte = |name: &str| span[name].as_u64().unwrap_or(0) as usize;
    let (begin, end) = (byte("byte_start"), byte("byte_end"));
    let file = span["file_name"].as_str().unwrap_or_default();
    let of_file = || places.get(file).into_iter().flatten();
    let around = of_file().filter(|(_, bytes)| bytes.start <= begin && end <= bytes.end);
    if let Some((number, _)) = around.min_by_key(|(_, bytes)| bytes.len()) {
        found.insert(*number);
    } else {
        // An expression that contains sites.
        let inside = of_file().filter(|(_, bytes)| begin <= bytes.start && bytes.end <= end);
        found.extend(inside.map(|(number, _)| number));
    }
    if span["expansion"].is_object() {
        at_span(&span["expansion"]["span"], places, found);
    }
}
