//! The proven rounding errors of a robot's functions: what `cargo xtask certify` runs.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use certification::certificate::{self, Certificate, Function, Spent, Subject};
use certification::check::Part;
use certification::configurations::{Configurations, PATHS};
use certification::error::{Error, Result};
use certification::image::Image;
use certification::limits::{self, Limits};
use certification::narrow::{Narrow, magnitude};
use certification::program::{self, CLUSTERED, LIBRARY, Program};
use certification::search::Effort;
use certification::sheet::{Sheet, Target};
use certification::state_box::Robot;
use certification::{check, configurations, emulation, fpcore, inertias, page, picture, sines};
use clap::Parser;

/// Proven rounding errors of a robot's functions over the whole box of its joints
#[derive(Parser)]
#[command(name = "certify")]
struct Args {
    /// A robot of docs/certificates.md, or a URDF or MJCF file; all of that page if not given
    #[arg(long, value_name = "NAME|FILE")]
    robot: Option<String>,
    /// The functions
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        default_value = "rnea,gravity"
    )]
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
    #[arg(
        long = "box",
        value_name = "RANGE",
        value_delimiter = ',',
        requires = "robot"
    )]
    narrow: Vec<Narrow>,
    /// Also how far each torque can be off if each link's inertia is known within so many percent:
    /// all its parameters off by one factor
    #[arg(long, value_name = "PERCENT", requires = "robot")]
    inertias: Option<f64>,
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
    /// Write the picture to this file
    #[arg(long, value_name = "SVG")]
    picture: Option<PathBuf>,
    /// Let Gappa check a part of the box around the worst state of each result
    #[arg(long)]
    gappa: bool,
    /// Let Coq check Gappa's proofs of them too: minutes for each result
    #[arg(long, requires = "gappa")]
    coq: bool,
    /// Only write each result as a benchmark in the form of FPBench into this directory:
    /// FUNCTION_ROBOT.fpcore
    #[arg(long, value_name = "DIR", conflicts_with_all = ["json", "gappa", "sampled", "write_docs", "hashes"])]
    fpcore: Option<PathBuf>,
    /// Only prove the errors of the configurations of `cargo xtask accuracy`, and print them as
    /// JSON; of the robots of docs/accuracy.md, over boxes that their paths lie in, if no robot is
    /// given
    #[arg(long, conflicts_with_all = ["fpcore", "gappa", "sampled", "write_docs", "hashes"])]
    configurations: bool,
    /// Only let Gappa and Coq check a sample of parts of the box, and refuse wrong ones
    #[arg(long, conflicts_with_all = ["write_docs", "hashes"])]
    sampled: bool,
    /// Rewrite docs/certificates.md with its picture, or a part of the page
    #[arg(
        long,
        value_enum,
        value_name = "PART",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "all",
        conflicts_with_all = ["robot", "json"]
    )]
    write_docs: Option<Part>,
    /// Only compare the hashes in docs/certificates.md with today's machine code, and its numbers
    /// with their sums and each other
    #[arg(long, conflicts_with_all = ["robot", "write_docs"])]
    hashes: bool,
    #[command(flatten)]
    options: robot_import::import::Options,
}

impl Args {
    /// Whether a part of the page is to be written.
    fn writes(&self, part: Part) -> bool {
        self.write_docs
            .is_some_and(|written| written == Part::All || written == part)
    }
}

