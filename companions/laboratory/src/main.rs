//! The laboratory: each command measures something beside what a user runs, refuses what is wrong or
//! beyond a bar, shows which figures have changed, and writes its page.

mod cores;
mod page;
mod peers;
mod robots;
mod rtl;

use std::path::PathBuf;
use std::process::{Command, ExitCode};

use clap::{Parser, Subcommand};
use xtask::kit::error::{Error, Result, check};
use xtask::kit::setup::{self, Options};
use xtask::kit::toolchain::{RELEASE, TARGET};
use xtask::kit::workspace::Workspace;
use xtask::kit::{output, processes};
use xtask::studies::study::Bench;

use page::Part;

/// From the project's root.
const MANIFEST: &str = "companions/laboratory/Cargo.toml";

/// Measures at a release, and writes the pages of companions/laboratory/docs
#[derive(Parser)]
#[command(name = "laboratory")]
struct Cli {
    #[command(subcommand)]
    study: Study,
    #[command(flatten)]
    setup: Options,
}

#[derive(Subcommand)]
enum Study {
    /// The control loop on four cores that QEMU emulates, which compute the host's bits; its stack;
    /// the images of boards
    Cores,
    /// Other libraries and this one side by side: takes an hour
    Peers,
    /// The robots of published packages, imported, checked and measured
    Robots(robots::Args),
    /// Cycles on a RISC-V core that is simulated from its register-transfer source
    Rtl,
}

fn main() -> ExitCode {
    xtask::ended(run(&Cli::parse()))
}

fn run(cli: &Cli) -> Result<ExitCode> {
    processes::end_with_us().map_err(|e| check!("cannot handle signals: {e}"))?;
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    std::env::set_current_dir(&root).map_err(Error::file("enter", root))?;
    let workspace = Workspace::find()?;
    let bench = Bench::new(&workspace, cli.setup);
    let parts: Vec<Part> = match &cli.study {
        Study::Cores => cores::measure(&bench)?,
        Study::Peers => peers::measure(&bench)?,
        Study::Robots(args) => robots::measure(&bench, args)?,
        Study::Rtl => rtl::measure(&bench)?,
    };
    let changes = page::write(&workspace, &parts, &setup::for_demo(cli.setup)?.toolchain)?;
    output::print(&changes)?;
    Ok(ExitCode::SUCCESS)
}

/// A command of cargo for a bin of the laboratory's firmware, which has a feature of its name, and
/// the path of what it builds.
fn firmware(bench: &Bench<'_>, verb: &str, bin: &str) -> Result<(Command, PathBuf)> {
    let folder = bench.workspace.target.clone();
    let mut command = bench.tools()?.toolchain.cargo(bench.workspace, verb);
    command.args(["--release", "--manifest-path", MANIFEST, "--package", "laboratory-firmware"]);
    command.args(["--features", bin, "--bin", bin, "--target-dir"]).arg(&folder);
    Ok((command, [TARGET, RELEASE, bin].iter().fold(folder, |path, name| path.join(name))))
}
