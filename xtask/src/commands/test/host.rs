//! The steps that need no target.

use std::path::{Path, PathBuf};

use super::Context;
use crate::kit::error::{Result, refuse_if};
use crate::kit::host_bin::{SHARED, SIMULATED, Together};
use crate::kit::sources::sources;
use crate::kit::{shell, workspace};

/// All but the firmware, whose bins link only for a Cortex-M.
const WITHOUT_FIRMWARE: &str = "--exclude firmware-demo --exclude lab-firmware";

/// All packages, with what the tests of a full run have besides.
fn everything() -> String {
    let [shared, simulated] = [SHARED, SIMULATED].map(|these| these.full);
    format!("--workspace {shared} {simulated}")
}

pub fn clippy(context: &Context) -> Result<String> {
    // It reads the part of the firmware that runs anywhere, too, since others depend on it.
    let words = "--all-targets -- -D warnings";
    context.cargo(&[format!("clippy {} {WITHOUT_FIRMWARE} {words}", everything())])?;
    let mut firmware = context.tools.toolchain.firmware(&context.workspace, "clippy");
    shell::capture(firmware.args(["--lib", "--bins", "--", "-D", "warnings"]))
}

/// The files of tests beside a `main.rs` that does not name them, which cargo would not compile.
fn unnamed(root: &Path) -> Result<Vec<PathBuf>> {
    let mut unnamed = Vec::new();
    let all = sources(root)?;
    let programs = ["tests", "clusters", "specialised"].map(|name| format!("{name}/main.rs"));
    let is_of_tests = |path: &&PathBuf| programs.iter().any(|program| path.ends_with(program));
    for main in all.iter().filter(is_of_tests) {
        let text = workspace::read(main)?;
        let beside = all.iter().filter(|path| path.parent() == main.parent());
        unnamed.extend(beside.filter(|path| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            name != "main" && !text.contains(&format!("mod {name};"))
        }));
    }
    Ok(unnamed.into_iter().cloned().collect())
}

/// The tests, by cargo's command line.
fn lines(full: bool) -> [String; 2] {
    [tests_of(&SHARED, full), "test --package xtask".into()]
}

/// The tests of packages: neither `--lib` nor `--bins`, which compile what has `test = false`, too.
fn tests_of(packages: &Together, full: bool) -> String {
    format!("test {} --tests", packages.words(full))
}

pub fn tests(context: &Context) -> Result<String> {
    let unnamed = unnamed(&context.workspace.root)?;
    refuse_if!(!unnamed.is_empty(), "no `mod` in the `main.rs` beside them: {unnamed:?}");
    let [all, xtask] = lines(context.full);
    // All failures in one run, which takes long.
    let printed = context.cargo(&[format!("{all} --no-fail-fast"), xtask])?;
    Ok(format!("{} tests", count(&printed)))
}

/// The tests that simulate, which another profile compiles.
pub fn simulations(context: &Context) -> Result<String> {
    let tests = tests_of(&SIMULATED, true);
    let printed = context.cargo(&[format!("{tests} --no-fail-fast")])?;
    Ok(format!("{} tests", count(&printed)))
}

pub fn doctests(context: &Context) -> Result<String> {
    let line = |these: Together| format!("test {} --doc", these.words(context.full));
    let lines = [SHARED, SIMULATED].map(line);
    let printed = context.cargo(&lines[..1 + usize::from(context.full)])?;
    Ok(format!("{} examples", count(&printed)))
}

pub fn doc(context: &Context) -> Result<String> {
    let all = everything();
    // Without private items too: a link to one of them is broken only there. A program's are
    // documented in any case.
    context.cargo(&[
        format!("doc {all} {WITHOUT_FIRMWARE} --no-deps --document-private-items"),
        format!("doc {all} --lib --no-deps --document-private-items"),
        format!("doc {all} --lib --no-deps"),
    ])?;
    Ok(String::new())
}

/// The tests that passed, from `test result: ok. 12 passed; …`.
fn count(output: &str) -> u32 {
    let results = output.lines().filter_map(|line| line.strip_prefix("test result: ok. "));
    results.filter_map(|line| line.split(' ').next()?.parse::<u32>().ok()).sum()
}

#[cfg(test)]
mod tests {
    use super::unnamed;

    #[test]
    fn a_file_of_tests_without_its_mod_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        let tests = folder.path().join("drivers/tests");
        std::fs::create_dir_all(&tests).expect("a folder");
        for (file, text) in [("main", "mod can;"), ("can", ""), ("loops", "")] {
            std::fs::write(tests.join(format!("{file}.rs")), text).expect("a file");
        }
        let found = unnamed(folder.path()).expect("a folder");
        assert_eq!(found, [tests.join("loops.rs")]);
    }
}
