//! `cargo xtask costs`: what each algorithm costs on each robot, and what it may.

mod measure;
mod report;

use std::process::ExitCode;

use crate::bars::Bars;
use crate::budgets;
use crate::docs;
use crate::error::Result;
use crate::setup::{self, Options, Tools};
use crate::table;
use crate::toolchain::{RELEASE, SMALL};
use crate::workspace::{self, Workspace};

use measure::BINS;
pub use measure::{
    Row, code_bytes, measure as measure_bins, run as run_bin, run_all, run_for_time,
};
pub use report::{ADDED, Report, TICK};

/// The generated page.
const PAGE: &str = "docs/costs.md";
const COMMAND: &str = "cargo xtask costs";

/// What to do with the measurements.
#[derive(Clone, Copy, clap::Args)]
pub struct Args {
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    pub json: bool,
    /// Rewrite the budgets from this run
    #[arg(long)]
    pub write_budgets: bool,
}

/// Measures, writes the page and prints it.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
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

/// Measures every row and says what they may be.
pub fn measure(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let rows = measure_bins(workspace, tools, RELEASE, &BINS)?;
    report(workspace, tools, rows, budgets::bars(workspace)?)
}

/// Measures the rows of the first robot alone, with what is promised of them.
pub fn measure_first(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let mut bars = budgets::bars(workspace)?;
    let rows = measure_bins(workspace, tools, RELEASE, &BINS[..2])?;
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
