//! The steps that need no target.

use super::{Context, Outcome};
use crate::eliminations;
use crate::error::Result;
use crate::hard_cases;
use crate::shell;
use crate::workspace::FIRMWARE;

/// What is not the firmware.
const HOST: [&str; 3] = ["--workspace", "--exclude", FIRMWARE];
/// The part of the firmware that runs anywhere.
const FIRMWARE_LIB: [&str; 3] = ["--package", FIRMWARE, "--lib"];
const DENY_WARNINGS: [&str; 3] = ["--", "-D", "warnings"];
/// The tests that take the compiler long: further robots and scalars of claims that are tested without.
const FULL: [&str; 2] = ["--features", "host-tests/full,unoptimised-tests/full"];

fn cargo(context: &Context, subcommand: &str, arguments: &[&[&str]]) -> Result<String> {
    let mut command = context.workspace.cargo(subcommand);
    if subcommand == "doc" {
        command.env("RUSTDOCFLAGS", "-D warnings");
    }
    shell::capture(command.args(arguments.concat()))
}

pub fn fmt(context: &Context) -> Result<Outcome> {
    cargo(context, "fmt", &[&["--all", "--check"]])?;
    Outcome::PASSED
}

pub fn clippy(context: &Context) -> Result<Outcome> {
    cargo(
        context,
        "clippy",
        &[&HOST, &["--all-targets"], &FULL, &DENY_WARNINGS],
    )?;
    cargo(context, "clippy", &[&FIRMWARE_LIB, &DENY_WARNINGS])?;
    Outcome::PASSED
}

pub fn tests(context: &Context) -> Result<Outcome> {
    // Not `--bins`, which builds those with `test = false` too: large ones that hold no tests.
    let kinds = ["--lib", "--tests"];
    let more: &[&str] = if context.full { &FULL } else { &[] };
    let host = cargo(context, "test", &[&HOST, &kinds, more])?;
    let firmware = cargo(context, "test", &[&FIRMWARE_LIB])?;
    Ok(Outcome::Passed(format!(
        "{} tests",
        count(&host) + count(&firmware)
    )))
}

pub fn doctests(context: &Context) -> Result<Outcome> {
    let host = cargo(context, "test", &[&HOST, &["--doc"]])?;
    let firmware = cargo(context, "test", &[&["--package", FIRMWARE, "--doc"]])?;
    Ok(Outcome::Passed(format!(
        "{} examples",
        count(&host) + count(&firmware)
    )))
}

pub fn doc(context: &Context) -> Result<Outcome> {
    cargo(context, "doc", &[&HOST, &["--no-deps"]])?;
    cargo(context, "doc", &[&FIRMWARE_LIB, &["--no-deps"]])?;
    Outcome::PASSED
}

pub fn eliminations(context: &Context) -> Result<Outcome> {
    eliminations::check(&context.workspace)?;
    Outcome::PASSED
}

pub fn hard_cases(context: &Context) -> Result<Outcome> {
    Ok(Outcome::Passed(hard_cases::check(&context.workspace)?))
}

/// The tests that passed, from `test result: ok. 12 passed; …`.
fn count(output: &str) -> u32 {
    output
        .lines()
        .filter_map(|line| line.strip_prefix("test result: ok. "))
        .filter_map(|line| line.split(' ').next()?.parse::<u32>().ok())
        .sum()
}
