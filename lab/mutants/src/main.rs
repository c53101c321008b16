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
use crate::copy::Places;
use crate::error::{Error, Result};
use crate::outcome::{Outcome, Results, Verdict};
use crate::site::Site;
use crate::suite::{End, Test};

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
    /// Another sample
    #[arg(long, default_value_t = 1)]
    seed: u64,
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
    let sites = rooms::drawn(copy::sites(&args.root, &files)?, args.seed);
    let is_wanted = |site: &&Site| {
        let only = args.only.as_ref();
        only.is_none_or(|only| site.file.starts_with(only.as_str()))
    };
    let mut kept = Kept::read(args, &sites)?;
    let mut results = Results {
        seed: args.seed,
        ..Results::default()
    };
    for is_optimised in [true, false] {
        let of_build = |site: &Site| rooms::is_unoptimised(&site.file) != is_optimised;
        let mut sites: Vec<Site> = sites
            .iter()
            .filter(|site| of_build(site))
            .cloned()
            .collect();
        let known = kept.all_killed(args, &sites, is_optimised)?;
        if let Some(known) = known.filter(|_| args.survivors && args.only.is_none()) {
            results.outcomes.extend(known);
        } else if sites.iter().any(|site| is_wanted(&site)) {
            let programs = build(args, &files, &mut sites, is_optimised)?;
            sites.retain(|site| is_wanted(&site));
            let [optimised, unoptimised] = suite::LONGEST;
            let longest = if is_optimised { optimised } else { unoptimised };
            measure(args, &sites, (&programs, longest), &mut kept, &mut results)?;
        }
    }
    Ok(results)
}

fn kind(is_optimised: bool) -> &'static str {
    if is_optimised {
        "optimised"
    } else {
        "unoptimised"
    }
}

/// The changes of a build that do not compile.
fn refused_file(args: &Args, is_optimised: bool) -> PathBuf {
    args.dir.join(kind(is_optimised)).join("refused.json")
}

/// Builds the tests with all changes that compile, and removes the others from the list.
fn build(
    args: &Args,
    files: &[String],
    sites: &mut Vec<Site>,
    is_optimised: bool,
) -> Result<Vec<Program>> {
    let kind = kind(is_optimised);
    let [copy, target] = ["tree", "build"].map(|name| args.dir.join(kind).join(name));
    std::fs::create_dir_all(&copy).map_err(Error::file(&copy))?;
    let refused_file = refused_file(args, is_optimised);
    let mut refused: BTreeSet<String> = read(&refused_file)?.unwrap_or_default();
    loop {
        sites.retain(|site| !refused.contains(&site.key()));
        eprintln!("building the tests with {} changes, {kind} …", sites.len());
        let places: Places = copy::update(&args.root, &copy, files, sites)?;
        match compile::build(&copy, &target, &places, is_optimised)? {
            Built::Programs(programs) => return Ok(programs),
            Built::Refused(numbers) => {
                eprintln!("{} changes do not compile", numbers.len());
                let is_refused = |site: &&Site| numbers.contains(&site.number);
                refused.extend(sites.iter().filter(is_refused).map(Site::key));
                write(&refused_file, &refused)?;
            }
        }
    }
}

/// The verdicts on changes of this sample, kept for `--survivors` and for a run that was interrupted.
struct Kept {
    file: PathBuf,
    outcomes: BTreeMap<String, Outcome>,
}

impl Kept {
    fn read(args: &Args, sites: &[Site]) -> Result<Self> {
        let file = args.dir.join("verdicts.json");
        let mut outcomes: BTreeMap<String, Outcome> = read(&file)?.unwrap_or_default();
        let keys: BTreeSet<String> = sites.iter().map(Site::key).collect();
        outcomes.retain(|key, _| keys.contains(key));
        Ok(Self { file, outcomes })
    }

    /// The outcomes of a build's sites, if each that compiles was killed.
    fn all_killed(
        &self,
        args: &Args,
        sites: &[Site],
        is_optimised: bool,
    ) -> Result<Option<Vec<Outcome>>> {
        let refused: BTreeSet<String> =
            read(&refused_file(args, is_optimised))?.unwrap_or_default();
        let mut compiled = sites.iter().filter(|site| !refused.contains(&site.key()));
        Ok(compiled
            .try_fold(Vec::new(), |mut outcomes, site| {
                let verdict = self.killed(site)?;
                outcomes.push(Outcome::of(site, verdict));
                Some(outcomes)
            })
            .filter(|outcomes| !outcomes.is_empty()))
    }

    fn killed(&self, site: &Site) -> Option<Verdict> {
        let verdict = &self.outcomes.get(&site.key())?.verdict;
        Some(verdict.clone()).filter(|verdict| matches!(verdict, Verdict::Killed(_)))
    }
}

/// Runs each change against the tests that reach it, until one of them fails.
fn measure(
    args: &Args,
    sites: &[Site],
    (programs, longest): (&[Program], f64),
    kept: &mut Kept,
    results: &mut Results,
) -> Result<()> {
    let is_known = |site: &Site| args.survivors && kept.killed(site).is_some();
    let open = sites.iter().filter(|site| !is_known(site)).count();
    let log = args.dir.join("reached.txt");
    let (tests, unusable) = suite::record(programs, &log, longest, |line| eprintln!("{line}"))?;
    for name in unusable {
        eprintln!("fails or is too slow without a change: {name}");
        if !results.unusable.contains(&name) {
            results.unusable.push(name);
        }
    }
    results.tests = results.tests.max(tests.len());
    let by_site = suite::by_site(&tests);
    let mut done = 0;
    for site in sites {
        let verdict = match kept.killed(site).filter(|_| args.survivors) {
            Some(verdict) => verdict,
            None => {
                done += 1;
                verdict(
                    site,
                    by_site.get(&site.number).map_or(&[][..], Vec::as_slice),
                )?
            }
        };
        if !matches!(verdict, Verdict::Killed(_)) {
            eprintln!(
                "{done} of {open}, {verdict:?}: {}:{}: {}",
                site.file, site.line, site.change
            );
        }
        let outcome = Outcome::of(site, verdict);
        kept.outcomes.insert(site.key(), outcome.clone());
        results.outcomes.push(outcome);
        if done % 20 == 19 {
            write(&kept.file, &kept.outcomes)?;
        }
    }
    write(&kept.file, &kept.outcomes)
}

fn verdict(site: &Site, tests: &[&Test<'_>]) -> Result<Verdict> {
    for test in tests {
        match suite::with(test, site.number).map_err(Error::file(&test.program.path))? {
            End::Passed => {}
            End::Failed => return Ok(Verdict::Killed(test.full_name())),
            End::TimedOut => {
                return Ok(Verdict::Killed(format!(
                    "{} took too long",
                    test.full_name()
                )));
            }
        }
    }
    Ok(if tests.is_empty() {
        Verdict::Unreached
    } else {
        Verdict::Survived
    })
}

fn read<T: serde::de::DeserializeOwned>(path: &Path) -> Result<Option<T>> {
    match std::fs::read_to_string(path) {
        Ok(text) => serde_json::from_str(&text)
            .map(Some)
            .map_err(Error::file(path)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::file(path)(error)),
    }
}

fn write(path: &Path, value: &impl serde::Serialize) -> Result<()> {
    std::fs::write(path, to_json(value)?).map_err(Error::file(path))
}

fn to_json(value: &impl serde::Serialize) -> Result<String> {
    serde_json::to_string_pretty(value).map_err(|error| Error(error.to_string()))
}
