//! The programs that measure and simulate on the host.

use std::process::Command;

use serde::de::DeserializeOwned;

use crate::kit::error::{Result, check, refuse_if};
use crate::kit::progress::Spinner;
use crate::kit::shell;
use crate::kit::workspace::Workspace;

/// Packages of the host whose crates are built together, whichever of their programs is wanted:
/// another selection, or a feature more or less, has other features of the crates below, which
/// would be compiled once more.
pub struct Together {
    packages: &'static str,
    /// The further tests of a full run: further robots, scalars and hours of claims that
    /// are tested without.
    pub full: &'static str,
    folder: &'static str,
}

/// All but those that simulate; identification without its files. xtask is there already, with features of its own.
pub const SHARED: Together = Together {
    packages: "--workspace --exclude xtask --exclude telemetry-watch --exclude firmware-demo \
         --exclude lab-firmware --exclude simulation-tests",
    // Hard cases that compute for minutes are optimised.
    full: "--features dynamics-c/full,host-tests/full,robot-import/full \
         --config profile.dev.package.dynamics-c.opt-level=1 \
         --config profile.dev.package.simulation-tests.opt-level=2",
    folder: "debug",
};

/// The packages that simulate, and the profile that inlines the library into them.
pub const SIMULATED: Together = Together {
    packages: "--profile simulated --package identification --package simulation-tests \
         --features identification/files",
    full: "--features simulation-tests/full",
    folder: "simulated",
};

impl Together {
    /// The words by which cargo selects the packages.
    pub fn words(&self, full: bool) -> String {
        format!("{} {}", self.packages, if full { self.full } else { "" })
    }

    /// A command that builds what further words select.
    pub fn build(&self, workspace: &Workspace) -> Command {
        let mut command = workspace.cargo("build");
        let words = format!("--quiet {}", self.words(workspace.full));
        command.args(words.split_whitespace());
        command
    }

    /// A program that has been built, by its path from the folder of programs.
    pub fn built(&self, workspace: &Workspace, path: &str) -> Command {
        let file = format!("{}/{path}{}", self.folder, std::env::consts::EXE_SUFFIX);
        Command::new(workspace.target.join(file))
    }

    /// A bin, built.
    pub fn program(&self, workspace: &Workspace, bin: &str) -> Result<Command> {
        let _building = Spinner::start(&format!("building `{bin}`, the first time for minutes"));
        shell::capture(self.build(workspace).args(["--bin", bin]))?;
        Ok(self.built(workspace, bin))
    }

    /// The output of a bin.
    pub fn text(&self, workspace: &Workspace, bin: &str) -> Result<String> {
        shell::capture(&mut self.program(workspace, bin)?)
    }
}

/// The JSON that a bin of the [`SHARED`] packages prints.
pub fn json<T: DeserializeOwned>(workspace: &Workspace, bin: &str) -> Result<T> {
    parsed(bin, &SHARED.text(workspace, bin)?)
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
        refuse_if!(target != *host, "`{name}` differs:\n  QEMU: {target}\n  host: {host}");
    }
    let (there, here) = (on_target.len(), on_host.len());
    refuse_if!(
        there == 0 || there != here,
        "`{name}` printed {there} lines in QEMU and {here} on the host"
    );
    Ok(())
}
