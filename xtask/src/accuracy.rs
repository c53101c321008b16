//! `cargo xtask accuracy`: what accuracy costs in time, for every way to compute that the library offers.

mod choice;
mod code;
mod front;
mod join;
mod measure;
mod page;
mod plot;
mod point;
mod printed;
mod recorded;
mod words;

use std::path::PathBuf;
use std::process::ExitCode;

use crate::docs;
use crate::error::{Error, Result};
use crate::output;
use crate::setup::{self, Options, Tools};
use crate::workspace::{self, Workspace};

pub use choice::{Allowed, Budget};
pub use measure::Robot;
use measure::{Measured, Plan};
use point::{Kind, Point, of_group};

/// What is wanted.
#[derive(clap::Args)]
pub struct Wish {
    /// Only this robot
    #[arg(long, value_enum, value_name = "NAME", ignore_case = true)]
    robot: Option<Robot>,
    /// A dozen configurations of each robot, at opt-level 3
    #[arg(long)]
    quick: bool,
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
    /// Choose the cheapest configuration off by no more than this: 0.05Nm, 2mrad
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    #[arg(requires = "robot", conflicts_with = "cycles")]
    error: Option<Allowed>,
    /// Choose the most accurate configuration whose worst tick takes no more cycles than this
    #[arg(long, value_name = "CYCLES", requires = "robot")]
    cycles: Option<u64>,
    /// Choose from what is measured now, not from docs/accuracy.json
    #[arg(long)]
    measure: bool,
}

/// Measures, writes page and pictures, and prints; or chooses.
pub fn run(options: Options, wish: Wish) -> Result<ExitCode> {
    let kind = wish.kind()?;
    let workspace = Workspace::find()?;
    if let (Some(budget), Some(kind), false) = (wish.budget(), kind, wish.measure | wish.quick) {
        return wish.choose(&recorded::read(&workspace)?, budget, kind);
    }
    let workspace = match wish.budget() {
        None if !wish.quick => Workspace::for_reports()?,
        _ => workspace,
    };
    let tools = setup::for_demo(options)?;
    let plan = Plan {
        robots: wish
            .robot
            .map_or_else(|| Robot::ALL.to_vec(), |robot| vec![robot]),
        quick: wish.quick,
        inverse: kind != Some(Kind::Simulation),
        simulation: kind != Some(Kind::Inverse),
    };
    let measured = plan.run(&workspace, &tools)?;
    let all = if wish.quick {
        &measured.single
    } else {
        &measured.points
    };
    if let (Some(budget), Some(kind)) = (wish.budget(), kind) {
        return wish.choose(all, budget, kind);
    }
    if !wish.quick {
        write(&workspace, &measured, wish.robot)?;
    }
    if wish.json {
        docs::print_json(all)?;
    } else {
        output::print(&page::terminal(all))?;
    }
    Ok(ExitCode::SUCCESS)
}

impl Wish {
    /// What a configuration is chosen by, if one is.
    fn budget(&self) -> Option<Budget> {
        let error = self.error.map(Budget::Error);
        error.or(self.cycles.map(Budget::Cycles))
    }

    /// Chooses from these, and prints.
    fn choose(&self, all: &[Point], budget: Budget, kind: Kind) -> Result<ExitCode> {
        let circumstances = match kind {
            Kind::Inverse => "rigid",
            Kind::Simulation => "free",
        };
        let robot = self.robot.unwrap_or(Robot::Ur5e).name();
        let points = choice::shipped(all, (robot, kind, circumstances));
        let points: Vec<&Point> = points.iter().collect();
        if self.json {
            docs::print_json(&budget.choose(&points)?)?;
            return Ok(ExitCode::SUCCESS);
        }
        output::print(&budget.answer(&points)?)?;
        if !(self.measure | self.quick) {
            let file = recorded::FILE;
            output::note(&format!(
                "\nFrom {file}; --measure takes its figures on this machine, in minutes."
            ));
        }
        Ok(ExitCode::SUCCESS)
    }

