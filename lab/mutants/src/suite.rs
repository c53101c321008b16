//! The tests: how long each of them takes, and which sites it reaches.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

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

/// How a test ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Passed,
    Failed,
    /// It took more than ten times as long as without a change.
    TimedOut,
}

/// The shortest time after which a test is ended: the machine may have other work.
const SHORTEST: f64 = 10.0;
/// The longest time that a test may take without a change, s, with and without optimisation.
pub const LONGEST: [f64; 2] = [600.0, 40.0];
/// What a test may allocate, KiB: a loop that does not end could take all there is.
const MEMORY: u64 = 4 << 20;

/// The tests of a program, without those that are ignored.
fn names(program: &Program) -> Result<Vec<String>> {
    let list = |arguments: &[&str]| -> Result<Vec<String>> {
        let mut command = Command::new(&program.path);
        command
            .current_dir(&program.folder)
            .args(["--list", "--format", "terse"])
            .args(arguments);
        let output = command
            .stdin(Stdio::null())
            .output()
            .map_err(Error::file(&program.path))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(text
            .lines()
            .filter_map(|line| line.strip_suffix(": test").map(str::to_owned))
            .collect())
    };
    let ignored = list(&["--ignored"])?;
    let mut names = list(&[])?;
    names.retain(|name| !ignored.contains(name));
    Ok(names)
}

/// Runs every test once, alone. Those that fail without a change, or take longer than `longest`, by their names, are of no use
/// here.
pub fn record<'a>(
    programs: &'a [Program],
    log: &Path,
    longest: f64,
    say: impl Fn(&str),
) -> Result<(Vec<Test<'a>>, Vec<String>)> {
    let (mut tests, mut failed) = (Vec::new(), Vec::new());
    for program in programs {
        let names = names(program)?;
        say(&format!("{}: {} tests", program.name, names.len()));
        for name in names {
            if log.exists() {
                std::fs::remove_file(log).map_err(Error::file(log))?;
            }
            let begin = Instant::now();
            let variables = [
                ("MUTANT", "record".as_ref()),
                ("MUTANT_LOG", log.as_os_str()),
            ];
            let end =
                run(program, &name, &variables, longest).map_err(Error::file(&program.path))?;
            let seconds = begin.elapsed().as_secs_f64();
            let reached = std::fs::read_to_string(log).unwrap_or_default();
            let sites = reached
                .lines()
                .filter_map(|line| line.parse().ok())
                .collect();
            let test = Test {
                program,
                name,
                seconds,
                sites,
            };
            match end {
                End::Passed => tests.push(test),
                _ => failed.push(test.full_name()),
            }
        }
    }
    // The fastest first, for every change.
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    Ok((tests, failed))
}

/// Runs a test with a change.
pub fn with(test: &Test<'_>, number: u32) -> io::Result<End> {
    let limit = f64::max(10.0 * test.seconds, SHORTEST);
    let number = number.to_string();
    run(
        test.program,
        &test.name,
        &[("MUTANT", number.as_ref())],
        limit,
    )
}

fn run(
    program: &Program,
    test: &str,
    variables: &[(&str, &std::ffi::OsStr)],
    limit: f64,
) -> io::Result<End> {
    // `timeout` ends the processes that the test has started as well.
    let line = format!(
        "ulimit -v {MEMORY}; exec nice -n 15 timeout -s KILL {} \"$@\"",
        limit.ceil()
    );
    let mut command = Command::new("sh");
    command.args(["-c", &line, "sh"]).arg(&program.path);
    command.args(["--exact", test, "--test-threads", "1", "--quiet"]);
    command
        .current_dir(&program.folder)
        .env("CARGO_MANIFEST_DIR", &program.folder)
        .env("RUST_BACKTRACE", "0");
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.envs(variables.iter().copied());
    let begin = Instant::now();
    let status = command.status()?;
    Ok(end(
        status,
        begin.elapsed() >= Duration::from_secs_f64(limit),
    ))
}

fn end(status: ExitStatus, is_over: bool) -> End {
    match status.success() {
        true => End::Passed,
        false if is_over => End::TimedOut,
        false => End::Failed,
    }
}

/// The tests that reach each site, the fastest first.
pub fn by_site<'a>(tests: &'a [Test<'a>]) -> BTreeMap<u32, Vec<&'a Test<'a>>> {
    let mut by_site: BTreeMap<u32, Vec<&Test<'_>>> = BTreeMap::new();
    for test in tests {
        for site in &test.sites {
            by_site.entry(*site).or_default().push(test);
        }
    }
    by_site
}
