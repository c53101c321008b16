//! The steps that need no target.

use super::Context;
use crate::error::Result;

/// The tests that take the compiler long: further robots and scalars of claims that are tested without.
const FULL: &str = "--features host-tests/full,specialised-tests/full";
/// What is neither the firmware nor what listens to it: the steps `telemetry` and `pil` build and test that.
const HOST: &str =
    "--workspace --exclude firmware-demo --exclude telemetry-watch --exclude telemetry-pil";
/// The part of the firmware that runs anywhere.
const FIRMWARE: &str = "--package firmware-demo --lib";

pub fn clippy(context: &Context) -> Result<String> {
    context.cargo(&[
        &format!("clippy {HOST} --all-targets {FULL} -- -D warnings"),
        &format!("clippy {FIRMWARE} -- -D warnings"),
        "clippy --package telemetry-watch --package telemetry-pil --all-targets -- -D warnings",
    ])
}

pub fn tests(context: &Context) -> Result<String> {
    let more = if context.full { FULL } else { "" };
    // Not `--bins`, which builds those with `test = false` too: large ones that hold no tests.
    let printed = context.cargo(&[
        // All failures in one run, which takes long.
        &format!("test {HOST} --lib --tests --no-fail-fast {more}"),
        &format!("test {FIRMWARE}"),
    ])?;
    Ok(format!("{} tests", count(&printed)))
}

pub fn doctests(context: &Context) -> Result<String> {
    let of_firmware = "test --package firmware-demo --doc";
    let printed = context.cargo(&[&format!("test {HOST} --doc"), of_firmware])?;
    Ok(format!("{} examples", count(&printed)))
}

pub fn doc(context: &Context) -> Result<String> {
    // Without private items too: a link to one of them is broken only there.
    for private in ["", "--document-private-items"] {
        context.cargo(&[
            &format!("doc {HOST} --no-deps {private}"),
            &format!("doc {FIRMWARE} --no-deps {private}"),
        ])?;
    }
    Ok(String::new())
}

/// The tests that passed, from `test result: ok. 12 passed; …`.
fn count(output: &str) -> u32 {
    let results = output
        .lines()
        .filter_map(|line| line.strip_prefix("test result: ok. "));
    results
        .filter_map(|line| line.split(' ').next()?.parse::<u32>().ok())
        .sum()
}
