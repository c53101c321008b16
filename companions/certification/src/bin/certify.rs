//! Proves the rounding errors of a robot's functions, and prints or records them.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use certification::certificate::{self, Certificate, Function, Spent};
use certification::check::{self, Part};
use certification::configurations::{self, Configurations, PATHS};
use certification::error::{Error, Result};
use certification::image::Image;
use certification::narrow::{Narrow, magnitude};
use certification::program::{self, CLUSTERED, LIBRARY, Program};
use certification::search::Effort;
use certification::state_box::Robot;
use certification::target::Target;
use certification::{emulation, page, sines};
use clap::Parser;

/// Proven rounding errors of a robot's functions over the whole box of its joints
#[derive(Parser)]
#[command(name = "certify")]
struct Args {
    /// A robot of certificates.md, or a URDF or MJCF file; all of that page if not given
    #[arg(long, value_name = "NAME|FILE")]
    robot: Option<String>,
    /// The functions whose errors are bounded
    #[arg(long, value_enum, value_delimiter = ',', default_value = "rnea,gravity")]
    function: Vec<Function>,
    /// The greatest acceleration of each joint, rad/s² or m/s²
    #[arg(long, value_name = "A", default_value = "10", value_parser = magnitude, allow_hyphen_values = true)]
    acceleration: f64,
    /// The greatest speed of joints whose description has none, rad/s or m/s
    #[arg(long, value_name = "V", value_parser = magnitude, allow_hyphen_values = true)]
    speed: Option<f64>,
    /// The greatest |q| of joints that slide and whose description has no limits, m
    #[arg(long, value_name = "Q", value_parser = magnitude, allow_hyphen_values = true)]
    range: Option<f64>,
    /// A narrower range of a joint's position, JOINT:LOW..HIGH, speed, JOINT:v:MOST, or
    /// acceleration, JOINT:a:MOST, in rad or m and s; joints count from 1, and --box
    /// 2:-1.5..1.5,2:v:0.5 has two
    #[arg(long = "box", value_name = "RANGE", value_delimiter = ',', requires = "robot")]
    narrow: Vec<Narrow>,
    /// Into how many parts the box of each result is split: more time, tighter bounds
    #[arg(long, value_name = "N", default_value_t = 4000)]
    parts: usize,
    /// Points of the grid of angles that bounds each result a second time; 1,000,000 if not given,
    /// 5,000,000 for the page
    #[arg(long, value_name = "N")]
    points: Option<usize>,
    /// States of the search for the worst error, for each result
    #[arg(long, value_name = "N", default_value_t = 240_000)]
    states: usize,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    /// Only prove the errors of the configurations of `cargo xtask accuracy`, and print them as
    /// JSON; of the robots of docs/accuracy.md, over boxes that their paths lie in, if no robot is
    /// given
    #[arg(long, conflicts_with_all = ["write", "hashes"])]
    configurations: bool,
    /// Rewrite certificates.md, or parts of it, or docs/accuracy-proven.json
    #[arg(long, value_enum, value_name = "PART", value_delimiter = ',', conflicts_with_all = ["robot", "json"])]
    write: Vec<Part>,
    /// Only compare the hashes of certificates.md and of docs/accuracy-proven.json with today's
    /// machine code, and the page's numbers with their sums and each other
    #[arg(long, conflicts_with_all = ["robot", "write"])]
    hashes: bool,
    #[command(flatten)]
    options: robot_import::import::Options,
}

