//! `cargo xtask costs`: what each algorithm costs on each robot, and what it may.

mod bars;
mod budget;
mod measure;
mod report;

use std::process::ExitCode;

use crate::budgets;
use crate::docs;
use crate::error::Result;
use crate::output;
use crate::setup::{self, Options, Tools};
use crate::workspace::{self, Workspace};

pub use bars::{ADDED, Bars, TICK};
pub use budget::Budget;
pub use measure::{Row, measure as measure_bins, run as run_bin, run_for_time};
pub use report::Report;

/// The generated page.
const PAGE: &str = "docs/costs.md";
const COMMAND: &str = "cargo xtask costs";

/// What to do with the measurements.
#[derive(Clone, Copy, clap::Args)]
pub struct Wish {
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    pub json: bool,
    /// Rewrite the budgets from this run
    #[arg(long)]
    pub write_budgets: bool,
}

/// Measures, writes the page and prints it.
pub fn run(options: Options, wish: Wish) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let tools = setup::for_demo(options)?;
    let report = measure(&workspace, &tools)?;
    workspace::write(&workspace.report(PAGE), report.markdown())?;
    if wish.write_budgets {
        budgets::write_costs(&workspace, Budget::measured(&report))?;
    }
    if wish.json {
        docs::print_json(&report.rows)?;
    } else {
        output::print(&report.text())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Measures every row and says what they may be.
pub fn measure(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let (bars, ratios) = budgets::bars(workspace)?;
    Ok(Report {
        rows: measure::all(workspace, tools)?,
        small: measure::small(workspace, tools)?,
        bars,
        ratios,
        rustc: tools.toolchain.rustc_version()?,
    })
}

/// Measures the rows of the first robot alone, with what is promised of them.
pub fn measure_first(workspace: &Workspace, tools: &Tools) -> Result<Report> {
    let (mut bars, ratios) = budgets::bars(workspace)?;
    let rows = measure::first(workspace, tools)?;
    bars.retain(|key, _| rows.iter().any(|row| key.starts_with(&*row.robot)));
    Ok(Report {
        rows,
        small: measure::small(workspace, tools)?,
        bars,
        ratios,
        rustc: tools.toolchain.rustc_version()?,
    })
}

/// Fails unless the page is that of the report, or close to it if another compiler wrote it.
pub fn check_page(workspace: &Workspace, report: &Report) -> Result<()> {
    let path = workspace.root.join(PAGE);
    let written = if path.exists() {
        workspace::read(&path)?
    } else {
        String::new()
    };
    docs::compare(PAGE, COMMAND, &written, &report.markdown(), &report.rustc)
}
