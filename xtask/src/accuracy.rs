//! `cargo xtask accuracy`: what accuracy costs in time, for every way to compute that the library offers.

mod front;
mod join;
mod labels;
mod measure;
mod page;
mod picture;
mod point;
mod progress;
mod words;

use std::process::ExitCode;

use crate::docs;
use crate::error::Result;
use crate::setup::{self, Options};
use crate::table::Table;
use crate::workspace::Workspace;

pub use measure::Robot;
use measure::{Measured, Plan};

/// What is wanted.
pub struct Wish {
    /// One robot only.
    pub robot: Option<Robot>,
    /// A dozen ways of each.
    pub quick: bool,
    /// JSON on stdout.
    pub json: bool,
}

/// Measures, writes page and pictures, and prints.
pub fn run(options: Options, wish: Wish) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let tools = setup::for_demo(options)?;
    let every = [
        Robot::Ur5e,
        Robot::Panda,
        Robot::A1Leg,
        Robot::DoublePendulum,
    ];
    let plan = Plan {
        robots: wish
            .robot
            .map_or_else(|| every.to_vec(), |robot| vec![robot]),
        quick: wish.quick,
        inverse: true,
        simulation: true,
    };
    let measured = plan.run(&workspace, &tools)?;
    if wish.json {
        docs::print_json(&measured.points)?;
    } else {
        print!("{}", table(&measured).text());
    }
    Ok(ExitCode::SUCCESS)
}

fn table(measured: &Measured) -> Table {
    let mut table = Table::new(&[
        "configuration",
        "insn",
        "cycles",
        "mean",
        "error",
        "of full scale",
        "front",
    ]);
    for point in &measured.points {
        let error = |x: Option<f64>| x.map_or_else(|| "–".into(), words::digits);
        table.row([
            format!("{} {} {}", point.robot, words::name(point), point.group().2),
            point.instructions.to_string(),
            point.cycles.to_string(),
            words::cycles(point.cycles_mean),
            error(point.error_max),
            error(point.relative_max),
            format!("{:?}", point.fronts),
        ]);
    }
    table
}
