//! Mutants: small changes to the code, one at a time, each against the tests that reach it.
//!
//! A copy of the workspace in the target directory has a switch at each site of a deterministic sample; a variable of
//! the environment selects one change. One build then serves all. `cargo xtask mutants` runs this and writes
//! docs/mutants.md; the results are JSON on stdout.

mod changes;
mod compile;
mod copy;
mod error;
mod find;
mod outcome;
mod rooms;
mod site;
mod suite;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use crate::compile::{Built, Program};
use crate::error::{Error, Result};
use crate::outcome::{Outcome, Results, Verdict};
use crate::site::Site;
use crate::suite::Test;

/// Small changes to the code, one at a time, each against the tests that reach it
#[derive(Parser)]
struct Args {
    /// The workspace
    #[arg(long)]
    root: PathBuf,
    /// Where the copy, its builds and the results are kept
    #[arg(long)]
    dir: PathBuf,
    /// Only changes to files whose paths begin so
    #[arg(long)]
    only: Option<String>,
    /// Only changes that survived the last time, or that it did not have
    #[arg(long)]
    survivors: bool,
    /// Only the rooms of which every change is taken
    #[arg(long)]
    rooms: bool,
}

fn main() -> ExitCode {
    let printed = run(&Args::parse()).and_then(|results| to_json(&results));
    match printed {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<Results> {
    let files = copy::files(&args.root)?;
    let mut sites = rooms::drawn(copy::sites(&args.root, &files)?);
    let kept_file = args.dir.join("verdicts.json");
    let mut kept: BTreeMap<String, Outcome> = read(&kept_file)?;
    kept.retain(|key, _| sites.iter().any(|site| site.key() == *key));
    sites.retain(|site| !args.rooms || rooms::is_whole(&site.file));
    let mut results = Results::default();
    let only = args.only.as_deref().unwrap_or_default();
    for (kind, longest) in suite::LONGEST {
        let is_of_build = |site: &&Site| rooms::build_of(&site.file) == kind;
        let mut sites: Vec<Site> = sites.iter().filter(is_of_build).cloned().collect();
        let mut build = Build::read(args, kind)?;
        sites.retain(|site| !build.refused.contains(&site.key()));
        let is_open = |site: &Site, kept: &BTreeMap<String, Outcome>| {
            let verdict = kept.get(&site.key()).map(|outcome| &outcome.verdict);
            let is_known = args.survivors && matches!(verdict, Some(Verdict::Killed(_)));
            site.file.starts_with(only) && !is_known
        };
        if sites.iter().any(|site| is_open(site, &kept)) {
            let programs = build.programs(args, &files, &mut sites)?;
            let log = args.dir.join("reached.txt");
            let (tests, unusable) = suite::record(&programs, &log, longest)?;
            results.tests = results.tests.max(tests.len());
            for name in unusable {
                eprintln!("fails or is too slow without a change: {name}");
                if !results.unusable.contains(&name) {
                    results.unusable.push(name);
                }
            }
            let open = sites.iter().filter(|site| is_open(site, &kept)).cloned();
            let open: Vec<Site> = open.collect();
            for (number, site) in (1..).zip(&open) {
                let outcome = Outcome::of(site, verdict(site, &tests)?);
                if !matches!(outcome.verdict, Verdict::Killed(_)) {
                    let (key, of) = (site.key(), open.len());
                    eprintln!("{number} of {of}, {:?}: {key}", outcome.verdict);
                }
                kept.insert(site.key(), outcome);
                // A run may be interrupted.
                if number % 20 == 0 || number == open.len() {
                    write(&kept_file, &kept)?;
                }
            }
        }
    }
    let wanted = sites.iter().filter(|site| site.file.starts_with(only));
    results.outcomes = wanted
        .filter_map(|site| kept.get(&site.key()).cloned())
        .collect();
    Ok(results)
}

struct Build {
    kind: &'static str,
    folder: PathBuf,
    /// The keys of changes that do not compile.
    refused: BTreeSet<String>,
}

impl Build {
    fn read(args: &Args, kind: &'static str) -> Result<Self> {
        let folder = args.dir.join(kind);
        let refused = read(&folder.join("refused.json"))?;
        Ok(Self {
            kind,
            folder,
            refused,
        })
    }

    /// Builds the tests with all changes that compile, and removes the others from the list.
    fn programs(
        &mut self,
        args: &Args,
        files: &[String],
        sites: &mut Vec<Site>,
    ) -> Result<Vec<Program>> {
        let [copy, target] = ["tree", "build"].map(|name| self.folder.join(name));
        std::fs::create_dir_all(&copy).map_err(Error::file(&copy))?;
        loop {
            eprintln!(
                "building the tests with {} changes, {} …",
                sites.len(),
                self.kind
            );
            let places = copy::update(&args.root, &copy, files, sites)?;
            match compile::build(&copy, &target, &places, self.kind)? {
                Built::Programs(programs) => return Ok(programs),
                Built::Refused(numbers) => {
                    eprintln!("{} changes do not compile", numbers.len());
                    let is_refused = |site: &&Site| numbers.contains(&site.number);
                    self.refused
                        .extend(sites.iter().filter(is_refused).map(Site::key));
                    sites.retain(|site| !numbers.contains(&site.number));
                    write(&self.folder.join("refused.json"), &self.refused)?;
                }
            }
        }
    }
}

/// Runs the tests that reach a change, the fastest first, until one of them fails.
fn verdict(site: &Site, tests: &[Test<'_>]) -> Result<Verdict> {
    let mut verdict = Verdict::Unreached;
    for test in tests
        .iter()
        .filter(|test| test.sites.contains(&site.number))
    {
        if !suite::passes_with(test, site.number)? {
            return Ok(Verdict::Killed(test.full_name()));
        }
        verdict = Verdict::Survived;
    }
    Ok(verdict)
}

/// What a file has in JSON; nothing if there is none.
fn read<T: serde::de::DeserializeOwned + Default>(path: &Path) -> Result<T> {
    match path.exists() {
        true => {
            let text = std::fs::read_to_string(path).map_err(Error::file(path))?;
            serde_json::from_str(&text).map_err(Error::file(path))
        }
        false => Ok(T::default()),
    }
}

fn write(path: &Path, value: &impl serde::Serialize) -> Result<()> {
    std::fs::write(path, to_json(value)?).map_err(Error::file(path))
}

fn to_json(value: &impl serde::Serialize) -> Result<String> {
    serde_json::to_string_pretty(value).map_err(|error| Error(error.to_string()))
}
