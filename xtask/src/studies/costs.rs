//! `cargo xtask costs`: what each algorithm costs on each robot, and what those of a user may.

mod page;
pub mod record;

use std::process::ExitCode;

use crate::kit::error::{Result, refuse_if};
use crate::kit::own_robot::{self, OwnRobot};
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::setup::{self, Options, Tools};
use crate::kit::toolchain::RELEASE;
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, firmware, output};
use crate::studies::budgets;
use crate::studies::study::Bench;
use record::{Record, hold};

/// The rows that users meet, in one image, whose link-time optimisation takes the compiler longest:
/// the UR5e's algorithms and laws, the SO-101's compensation, and two trees of joints of all kinds.
const EVERYDAY: &str = "costs_everyday";
/// Their number.
const ROWS: usize = 72;
/// The others: two bins for each robot, inverse dynamics and the rest. The compiler builds them
/// side by side.
const BINS: [&str; 13] = [
    EVERYDAY,
    "costs_ur5e",
    "costs_panda",
    "forward_panda",
    "costs_iiwa14",
    "forward_iiwa14",
    "costs_a1",
    "forward_a1",
    "costs_puma560",
    "costs_clusters",
    "costs_loops",
    "costs_flexible",
    "costs_free_drive",
];

/// The page, which its command writes from the record.
pub const PAGE: docs::Page<'_> =
    docs::Page { file: "docs/costs.md", name: "costs", command: "cargo xtask costs" };
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

/// Measures, writes record and page, and prints.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    if let Some(robot) = args.own.robot(&Workspace::find()?, OWN_JOINTS)? {
        return run_own(options, &robot, args.json);
    }
    let workspace = Workspace::for_reports()?;
    let tools = setup::for_demo(options)?;
    let rows = rows::measure(&workspace, &tools, RELEASE, &BINS)?;
    let record = Record::new(&rows, tools.toolchain.rustc_version()?);
    workspace::write(&workspace.report(record::FILE), record.json()?)?;
    let text = page::markdown(&record);
    PAGE.write(&workspace, &text)?;
    docs::show(args.json, &rows, &text)
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
    docs::show(json, &rows, &page::of_robot(&rows))
}

/// Fails unless the rows that users meet cost what is recorded, and keep their bars.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let rows = measured(workspace, tools)?;
    hold(&Record::read(workspace)?, &rows, &budgets::bars(workspace)?)?;
    Ok(format!("{ROWS} rows"))
}

fn measured(workspace: &Workspace, tools: &Tools) -> Result<Vec<Row>> {
    let rows = rows::measure(workspace, tools, RELEASE, &[EVERYDAY])?;
    refuse_if!(rows.len() != ROWS, "`{EVERYDAY}` measured {} rows, not {ROWS}", rows.len());
    Ok(rows)
}
