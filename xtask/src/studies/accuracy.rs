//! `cargo xtask accuracy`: what accuracy costs in time, for every way to compute that the library
//! offers.

mod choice;
mod code;
mod front;
mod join;
mod measure;
pub mod names;
mod own;
mod page;
mod plot;
mod point;
mod printed;
mod proven;
mod recorded;
mod robot;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ArgGroup;

use crate::kit::error::{Result, bail};
use crate::kit::setup::{self, Options};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{docs, output, own_robot};
use crate::studies::study::Bench;

pub use choice::{Allowed, Budget};
use measure::{Measured, Plan};
use point::{Kind, Point};
pub use robot::Robot;

#[derive(clap::Args)]
#[command(group = ArgGroup::new("chosen").args(["robot", "file"]))]
pub struct Args {
    /// Only this robot
    #[arg(long, value_enum, value_name = "NAME", ignore_case = true, conflicts_with = "file")]
    robot: Option<Robot>,
    #[command(flatten)]
    own: own_robot::Args,
    /// The measurements as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
    /// Choose the cheapest configuration off by no more than this: 0.05Nm, 2mrad
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    #[arg(requires = "chosen", conflicts_with = "cycles")]
    error: Option<Allowed>,
    /// Choose the cheapest configuration that is proven to be off by no more than this in any state
    /// of the joints' box: 0.01Nm
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    #[arg(requires = "chosen", conflicts_with_all = ["cycles", "error"])]
    proven_error: Option<Allowed>,
    /// The proven errors, as docs/accuracy-proven.json has them, which is read if no file is given
    #[arg(long, value_name = "JSON", requires = "proven_error")]
    proven: Option<PathBuf>,
    /// Rewrite the page by its record, with nothing measured but the reference's own errors
    #[arg(long, conflicts_with_all = ["chosen", "measure", "json"])]
    recorded: bool,
    /// Choose the most accurate configuration whose worst tick takes no more cycles than this
    #[arg(long, value_name = "CYCLES", requires = "chosen")]
    cycles: Option<u64>,
    /// Choose from what is measured now, not from docs/accuracy.json
    #[arg(long)]
    measure: bool,
}

/// Measures, writes page and pictures, and prints; or chooses.
pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    if args.proven_error.is_some_and(|allowed| allowed.kind != Kind::Inverse) {
        bail!("only errors of torques are proven: --proven-error 0.01Nm");
    }
    let budget = match (args.error.or(args.proven_error), args.cycles) {
        (Some(error), _) => Some(Budget::Error(error)),
        (None, cycles) => cycles.map(Budget::Cycles),
    };
    if let Some(robot) = args.own.robot(&Workspace::find()?, own::MOST_JOINTS)? {
        let read = || proven::read(&Workspace::find()?, args.proven.as_deref());
        let proven = args.proven_error.map(|_| read()).transpose()?;
        return own::run(options, &robot, budget, proven, args.json);
    }
    let choice = budget.zip(args.robot);
    let workspace = match choice {
        None => Workspace::for_reports()?,
        Some(_) => Workspace::find()?,
    };
    let by_record = args.recorded;
    let mut points = recorded::read(&workspace)?;
    if let Some((budget, robot)) = choice
        && choice::shipped(&points, budget.group(robot)).is_empty()
    {
        let (file, robot) = (recorded::FILE, robot.name());
        bail!("{file} has nothing of {robot} that is off by such an error");
    }
    if choice.is_none() | args.measure {
        let plan = Plan {
            robots: args.robot.map_or(Robot::ALL.to_vec(), |robot| vec![robot]),
            recorded: by_record,
            kind: choice.map(|(budget, robot)| budget.group(robot).1),
        };
        let mut measured = plan.run(&workspace, &setup::for_demo(options)?)?;
        if by_record {
            measured.points = points;
        }
        if choice.is_none() {
            write(&workspace, &measured, args.robot, by_record)?;
        }
        points = measured.points;
    }
    let Some((budget, robot)) = choice else {
        match args.json {
            true => docs::print_json(&points)?,
            false => output::print(&page::terminal(&points))?,
        }
        return Ok(ExitCode::SUCCESS);
    };
    let mut points = choice::shipped(&points, budget.group(robot));
    if args.proven_error.is_some() {
        let proven = proven::read(&workspace, args.proven.as_deref())?;
        let (of_them, note) = proven::chosen(&proven, points)?;
        points = of_them;
        output::note(&note);
    }
    show(budget, &points, args.json)?;
    if !args.json && !args.measure {
        let file = recorded::FILE;
        output::note(&format!(
            "\nFrom {file}; --measure takes its figures on this machine, in minutes."
        ));
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints what a budget chooses.
fn show(budget: Budget, points: &[Point], json: bool) -> Result<()> {
    let points: Vec<&Point> = points.iter().collect();
    match json {
        true => docs::print_json(&budget.choose(&points)?),
        false => output::print(&budget.answer(&points)?),
    }
}

/// Fails unless the generated code costs and errs as the chooser promises it by the record, and no
/// recorded error is larger than it is proven to be; else says how many configurations these are.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let recorded = recorded::read(workspace)?;
    let proven = proven::check(&recorded)?;
    let generated = measure::printed(workspace, tools)?;
    let kept = printed::check(&generated, &recorded)?;
    Ok(format!("{kept} configurations as promised; {proven} with a proven error"))
}

/// Rewrites the parts of the page that this run has all of, and their pictures; all of them or
/// none. By the record alone, they keep the name of its compiler.
fn write(
    workspace: &Workspace,
    measured: &Measured,
    only: Option<Robot>,
    is_recorded: bool,
) -> Result<()> {
    let (points, host) = (&measured.points, &measured.host);
    let mut text = workspace::read(&workspace.root.join(page::FILE))?;
    let old = docs::rustc_of(&text).filter(|_| is_recorded).map(str::to_owned);
    let rustc = old.as_ref().unwrap_or(&measured.rustc);
    let mut files: Vec<(PathBuf, String)> = Vec::new();
    if !is_recorded {
        files.push(recorded::replaced(workspace, points)?);
    }
    for robot in Robot::ALL.into_iter().filter(|one| only.is_none_or(|only| only == *one)) {
        let pictures = plot::pictures(points, host, robot)?.into_iter();
        files.extend(pictures.map(|(file, svg)| (workspace.report(&file), svg)));
        let stamp = docs::today_and_commit(workspace);
        let part = page::text(points, host, robot, rustc);
        text = page::page_of(robot).replaced(&text, &format!("{part} Written on {stamp}.\n"))?;
    }
    files.push((workspace.report(page::FILE), text));
    workspace::write_whole(&files)
}
