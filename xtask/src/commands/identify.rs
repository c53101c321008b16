//! `cargo xtask identify`: the parameters of a robot's file from a recording, by the package
//! `identification`.

use crate::kit::error::Result;
use crate::kit::host_bin::SIMULATED;
use crate::kit::shell;
use crate::kit::workspace::Workspace;

/// A recording, and options of the program `identify`, whose `--help` lists them.
#[derive(clap::Args)]
#[command(disable_help_flag = true)]
pub struct Args {
    /// A record, --robot FILE, and other options: --help lists them
    #[arg(value_name = "FILE", trailing_var_arg = true, allow_hyphen_values = true)]
    pub arguments: Vec<String>,
}

pub fn run(arguments: &[String]) -> Result<std::process::ExitCode> {
    // By the profile in which its equations are solved within a second.
    let mut program = SIMULATED.program(&Workspace::find()?, "identify")?;
    let status = shell::run_for_user(program.args(arguments))?;
    // It has printed its error.
    Ok(u8::from(!status.success()).into())
}
