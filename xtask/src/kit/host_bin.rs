//! The programs that measure and simulate on the host.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::de::DeserializeOwned;

use crate::kit::error::{Result, check, refuse_if};
use crate::kit::shell;
use crate::kit::workspace::Workspace;

/// The packages of the host whose crates are built together, whichever of their programs is wanted: another selection has other
/// features of the crates below, which would be compiled once more. xtask is there already, with features of its own.
pub const SHARED: &str = "--workspace --exclude xtask --exclude telemetry-watch --exclude telemetry-pil --exclude firmware-demo \
     --exclude lab-target --exclude identification --exclude identify --exclude simulation-tests --exclude trial-tests --exclude play --exclude site";

/// The packages that simulate, likewise, and the profile that inlines the library into them.
pub const SIMULATED: &str = "--profile simulated --package identification --package identify --package simulation-tests --package trial-tests";

/// Builds programs of [`SHARED`] packages, and returns their folder.
pub fn build(workspace: &Workspace, targets: &[&str]) -> Result<PathBuf> {
    built(workspace, SHARED, targets, "debug")
}

fn built(workspace: &Workspace, of: &str, targets: &[&str], folder: &str) -> Result<PathBuf> {
    let mut command = workspace.cargo("build");
    let command = command.arg("--quiet").args(of.split_whitespace());
    shell::capture(command.args(targets))?;
    Ok(workspace.target.join(folder))
}

/// Runs a program in a folder, and returns what it printed.
pub fn run(folder: &Path, name: &str) -> Result<String> {
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    shell::capture(&mut Command::new(folder.join(file)))
}

/// What a bin of the [`SHARED`] packages prints.
pub fn text(workspace: &Workspace, bin: &str) -> Result<String> {
    run(&build(workspace, &["--bin", bin])?, bin)
}

/// What a bin of the [`SIMULATED`] packages prints.
pub fn simulated(workspace: &Workspace, bin: &str) -> Result<String> {
    run(
        &built(workspace, SIMULATED, &["--bin", bin], "simulated")?,
        bin,
    )
}

/// The JSON that a bin of the [`SHARED`] packages prints.
pub fn json<T: DeserializeOwned>(workspace: &Workspace, bin: &str) -> Result<T> {
    parsed(bin, &text(workspace, bin)?)
}

/// The JSON that a bin printed.
pub fn parsed<T: DeserializeOwned>(bin: &str, text: &str) -> Result<T> {
    serde_json::from_str(text).map_err(|e| check!("`{bin}` printed what is not understood: {e}"))
}

/// Fails unless what `name` printed in QEMU is, line by line, what it printed on the host.
pub fn same_lines(name: &str, on_target: &[impl AsRef<str>], on_host: &str) -> Result<()> {
    let on_host: Vec<&str> = on_host.lines().collect();
    for (target, host) in std::iter::zip(on_target, &on_host) {
        let target = target.as_ref();
        refuse_if!(
            target != *host,
            "`{name}` differs:\n  QEMU: {target}\n  host: {host}"
        );
    }
    let (there, here) = (on_target.len(), on_host.len());
    refuse_if!(
        there == 0 || there != here,
        "`{name}` printed {there} lines in QEMU and {here} on the host"
    );
    Ok(())
}
