//! `cargo xtask claims`: the ledger of claims, which a test of the documents reads, checks and writes.

use std::process::{Command, ExitCode};

use clap::ArgMatches;

use crate::kit::error::Result;
use crate::kit::host_bin::SHARED;
use crate::kit::setup::Options;
use crate::kit::shell;
use crate::kit::workspace::Workspace;
use crate::studies::study::Bench;

/// The tests of the ledger.
fn tests(workspace: &Workspace) -> Command {
    let mut cargo = workspace.cargo("test");
    cargo.args(SHARED.words(workspace.full).split_whitespace());
    cargo.args(["--quiet", "--test", "guide", "claims::"]);
    cargo
}

/// Writes the page, or says which entries do not hold.
pub fn run(_: Options, _: &ArgMatches) -> Result<ExitCode> {
    shell::capture(tests(&Workspace::find()?).env("UPDATE_EXPECT", "1"))?;
    Ok(ExitCode::SUCCESS)
}

pub fn check(bench: &Bench<'_>) -> Result<String> {
    shell::capture(&mut tests(bench.workspace)).map(|_| String::new())
}