/// The share of each range that the parts have which Gappa checks.
const PART: f64 = 1.0 / 64.0;
/// See [`Args::points`].
const POINTS: usize = 1_000_000;
const PAGE_POINTS: usize = 5_000_000;
const LOOSEST: &str = "panda";
/// Points of each grid and parts of each box of `--configurations`, which proves a hundred of them.
const CONFIGURED_POINTS: usize = 300_000;
const CONFIGURED_PARTS: usize = 300;
/// Points on which the Fourier coefficients of the difference of two models are evaluated.
const CONFIGURED_FINE: usize = 4_000_000;
/// Points of the grids of a robot with a loop, over all parts of the coordinates that it depends on
/// by quotients and roots.
const LOOP_POINTS: usize = 100_000;
/// Parts for speeds and for the floor of the inertia matrix; those of the page.
const SHEET_EFFORT: limits::Effort = limits::Effort {
    speeds: 20_000,
    floor: 20_000,
    inertias: None,
};
const PAGE_EFFORT: limits::Effort = limits::Effort {
    speeds: 100_000,
    floor: 80_000,
    inertias: None,
};
/// Points of each grid of `--inertias`.
const BAND_POINTS: usize = 4_000_000;
const PAGE: &str = "docs/certificates.md";
/// The results that are kept as benchmarks for FPBench.
const KEPT: [(&str, Function, &str); 3] = [
    ("ur5e", Function::Rnea, "rnea_ur5e.fpcore"),
    ("so101", Function::Gravity, "gravity_so101.fpcore"),
    (CLUSTERED, Function::Clustered, "four_bar.fpcore"),
];
/// The functions of their own part of the page.
const FORWARD: [Function; 2] = [Function::ForwardDynamics, Function::CoreForwardDynamics];
/// The worst states of these, for `host-tests/oracle/forward.py`.
const WORST: &str = "host-tests/recordings/forward.json";
const FOLDER: &str = "docs/fpbench";
const PICTURE: &str = "docs/certificates.svg";
const CONFIGURED: &str = "docs/accuracy-proven.json";

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
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let written = || {
        let path = docs.join(PAGE);
        std::fs::read_to_string(&path).map_err(|source| Error::File { path, source })
    };
    if args.configurations {
        let spent = configurations::Spent {
            points: args.points.unwrap_or(CONFIGURED_POINTS),
            fine: CONFIGURED_FINE,
            parts: args.parts.min(CONFIGURED_PARTS),
        };
        let prove = |(program, robot)| configurations::prove(&program, &robot, spent);
        let all = configured(args)?.into_iter().map(prove);
        let all = all.collect::<Result<Vec<_>>>()?;
        return serde_json::to_string_pretty(&all).map_err(|e| Error::Robot(e.to_string()));
    }
    let robots: Vec<&str> = match &args.robot {
        Some(robot) => vec![robot],
        None => {
            let library = LIBRARY.map(|(name, _)| name);
            library.into_iter().chain([CLUSTERED]).collect()
        }
    };
    let programs = robots
        .iter()
        .map(|robot| program::build(robot, &args.options))
        .collect::<Result<Vec<_>>>()?;
    let boxed = |program: &Program| boxed(args, program, args.acceleration);
    let robots: Vec<Robot> = programs.iter().map(boxed).collect::<Result<_>>()?;
    if args.hashes {
        check::numbers(&written()?)?;
        for program in &programs {
            let image = Image::read(&program.elf)?;
            let asked = [&*args.function, &FORWARD].concat();
            let functions = program.functions(&asked);
            check::hashes(&image, &functions, &program.robot, &written()?)?;
        }
        for (path, text) in kept(&docs, &programs, &robots)? {
            check::file(&path, &text)?;
        }
        let recorded = std::fs::read_to_string(docs.join(CONFIGURED)).unwrap_or_default();
        let recorded: Vec<Configurations> = serde_json::from_str(&recorded).unwrap_or_default();
        for (program, robot) in configured(args)? {
            let today = configurations::hashes(&Image::read(&program.elf)?, &robot)?;
            configurations::check(&recorded, &program.robot, &today)?;
        }
        return Ok(format!(
            "{PAGE}, {FOLDER} and {CONFIGURED} are of today's machine code"
        ));
    }
    if args.writes(Part::Certificates) || args.writes(Part::Clusters) {
        for (path, text) in kept(&docs, &programs, &robots)? {
            program::write(&path, &text)?;
        }
    }
    if let Some(folder) = &args.fpcore {
        return benchmarks(args, folder, &programs, &robots);
    }
    if args.sampled {
        return sampled(args, &programs, &robots);
    }
    let limits = if args.robot.is_some() || args.writes(Part::Limits) {
        limits(args, &programs, &robots)?
    } else {
        Vec::new()
    };
    if args.writes(Part::Limits) {
        let of = |one: &Limits| format!("### {}\n\n{}\n", one.robot, one.markdown());
        let text: String = limits.iter().map(of).collect();
        let page = check::page(&written()?, Part::Limits, &text)?;
        program::write(&docs.join(PAGE), &page)?;
    }
    // Once for all robots: what holds over the widest ranges holds over each.
    let joints: Vec<_> = robots
        .iter()
        .flat_map(|robot| robot.joints.iter().copied())
        .collect();
    let sines = sines::enumerate(&joints);
    let mut certificates = Vec::new();
    for (program, robot) in programs.iter().zip(&robots) {
        let asked = match args.write_docs {
            Some(_) => [&*args.function, &FORWARD].concat(),
            None => args.function.clone(),
        };
        let is_written =
            |function: &Function| args.write_docs.is_none() || args.writes(part(*function));
        let mut functions = program.functions(&asked);
        functions.retain(is_written);
        if functions.is_empty() {
            continue;
        }
        let image = Image::read(&program.elf)?;
        let emulation = emulation::run(program, robot).map_err(|error| error.to_string());
        for function in functions {
            let start = Instant::now();
            let target = Target::of(&image, function, robot, &emulation)?;
            let spent = spent(args, function, &program.robot);
            let mut one = certificate::certify(program, function, robot, sines, spent)?;
            one.target = Some(target);
            if args.gappa {
                check::by_gappa(&image, function, robot, sines, &one, PART, args.coq)?;
            }
            eprintln!(
                "{}: {}: {:.0} s",
                one.robot,
                function.name(),
                start.elapsed().as_secs_f64()
            );
            certificates.push(one);
        }
    }
    finish(args, &docs, &certificates, limits.first(), written)
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

