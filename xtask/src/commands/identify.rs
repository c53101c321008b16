//! `cargo xtask identify`: the parameters of a robot's file from a recording, by the package `identify`.

use std::process::{Command, ExitCode};

use crate::kit::error::Result;
use crate::kit::shell;
use crate::kit::workspace::Workspace;

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
    // In which its equations are solved within a second.
    let words = "--profile simulated --package identify".split(' ');
    shell::cargo(workspace.cargo("build").args(words))?;
    // Where programs have an ending, the system adds it.
    let program = workspace.target.join("simulated/identify");
    let status = shell::run_for_user(Command::new(program).args(&args.arguments))?;
    // It has printed its error.
    Ok(ExitCode::from(u8::from(!status.success())))
}
