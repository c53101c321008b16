//! The tests: how long each of them takes, and which sites it reaches.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use crate::compile::Program;
use crate::error::{Error, Result};

/// A test that passes without a change.
#[derive(Clone, Debug)]
pub struct Test<'a> {
    pub program: &'a Program,
    pub name: String,
    pub seconds: f64,
    pub sites: BTreeSet<u32>,
}

impl Test<'_> {
    pub fn full_name(&self) -> String {
        format!("{}: {}", self.program.name, self.name)
    }
}

/// The shortest time after which a test is ended: the machine may have other work.
const SHORTEST: f64 = 10.0;
/// The build without optimisation.
pub const UNOPTIMISED: &str = "unoptimised";
/// The build of the package whose every change is taken, and of its own tests alone, which takes seconds.
pub const OWN: &str = "own";
/// The build of the sample.
pub const OPTIMISED: &str = "optimised";
/// The builds, and the longest time that a test may take in them without a change, s.
pub const LONGEST: [(&str, f64); 3] = [(OWN, 40.0), (OPTIMISED, 600.0), (UNOPTIMISED, 40.0)];
/// What a test may allocate, KiB: a loop that does not end could take all there is.
const MEMORY: u64 = 4 << 20;

/// The tests of a program, without those that are ignored.
fn names(program: &Program) -> Result<Vec<String>> {
    let list = |also: Option<&str>| -> Result<Vec<String>> {
        let mut command = Command::new(&program.path);
        command.current_dir(&program.folder).stdin(Stdio::null());
        command.args(["--list", "--format", "terse"]).args(also);
        let output = command.output().map_err(Error::file(&program.path))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let names = text.lines().filter_map(|line| line.strip_suffix(": test"));
        Ok(names.map(str::to_owned).collect())
    };
    let ignored = list(Some("--ignored"))?;
    let mut names = list(None)?;
    names.retain(|name| !ignored.contains(name));
    Ok(names)
}

/// Runs every test once, alone, the fastest first in what it returns. Those that fail without a change, or take longer than
/// `longest`, by their names, are of no use here.
pub fn record<'a>(
    programs: &'a [Program],
    log: &Path,
    longest: f64,
) -> Result<(Vec<Test<'a>>, Vec<String>)> {
    let (mut tests, mut failed) = (Vec::new(), Vec::new());
    for program in programs {
        let names = names(program)?;
        eprintln!("{}: {} tests", program.name, names.len());
        for name in names {
            // An empty file instead of that of the test before.
            std::fs::write(log, "").map_err(Error::file(log))?;
            let begin = Instant::now();
            let variables = [
                ("MUTANT", "record".as_ref()),
                ("MUTANT_LOG", log.as_os_str()),
            ];
            let passed = run(program, &name, &variables, longest)?;
            let reached = std::fs::read_to_string(log).unwrap_or_default();
            let test = Test {
                program,
                name,
                seconds: begin.elapsed().as_secs_f64(),
                sites: reached
                    .lines()
                    .filter_map(|line| line.parse().ok())
                    .collect(),
            };
            match passed {
                true => tests.push(test),
                false => failed.push(test.full_name()),
            }
        }
    }
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    Ok((tests, failed))
}

/// Whether a test passes with a change.
pub fn passes_with(test: &Test<'_>, number: u32) -> Result<bool> {
    let limit = f64::max(10.0 * test.seconds, SHORTEST);
    let number = number.to_string();
    run(
        test.program,
        &test.name,
        &[("MUTANT", number.as_ref())],
        limit,
    )
}

/// Whether a test passes within so many seconds.
fn run(program: &Program, test: &str, variables: &[(&str, &OsStr)], limit: f64) -> Result<bool> {
    // `timeout` ends the processes that the test has started as well.
    let limit = limit.ceil();
    let line = format!("ulimit -v {MEMORY}; exec nice -n 15 timeout -s KILL {limit} \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &line, "sh"]).arg(&program.path);
    command.args(["--exact", test, "--test-threads", "1", "--quiet"]);
    command
        .current_dir(&program.folder)
        .envs(variables.iter().copied());
    command
        .env("CARGO_MANIFEST_DIR", &program.folder)
        .env("RUST_BACKTRACE", "0");
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let status = command.status().map_err(Error::file(&program.path))?;
    Ok(status.success())
}