/// The part of the page that has a function's certificates.
fn part(function: Function) -> Part {
    match function {
        Function::Clustered => Part::Clusters,
        _ if function.matrix().is_some() => Part::Forward,
        _ => Part::Certificates,
    }
}

/// What is proven of the robots themselves.
fn limits(args: &Args, programs: &[Program], robots: &[Robot]) -> Result<Vec<Limits>> {
    let mut effort = match args.write_docs {
        Some(_) => PAGE_EFFORT,
        None => SHEET_EFFORT,
    };
    let spent = inertias::Effort {
        points: args.points.unwrap_or(BAND_POINTS),
        states: args.states,
    };
    effort.inertias = args.inertias.map(|percent| (percent, spent));
    let is_tree = |one: &(&Program, &Robot)| one.0.robot != CLUSTERED;
    let all = programs.iter().zip(robots).filter(is_tree);
    all.map(|(program, robot)| {
        let start = Instant::now();
        let one = Limits::of(program, robot, effort)?;
        let seconds = start.elapsed().as_secs_f64();
        eprintln!("{}: speeds and inertia: {seconds:.0} s", one.robot);
        Ok(one)
    })
    .collect()
}

/// What a function of a robot computes.
fn benchmark(program: &Program, robot: &Robot, function: Function) -> Result<String> {
    let graph = Subject::of(&Image::read(&program.elf)?, function)?.graph;
    let name = format!("{}: {}", program.robot, function.name().replace('`', ""));
    let results = 0..graph.outputs.len();
    let cores = results.map(|output| fpcore::fpcore(&graph, output, robot, &name));
    let cores: Option<Vec<String>> = cores.collect();
    let cores = cores.ok_or_else(|| Error::Missing("an input that the box bounds".to_owned()))?;
    Ok(cores.join("\n"))
}

fn file_name(robot: &str, function: Function) -> String {
    let function = format!("{function:?}").to_lowercase();
    format!("{function}_{robot}.fpcore")
}

