//! `cargo xtask identify`: the parameters of a robot's file from a recording, by the package
//! `identification`.

use std::process::ExitCode;

use crate::kit::error::Result;
use crate::kit::host_bin::SIMULATED;
use crate::kit::shell;
use crate::kit::workspace::Workspace;

/// A recording, and options of the package `identification`.
#[derive(clap::Args)]
pub struct Args {
    /// The record of `cargo xtask watch`, --robot FILE, and other options: --name, --effects,
    /// --validate, --width, --cutoff, --out, --picture, --json, and those of `import` that select
    /// joints
    #[arg(value_name = "CSV", required = true, num_args = 1.., trailing_var_arg = true, allow_hyphen_values = true)]
    pub arguments: Vec<String>,
}

pub fn run(arguments: &[String]) -> Result<ExitCode> {
    // By the profile in which its equations are solved within a second.
    let mut program = SIMULATED.program(&Workspace::find()?, "identify")?;
    let status = shell::run_for_user(program.args(arguments))?;
    // It has printed its error.
    Ok(ExitCode::from(u8::from(!status.success())))
}
