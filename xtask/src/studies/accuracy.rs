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
use crate::studies::scenes::first_screen;
use crate::studies::study::Bench;

pub use choice::{Allowed, Budget};
use measure::{Measured, Plan};
use point::{Kind, Point, of_group};
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
    /// Measure single changes anew and rewrite the rest of the page by its record
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
            quick: by_record,
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

/// Fails unless what single changes cost and lose is what the page says; else says how many there
/// are.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let plan = Plan { robots: Robot::COMPUTED.to_vec(), quick: true, kind: Some(Kind::Inverse) };
    let measured = plan.run(workspace, tools)?;
    let (single, host, rustc) = (&measured.single, &measured.host, &measured.rustc);
    let generated = printed::check(&measured.generated, &measured.single)?;
    page::SINGLES.check(workspace, &page::singles(single, rustc), Some(rustc))?;
    let brief = page::brief(single, measured.shares, rustc);
    page::README.check(workspace, &brief, Some(rustc))?;
    let recorded = recorded::read(workspace)?;
    recorded::check(&recorded, single)?;
    let proven = proven::check(&recorded)?;
    // Parts and pictures of a whole run, by its record, and by the compiler that they name.
    page::NAMES.check(workspace, &names::glossary(), None)?;
    let text = workspace::read(&workspace.root.join(page::FILE))?;
    let mut pictures = 0;
    for robot in Robot::ALL {
        let part = page::page_of(robot);
        let rustc = docs::rustc_of(part.written(&text)?).unwrap_or_default();
        part.check(workspace, &page::text(&recorded, host, robot, rustc), None)?;
        for (file, svg) in plot::pictures(&recorded, host, robot)? {
            docs::compare_picture(workspace, &file, page::COMMAND, &svg, true)?;
            pictures += 1;
        }
    }
    // The leg's bars are missed: docs/decisions/0002-bars.md.
    let saved = [Robot::Ur5e, Robot::Panda]
        .map(|robot| page::check_bars(&of_group(&recorded, (robot.name(), Kind::Inverse, ""))))
        .into_iter()
        .collect::<Result<Vec<String>>>()?
        .join("; ");
    Ok(format!(
        "{} configurations, {generated} of them as printed; {proven} with a proven error; {pictures} pictures as recorded; {saved}",
        single.len()
    ))
}

/// Rewrites the page's parts that this run has all of, and their pictures; all of them or none.
/// Recorded parts keep the name of their compiler.
fn write(
    workspace: &Workspace,
    measured: &Measured,
    only: Option<Robot>,
    is_recorded: bool,
) -> Result<()> {
    let (points, host, rustc) = (&measured.points, &measured.host, &measured.rustc);
    let mut text = workspace::read(&workspace.root.join(page::FILE))?;
    let mut files: Vec<(PathBuf, String)> = vec![recorded::replaced(workspace, points)?];
    let is_whole = |robot: &Robot| only.is_none_or(|only| only == *robot);
    for robot in Robot::ALL.into_iter().filter(is_whole) {
        let pictures = plot::pictures(points, host, robot)?.into_iter();
        files.extend(pictures.map(|(file, svg)| (workspace.report(&file), svg)));
        let part = page::page_of(robot);
        let by = docs::rustc_of(part.written(&text)?).filter(|_| is_recorded);
        let fresh = page::text(points, host, robot, by.unwrap_or(rustc));
        text = part.replaced(&text, &fresh)?;
    }
    if only.is_none() {
        let single = &measured.single;
        text = page::SINGLES.replaced(&text, &page::singles(single, rustc))?;
        text = page::NAMES.replaced(&text, &names::glossary())?;
        let readme = workspace::read(&workspace.root.join(page::README.file))?;
        let brief = page::brief(single, measured.shares, rustc);
        let readme = page::README.replaced(&readme, &brief)?;
        files.push((workspace.report(page::README.file), readme));
    }
    files.push((workspace.report(page::FILE), text));
    workspace::write_whole(&files)?;
    first_screen::write_why(workspace)
}