/// Writes what each function of each robot computes.
fn benchmarks(
    args: &Args,
    folder: &Path,
    programs: &[Program],
    robots: &[Robot],
) -> Result<String> {
    let mut written = Vec::new();
    for (program, robot) in programs.iter().zip(robots) {
        for function in program.functions(&args.function) {
            let file = folder.join(file_name(&program.robot, function));
            program::write(&file, &benchmark(program, robot, function)?)?;
            written.push(file.display().to_string());
        }
    }
    Ok(format!("written: {}", written.join(", ")))
}

/// The files of benchmarks that are kept, and their texts.
fn kept(docs: &Path, programs: &[Program], robots: &[Robot]) -> Result<Vec<(PathBuf, String)>> {
    let mut files = Vec::new();
    for (name, function, file) in KEPT {
        for (program, robot) in programs
            .iter()
            .zip(robots)
            .filter(|one| one.0.robot == name)
        {
            let path = docs.join(FOLDER).join(file);
            files.push((path, benchmark(program, robot, function)?));
        }
    }
    Ok(files)
}

fn sampled(args: &Args, programs: &[Program], robots: &[Robot]) -> Result<String> {
    let mut rng = fastrand::Rng::with_seed(1);
    let mut sampled = 0;
    for (program, robot) in programs.iter().zip(robots) {
        for function in program.functions(&args.function) {
            check::sampled(&Image::read(&program.elf)?, function, robot, &mut rng)?;
            eprintln!(
                "{}: {}: accepted by Gappa and Coq",
                program.robot,
                function.name()
            );
            sampled += 1;
        }
    }
    Ok(format!(
        "Gappa and Coq accept {sampled} parts of certificates, and refuse {} wrong ones",
        2 * sampled
    ))
}

fn spent(args: &Args, function: Function, robot: &str) -> Spent {
    // Of the loop a million states with its three results.
    let states = match function {
        Function::Clustered => 2 * args.states,
        _ => args.states,
    };
    // A third of the states at random, the rest in generations.
    let children = states / 3 * 2 / 96;
    Spent {
        parts: args.parts,
        points: args.points.unwrap_or(match function {
            // It has the most results: 27 of six joints, 35 of seven. Those of the engine's bias
            // for a Panda are the loosest.
            Function::ForwardDynamics if robot == LOOSEST && args.write_docs.is_some() => {
                PAGE_POINTS
            }
            Function::Clustered => LOOP_POINTS,
            _ if function.matrix().is_some() => POINTS,
            _ if args.write_docs.is_some() => PAGE_POINTS,
            _ => POINTS,
        }),
        search: Effort {
            random: states / 3,
            generations: 96,
            children,
        },
    }
}

fn finish(
    args: &Args,
    docs: &Path,
    certificates: &[Certificate],
    limits: Option<&Limits>,
    written: impl Fn() -> Result<String>,
) -> Result<String> {
    if let Some(path) = &args.picture {
        program::write(path, &picture::svg(certificates))?;
    }
    for written_part in [Part::Certificates, Part::Forward, Part::Clusters] {
        if !args.writes(written_part) {
            continue;
        }
        let mine = certificates
            .iter()
            .filter(|one| part(one.function) == written_part);
        let mine: Vec<Certificate> = mine.cloned().collect();
        if written_part == Part::Certificates {
            program::write(&docs.join(PICTURE), &picture::svg(&mine))?;
        }
        if written_part == Part::Forward {
            program::write(&docs.join(WORST), &page::worst_states(&mine)?)?;
        }
        let page = check::page(&written()?, written_part, &page::tables(&mine))?;
        program::write(&docs.join(PAGE), &page)?;
    }
    if args.write_docs.is_some() {
        return Ok(format!("written: {PAGE}"));
    }
    let json = |e: serde_json::Error| Error::Robot(e.to_string());
    match limits.and_then(|limits| Sheet::of(certificates, limits)) {
        Some(sheet) if args.json => serde_json::to_string_pretty(&sheet).map_err(json),
        Some(sheet) => Ok(sheet.markdown()),
        None if args.json => serde_json::to_string_pretty(certificates).map_err(json),
        None => Ok(page::tables(certificates)),
    }
}
