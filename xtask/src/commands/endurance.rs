//! `cargo xtask fuzz`, `cargo xtask soak`, `cargo xtask miri`: what takes longer than CI has time
//! for.

use std::process::ExitCode;

use crate::kit::error::Result;
use crate::kit::workspace::Workspace;
use crate::kit::{output, shell, toolchain};

/// The crate of the fuzz targets, a workspace of its own.
const FUZZ: &str = "host-tests/fuzz";

/// Feeds every target random bytes for a number of seconds.
pub fn fuzz(seconds: u64) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let mut command = workspace.cargo("test");
    command.args("--test targets -- --test-threads 2 --nocapture".split(' '));
    command.current_dir(workspace.root.join(FUZZ));
    command.env("CARGO_TARGET_DIR", workspace.target.join("fuzz"));
    command.env("BOLERO_RANDOM_TEST_TIME_MS", (1000 * seconds).to_string());
    output::note(&format!(
        "each target for {seconds} s; a failure names its input and BOLERO_RANDOM_SEED, which \
         repeats it"
    ));
    shell::run(&mut command).map(|()| ExitCode::SUCCESS)
}

/// Runs the control loop under random faults for a number of ticks.
pub fn soak(ticks: u64) -> Result<ExitCode> {
    let mut command = Workspace::find()?.cargo("test");
    command.args("--package simulation-tests -- --nocapture soak::".split(' '));
    command.env("SOAK_TICKS", ticks.to_string());
    shell::run(&mut command).map(|()| ExitCode::SUCCESS)
}

/// Runs the libraries' unit tests in Miri, if a nightly toolchain has it.
pub fn miri() -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let nightly = |arguments: &str| {
        let mut command = toolchain::rustup("nightly", "cargo");
        command.arg("miri").args(arguments.split(' ')).current_dir(&workspace.root);
        command.env("CARGO_TARGET_DIR", workspace.target.join("miri"));
        command
    };
    if !shell::succeeds(&mut nightly("--version")) {
        output::line(
            "skipped: no nightly toolchain with Miri (rustup toolchain install nightly --component \
             miri,rust-src)",
        )?;
        return Ok(ExitCode::SUCCESS);
    }
    // libm takes instructions of the host that Miri does not know, unless it is told not to.
    let soft = "--features libm/force-soft-floats";
    let tests = format!("test --package dynamics-core --package motion-control --lib {soft}");
    shell::run(&mut nightly(&tests)).map(|()| ExitCode::SUCCESS)
}