    /// What a budget chooses from, if there is one.
    fn kind(&self) -> Result<Option<Kind>> {
        let Some(budget) = self.budget() else {
            return Ok(None);
        };
        let robot = self.robot.unwrap_or(Robot::Ur5e);
        let kind = match budget {
            Budget::Cycles(_) if robot == Robot::DoublePendulum => Kind::Simulation,
            _ => budget.kind(),
        };
        let (among, what, other) = match kind {
            Kind::Inverse => (
                &Robot::COMPUTED[..],
                "torques are computed",
                "its simulation is in rad",
            ),
            Kind::Simulation => (
                &Robot::SIMULATED[..],
                "there are simulations, without --quick,",
                "torques is in Nm",
            ),
        };
        if among.contains(&robot) && !(self.quick && kind == Kind::Simulation) {
            return Ok(Some(kind));
        }
        let names: Vec<&str> = among.iter().map(|robot| robot.name()).collect();
        Err(Error::check(format!(
            "not for {}: {what} for {}; an error of {other}",
            robot.name(),
            names.join(", ")
        )))
    }
}

/// Fails unless what single changes cost and lose is what the page says; else says how many there are.
pub fn check(workspace: &Workspace, tools: &Tools) -> Result<String> {
    let plan = Plan {
        robots: Robot::COMPUTED.to_vec(),
        quick: true,
        inverse: true,
        simulation: false,
    };
    let measured = plan.run(workspace, tools)?;
    let Measured {
        single,
        host,
        rustc,
        ..
    } = &measured;
    let pasted = printed::check(&measured)?;
    page::SINGLES.check(workspace, &page::singles(single, rustc), Some(rustc))?;
    page::README.check(workspace, &page::brief(single, rustc), Some(rustc))?;
    let recorded = recorded::read(workspace)?;
    recorded::check(&recorded, single)?;
    // Parts and pictures of a whole run, by its record, and by the compiler that they name.
    let text = workspace::read(&workspace.root.join(page::FILE))?;
    let mut pictures = 0;
    for robot in Robot::ALL {
        let part = page::page_of(robot);
        let written = part.written(&text)?;
        let rustc = docs::rustc_of(written).unwrap_or_default();
        let now = part.generated(&page::text(&recorded, host, robot, rustc));
        docs::compare(page::FILE, page::COMMAND, written, &now, "")?;
        for (file, svg) in page::pictures(&recorded, host, robot)? {
            docs::compare_picture(workspace, &file, page::COMMAND, &svg, true)?;
            pictures += 1;
        }
    }
    // The leg's bars are missed: docs/decisions/0002-bars.md.
    let saved = [Robot::Ur5e, Robot::Panda]
        .map(|robot| page::check_bars(&of_group(&recorded, (robot.name(), Kind::Inverse, "rigid"))))
        .into_iter()
        .collect::<Result<Vec<String>>>()?
        .join("; ");
    Ok(format!(
        "{} configurations, {pasted} of them as printed; {pictures} pictures as recorded; {saved}",
        single.len()
    ))
}

/// Rewrites the page's parts that this run has all of, and their pictures; all of them or none.
fn write(workspace: &Workspace, measured: &Measured, only: Option<Robot>) -> Result<()> {
    let Measured {
        points,
        single,
        host,
        rustc,
        ..
    } = measured;
    let mut text = workspace::read(&workspace.root.join(page::FILE))?;
    let mut files: Vec<(PathBuf, String)> = vec![recorded::replaced(workspace, points)?];
    for robot in Robot::ALL {
        let whole = match robot {
            Robot::DoublePendulum => only.is_none(),
            _ => only.is_none_or(|only| only == robot),
        };
        if whole {
            let pictures = page::pictures(points, host, robot)?.into_iter();
            files.extend(pictures.map(|(file, svg)| (workspace.report(&file), svg)));
            text = page::page_of(robot).replaced(&text, &page::text(points, host, robot, rustc))?;
        }
    }
    if only.is_none() {
        text = page::SINGLES.replaced(&text, &page::singles(single, rustc))?;
        let readme = workspace::read(&workspace.root.join(page::README.file))?;
        let readme = page::README.replaced(&readme, &page::brief(single, rustc))?;
        files.push((workspace.report(page::README.file), readme));
    }
    files.push((workspace.report(page::FILE), text));
    workspace::write_whole(&files)
}
