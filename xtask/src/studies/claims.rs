//! `cargo xtask claims`: the ledger of claims, which a test of the documents reads, checks and writes.

use std::process::ExitCode;

use clap::ArgMatches;

use crate::kit::error::Result;
use crate::kit::setup::Options;
use crate::kit::shell;
use crate::kit::workspace::Workspace;
use crate::studies::study::Bench;

const TESTS: [&str; 4] = ["--quiet", "--package", "guide", "claims::"];

/// Writes the page, or says which entries do not hold.
pub fn run(_: Options, _: &ArgMatches) -> Result<ExitCode> {
    let mut cargo = Workspace::find()?.cargo("test");
    shell::capture(cargo.args(TESTS).env("UPDATE_EXPECT", "1"))?;
    Ok(ExitCode::SUCCESS)
}

pub fn check(bench: &Bench<'_>) -> Result<String> {
    let mut cargo = bench.workspace.cargo("test");
    shell::capture(cargo.args(TESTS)).map(|_| String::new())
}
