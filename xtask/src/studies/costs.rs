//! `cargo xtask costs`: what each algorithm costs on each robot, and what it may.

mod record;
mod report;

use std::process::ExitCode;

use crate::kit::bars::Bars;
use crate::kit::error::Result;
use crate::kit::own_robot::{self, OwnRobot};
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::setup::{self, Options, Tools};
use crate::kit::toolchain::{RELEASE, SMALL};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, firmware, output};
use crate::studies::budgets;
use crate::studies::scenes::first_screen;
use crate::studies::study::Bench;

pub use report::Report;

/// Two bins for each robot, inverse dynamics and the rest, but one for the SO-101 and for the PUMA,
/// two for robots with loops, one for links that bend, and one for the tick of an arm on CAN: the
/// compiler builds them side by side.
pub const BINS: [&str; 15] = [
    "costs_ur5e",
    "forward_ur5e",
    "costs_panda",
    "forward_panda",
    "costs_iiwa14",
    "forward_iiwa14",
    "costs_a1",
    "forward_a1",
    "costs_so101",
    "costs_puma560",
    "costs_laws",
    "costs_clusters",
    "costs_loops",
    "costs_flexible",
    "costs_free_drive",
];

pub const PAGE: &str = "docs/costs.md";
const COMMAND: &str = "cargo xtask costs";
/// The bins that measure the robot of a file: inverse dynamics, and the rest.
const OWN_BINS: [&str; 2] = ["own_costs", "own_forward"];
/// More joints than this do not fit into RAM.
const OWN_JOINTS: u64 = 40;
/// The joints for which the rest fits into RAM: it holds M at 32 states.
const FORWARD_JOINTS: u64 = 20;

#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    own: own_robot::Args,
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    pub json: bool,
}

/// Measures, writes the page and prints it.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    if let Some(robot) = args.own.robot(&Workspace::find()?, OWN_JOINTS)? {
        return run_own(options, &robot, args.json);
    }
    let workspace = Workspace::for_reports()?;
    let tools = setup::for_demo(options)?;
    let report = measure(&workspace, &tools)?;
    let page = report.markdown();
    workspace::write(&workspace.report(PAGE), docs::seal::sealed(&page))?;
    first_screen::write_why(&workspace)?;
    docs::show(args.json, &report.rows, &page)
}

/// Measures the rows of a robot from a file and prints them.
fn run_own(options: Options, robot: &OwnRobot, json: bool) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let tools = setup::for_demo(options)?;
    let bins = match robot.joints {
        ..=FORWARD_JOINTS => &OWN_BINS[..],
        _ => &OWN_BINS[..1],
    };
    let building = Spinner::start(&format!("building {} ({RELEASE})", bins.join(", ")));
    let elves = firmware::build_own(
        &workspace,
        tools.toolchain,
        &robot.included()?,
        firmware::OWN_ROBOTS,
        bins,
    )?;
    drop(building);
    let mut rows = rows::run_all(&workspace, &tools, bins, &elves)?.0;
    rows.iter_mut().for_each(|row| row.robot.clone_from(&robot.name));
    if bins.len() < OWN_BINS.len() {
        let why = "M, forward dynamics and Jacobians are not measured: the firmware's RAM";
        output::note(&format!("{why} has room for {FORWARD_JOINTS} joints"));
    }
    docs::show(json, &rows, &report::of_robot(&rows))
}

/// Measures every row and says what they may be.
fn measure(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let rows = rows::measure(workspace, tools, RELEASE, &BINS)?;
    report(workspace, tools, rows, budgets::bars(workspace)?)
}

/// Measures the rows of the first robot alone, with what is promised of them.
fn measure_first(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let mut bars = budgets::bars(workspace)?;
    let rows = rows::measure(workspace, tools, RELEASE, &[BINS[0], BINS[1], "costs_laws"])?;
    bars.retain(|key, _| rows.iter().any(|row| key.contains(&*row.robot)));
    report(workspace, tools, rows, bars)
}

fn report(workspace: &Workspace, tools: &Tools, rows: Vec<Row>, bars: Bars) -> Result<Report> {
    let mut small = rows::measure(workspace, tools, SMALL, &BINS[..1])?;
    small.retain(|row| row.form == "engine");
    Ok(Report { rows, small, bars, rustc: tools.toolchain.rustc_version()? })
}

/// Fails unless the page says what every row costs today and every bar holds. A full run measures
/// all robots and compares the whole page, an everyday run the rows of the first robot.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let report = match bench.full {
        true => measure(workspace, tools)?,
        false => measure_first(workspace, tools)?,
    };
    let page = workspace::read(&workspace.root.join(PAGE))?;
    record::hold(&page, &report, bench.full)
}
