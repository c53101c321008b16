//! `cargo xtask identify`: the parameters of a robot's file from a recording, by the package `identify`.

use std::process::{Command, ExitCode};

use crate::kit::error::Result;
use crate::kit::shell;
use crate::kit::workspace::Workspace;

const PACKAGE: &str = "identify";
/// The profile in which its equations are solved within a second.
const PROFILE: &str = "simulated";

/// A recording, and options of the package `identify`.
#[derive(clap::Args)]
pub struct Args {
    /// The record of `cargo xtask watch`, --robot FILE, and other options: --name, --effects, --validate, --width, --cutoff, --out,
    /// --picture, --json, and those of `import` that select joints
    #[arg(value_name = "CSV", required = true, num_args = 1.., trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let mut build = workspace.cargo("build");
    shell::cargo(build.args(["--profile", PROFILE, "--package", PACKAGE]))?;
    let file = format!("{PROFILE}/{PACKAGE}{}", std::env::consts::EXE_SUFFIX);
    let mut program = Command::new(workspace.target.join(file));
    let status = shell::run_for_user(program.args(&args.arguments))?;
    // It has printed its error.
    Ok(ExitCode::from(u8::from(!status.success())))
}