/// The default of [`Args::points`].
const POINTS: usize = 1_000_000;
const PAGE_POINTS: usize = 5_000_000;
/// Points of each grid and parts of each box of `--configurations`, which proves a hundred of them.
const CONFIGURED_POINTS: usize = 300_000;
const CONFIGURED_PARTS: usize = 300;
/// Points on which the Fourier coefficients of the difference of two models are evaluated.
const CONFIGURED_FINE: usize = 4_000_000;
/// Points of the grids of a robot with a loop, over all parts of the coordinates that it depends on
/// by quotients and roots.
const LOOP_POINTS: usize = 100_000;
/// The page, and the record of the configurations.
const PAGE: &str = "certificates.md";
const CONFIGURED: &str = "../../docs/accuracy-proven.json";

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(text) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {}", robot_import::text::visible(&error.to_string()));
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<String> {
    if args.configurations {
        return proven_configurations(args);
    }
    if args.write == [Part::Configurations] {
        program::write(&kept(CONFIGURED), &proven_configurations(args)?)?;
        return Ok(format!("written: {CONFIGURED}"));
    }
    let robots: Vec<&str> = match &args.robot {
        Some(robot) => vec![robot],
        None => {
            let library = LIBRARY.map(|(name, _)| name);
            library.into_iter().chain([CLUSTERED]).collect()
        }
    };
    let programs = robots.into_iter().map(|robot| {
        let program = program::build(robot, &args.options)?;
        let robot = boxed(args, &program, args.acceleration)?;
        Ok((program, robot))
    });
    let programs: Vec<(Program, Robot)> = programs.collect::<Result<_>>()?;
    if args.hashes {
        return hashes(args, &programs);
    }
    // Once for all robots: what holds over the widest ranges holds over each.
    let joints = programs.iter().flat_map(|(_, robot)| &robot.joints);
    let sines = sines::enumerate(&joints.copied().collect::<Vec<_>>());
    let mut certificates = Vec::new();
    for (program, robot) in &programs {
        let mut functions = program.functions(&args.function);
        functions.retain(|one| args.write.is_empty() || args.write.contains(&part(*one)));
        if functions.is_empty() {
            continue;
        }
        let image = Image::read(&program.elf)?;
        let emulation = emulation::run(program, robot).map_err(|error| error.to_string());
        for function in functions {
            let start = Instant::now();
            let target = Target::of(&image, function, robot, &emulation)?;
            let spent = spent(args, function);
            let mut one = certificate::certify(program, function, robot, sines, spent)?;
            one.target = Some(target);
            let (name, seconds) = (function.name(), start.elapsed().as_secs_f64());
            eprintln!("{}: {name}: {seconds:.0} s", one.robot);
            certificates.push(one);
        }
    }
    let of = |part_of: Part| {
        let mine = certificates.iter();
        let mine = mine.filter(|one| part(one.function) == part_of).cloned();
        mine.collect::<Vec<Certificate>>()
    };
    for part in &args.write {
        if *part == Part::Configurations {
            program::write(&kept(CONFIGURED), &proven_configurations(args)?)?;
            continue;
        }
        let page = check::page(&read(PAGE)?, *part, &page::tables(&of(*part)))?;
        program::write(&kept(PAGE), &page)?;
    }
    match (args.write.is_empty(), args.json) {
        (false, _) => Ok(format!("written: {:?}", args.write)),
        (_, true) => json(&certificates),
        _ => Ok(page::sheet(&certificates)),
    }
}

/// A file of the companion.
fn kept(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn read(name: &str) -> Result<String> {
    let path = kept(name);
    std::fs::read_to_string(&path).map_err(|source| Error::File { path, source })
}

/// The box of a program's robot.
fn boxed(args: &Args, program: &Program, acceleration: f64) -> Result<Robot> {
    let image = Image::read(&program.elf)?;
    let mut robot = Robot::read(&image, acceleration, args.speed, args.range)?;
    for range in &args.narrow {
        range.apply(&mut robot)?;
    }
    Ok(robot)
}

/// The programs of configurations, each with its robot's box.
fn configured(args: &Args) -> Result<Vec<(Program, Robot)>> {
    let chosen = args.robot.as_deref().map(|name| (name, args.acceleration));
    let robots = chosen.map_or(PATHS.to_vec(), |chosen| vec![chosen]);
    let each = robots.into_iter().map(|(name, acceleration)| {
        let program = program::configured(name, &args.options)?;
        let robot = boxed(args, &program, acceleration)?;
        Ok((program, robot))
    });
    each.collect()
}

fn proven_configurations(args: &Args) -> Result<String> {
    let spent = configurations::Spent {
        points: args.points.unwrap_or(CONFIGURED_POINTS),
        fine: CONFIGURED_FINE,
        parts: args.parts.min(CONFIGURED_PARTS),
    };
    let prove = |(program, robot)| configurations::prove(&program, &robot, spent);
    let all = configured(args)?.into_iter().map(prove);
    json(&all.collect::<Result<Vec<_>>>()?)
}

fn json(of: &impl serde::Serialize) -> Result<String> {
    serde_json::to_string_pretty(of).map_err(|e| Error::Robot(e.to_string()))
}

/// Fails unless page and record are of today's machine code.
fn hashes(args: &Args, programs: &[(Program, Robot)]) -> Result<String> {
    let page = read(PAGE)?;
    check::numbers(&page)?;
    for (program, _) in programs {
        let image = Image::read(&program.elf)?;
        let functions = program.functions(&args.function);
        check::hashes(&image, &functions, &program.robot, &page)?;
    }
    let recorded: Vec<Configurations> =
        serde_json::from_str(&read(CONFIGURED)?).unwrap_or_default();
    for (program, robot) in configured(args)? {
        let today = configurations::hashes(&Image::read(&program.elf)?, &robot)?;
        configurations::check(&recorded, &program.robot, &today)?;
    }
    Ok(format!("{PAGE} and {CONFIGURED} are of today's machine code"))
}

/// The part of the page that has a function's certificates.
fn part(function: Function) -> Part {
    match function {
        Function::Clustered => Part::Clusters,
        _ => Part::Certificates,
    }
}

fn spent(args: &Args, function: Function) -> Spent {
    // The loop has three results, each of which needs a million states.
    let states = match function {
        Function::Clustered => 2 * args.states,
        _ => args.states,
    };
    // A third of the states at random, the rest in generations.
    let children = states / 3 * 2 / 96;
    Spent {
        parts: args.parts,
        points: args.points.unwrap_or(match function {
            Function::Clustered => LOOP_POINTS,
            _ if !args.write.is_empty() => PAGE_POINTS,
            _ => POINTS,
        }),
        search: Effort { random: states / 3, generations: 96, children },
    }
}
