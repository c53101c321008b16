//! `cargo xtask costs`: what each algorithm costs on each robot, and what it may.

mod measure;
mod report;

use std::process::ExitCode;

use crate::bars::Bars;
use crate::budgets;
use crate::docs;
use crate::error::Result;
use crate::output;
use crate::own_robot::{self, OwnRobot};
use crate::progress::Spinner;
use crate::setup::{self, Options, Tools};
use crate::table;
use crate::toolchain::{RELEASE, SMALL};
use crate::workspace::{self, Workspace};

use measure::BINS;
pub use measure::{
    Row, code_bytes, measure as measure_bins, run as run_bin, run_all, run_for_time,
};
pub use report::{ADDED, IMAGE, Report, TICK};

/// The generated page.
const PAGE: &str = "docs/costs.md";
const COMMAND: &str = "cargo xtask costs";
/// The bins that measure the robot of a file: inverse dynamics, and the rest.
const OWN_BINS: [&str; 2] = ["own_costs", "own_forward"];
/// More joints than this do not fit into RAM.
const OWN_JOINTS: u64 = 40;
/// The joints for which the rest fits into RAM: it holds M at 32 states.
const FORWARD_JOINTS: u64 = 20;

/// What to do with the measurements.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    own: own_robot::Args,
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    pub json: bool,
    /// Rewrite the budgets from this run
    #[arg(long, conflicts_with = "file")]
    pub write_budgets: bool,
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
    workspace::write(&workspace.report(PAGE), &page)?;
    if args.write_budgets {
        budgets::write_costs(&workspace, &report)?;
    }
    table::show(args.json, &report.rows, &page)
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
    let elves = own_robot::build(
        &workspace,
        &tools,
        &robot.included()?,
        own_robot::FEATURE,
        bins,
    )?;
    drop(building);
    let mut rows = run_all(&workspace, &tools, bins, &elves)?.0;
    rows.iter_mut()
        .for_each(|row| row.robot.clone_from(&robot.name));
    if bins.len() < OWN_BINS.len() {
        let why = "M, forward dynamics and Jacobians are not measured: the firmware's RAM";
        output::note(&format!("{why} has room for {FORWARD_JOINTS} joints"));
    }
    table::show(json, &rows, &report::of_robot(&rows))
}

/// Measures every row and says what they may be.
pub fn measure(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let rows = measure_bins(workspace, tools, RELEASE, &BINS)?;
    report(workspace, tools, rows, budgets::bars(workspace)?)
}

/// Measures the rows of the first robot alone, with what is promised of them.
pub fn measure_first(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let mut bars = budgets::bars(workspace)?;
    let rows = measure_bins(workspace, tools, RELEASE, &[BINS[0], BINS[1], "costs_laws"])?;
    bars.retain(|key, _| rows.iter().any(|row| key.contains(&*row.robot)));
    report(workspace, tools, rows, bars)
}

fn report(workspace: &Workspace, tools: &Tools, rows: Vec<Row>, bars: Bars) -> Result<Report> {
    let mut small = measure_bins(workspace, tools, SMALL, &BINS[..1])?;
    small.retain(|row| row.form == "engine");
    Ok(Report {
        rows,
        small,
        bars,
        rustc: tools.toolchain.rustc_version()?,
    })
}

/// Fails unless the page is that of the report, or close to it if another compiler wrote it.
pub fn check_page(workspace: &Workspace, report: &Report) -> Result<()> {
    let written = workspace::read(&workspace.root.join(PAGE))?;
    docs::compare(PAGE, COMMAND, &written, &report.markdown(), &report.rustc)
}
