//! `cargo xtask test`: what guards correctness, as a table of steps; `--full` adds every robot,
//! every scene, every report and the currency of the documents, which is what CI runs.

mod absent;
mod functions;
mod host;
mod others;
mod package;
mod scenes;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::OnceLock;
use std::time::Instant;

use clap::builder::PossibleValuesParser;
use cycle_meter::Sample;

use crate::commands::demo::{Built, Measured};
use crate::commands::watch;
use crate::kit::error::{Error, Result};
use crate::kit::progress::Spinner;
use crate::kit::qemu::Run;
use crate::kit::scene::Scene;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::workspace::{BOARDS, Workspace};
use crate::kit::{firmware, meter, output, shell};
use crate::studies::STUDIES;
use crate::studies::study::{Bench, Held, Lane, Scope, Study};
use Lane::{Host, Target};
use Scope::{Everyday, Full, Named};

/// One thing that is tested: its name on the command line, its lane, which runs it belongs to, the
/// claim that holds if it passes, and the function that tests it and returns the measured figures
/// in words, if there are any.
type Step<F = fn(&Context) -> Result<String>> = (&'static str, Lane, Scope, &'static str, F);

#[derive(Clone, Copy)]
enum Task {
    Step(fn(&Context) -> Result<String>),
    Study(&'static Study),
}

struct Context {
    workspace: Workspace,
    options: Options,
    /// Whether every robot, every scene and every report is tested, or the cheapest witness of each
    /// claim.
    full: bool,
    tools: Tools,
    measured: OnceLock<Vec<Measured>>,
}

#[rustfmt::skip]
const STEPS: &[Step] = &[
    ("fmt", Host, Everyday, "rustfmt has nothing to change", |c| c.cargo(&["fmt --all --check", &format!("fmt --manifest-path {BOARDS} --all --check")])),
    ("clippy", Host, Full, "clippy has nothing to say of the host crates and of the firmware", host::clippy),
    ("host", Host, Everyday, "the host tests pass", host::tests),
    ("simulations", Host, Full, "arms that are simulated for seconds to hours behave as claimed", host::simulations),
    ("doctests", Host, Everyday, "the examples in the documentation and those of the library run", package::examples),
    ("doc", Host, Full, "the documentation builds without a warning, that of private items too", host::doc),
    ("features", Host, Full, "the library builds with its oldest compiler, and its features for the target; they change no number", package::features),
    ("package", Host, Full, "the crates to be published package with their licences, and build from their packages alone", package::package),
    ("deny", Host, Full, "dependencies, their licences and their sources are those that deny.toml allows", package::deny),
    ("firmware", Target, Full, "the firmware's bins build, as do the guide's programs and the servo bus under Embassy; an imported robot is checked, and measured in QEMU", functions::build),
    ("meter", Target, Everyday, "the cycle meter agrees with sequences counted by hand", functions::meter),
    ("bits", Host, Everyday, "the host and QEMU compute the same bits", functions::bits),
    ("scene", Target, Everyday, "every scene runs to its end and tracks within its bound, the default one better than PD as promised; in a full run, one runs twice and gives the same bytes", scenes::runs),
    ("no-f64", Target, Everyday, "the tick reaches no f64 arithmetic, no sine of libm and no panic, and the firmware no instruction that a Cortex-M4F lacks", functions::no_f64),
    ("budgets", Target, Everyday, "every scene is within budgets.toml, and its longest tick within half its period", scenes::budgets),
    ("constant", Target, Everyday, "the work costs the same whatever the data", functions::constant),
    // From here on programs for the host are built too: earlier they would wait for the other
    // lane's.
    ("faults", Target, Named, "100 arms under injected faults keep their limits in QEMU, with the host's torques", functions::faults),
    ("telemetry", Target, Full, "a tick costs the same with a listener, without one, and with a full queue", |c| watch::check(&c.workspace, &c.tools, &c.meter()?)),
    ("absent-effects", Target, Everyday, "an effect that a scene does not name costs it nothing", absent::absent_effects_cost_nothing),
    ("projects", Host, Full, "new projects in Rust and in C build, run in QEMU and compute the host's torques", others::projects),
];

impl Context {
    fn meter(&self) -> Result<PathBuf> {
        firmware::build_meter(&self.workspace)
    }

    fn bench(&self) -> Bench<'_> {
        let tools = self.tools.clone();
        Bench::of_test(&self.workspace, self.options, tools)
    }

    /// The scenes under test: all of them in a full run, the default one else.
    fn scenes(&self) -> &'static [Scene] {
        if self.full { Scene::all() } else { &Scene::all()[..1] }
    }

    /// One run of each scene under test, done once.
    fn measured(&self) -> Result<&[Measured]> {
        let (workspace, tools) = (&self.workspace, &self.tools);
        let run = || Built::new(workspace, tools, self.scenes())?.measure(workspace, tools);
        once(&self.measured, run).map(Vec::as_slice)
    }

    /// Runs cargo for host crates, once for each line of words, and returns what it printed.
    fn cargo(&self, lines: &[impl AsRef<str>]) -> Result<String> {
        let mut printed = String::new();
        for line in lines {
            let mut words = line.as_ref().split_whitespace();
            let subcommand = words.next().unwrap_or_default();
            let mut command = self.workspace.cargo(subcommand);
            if subcommand == "doc" {
                command.env("RUSTDOCFLAGS", "-D warnings");
            }
            printed += &shell::capture(command.args(words))?;
        }
        Ok(printed)
    }

    /// A bin of the firmware, built.
    fn built(&self, name: &str) -> Result<PathBuf> {
        firmware::build(&self.workspace, self.tools.toolchain, name)
    }

    /// The lines that a bin of the firmware logs, and what it cost between its markers.
    fn metered(&self, name: &str, logs: bool) -> Result<(Vec<String>, Vec<Sample>)> {
        let elf = self.built(name)?;
        let regions = self.workspace.output(&format!("{name}.regions"))?;
        let meter = self.meter()?;
        let meter = Some((meter.as_path(), regions.as_path()));
        let mut run = Run::logging(name, &elf, meter);
        run.logs = logs;
        Ok((self.tools.qemu.lines(&run)?, meter::read(&regions)?))
    }
}

/// Makes a value at the first call and keeps it.
fn once<T>(kept: &OnceLock<T>, make: impl FnOnce() -> Result<T>) -> Result<&T> {
    if let Some(made) = kept.get() {
        return Ok(made);
    }
    let made = make()?;
    Ok(kept.get_or_init(|| made))
}

/// All steps: those of the table, and then those of the studies, which build most.
fn steps() -> impl Iterator<Item = Step<Task>> {
    let own = STEPS.iter();
    let own =
        own.map(|&(name, lane, scope, title, run)| (name, lane, scope, title, Task::Step(run)));
    let studies = STUDIES.iter().filter_map(|study| match study.held {
        Held::Step(lane, scope, title) => {
            Some((study.name, lane, scope, title, Task::Study(study)))
        }
        Held::Bars(_) => None,
    });
    own.chain(studies)
}

/// The steps' names, for the command line.
pub fn names() -> PossibleValuesParser {
    steps().map(|step| step.0).collect::<Vec<_>>().into()
}

/// Prints the steps, with those last that only a full run takes.
pub fn list() -> Result<ExitCode> {
    let steps = |scope| -> String {
        let steps = steps().filter(|step| step.2 == scope);
        let lines = steps.map(|(name, _, _, title, _)| format!("  {name:16} {title}\n"));
        lines.collect()
    };
    let unheld = STUDIES.iter().filter_map(|study| match study.held {
        Held::Step(..) => None,
        Held::Bars(why) => Some(format!("  {:16} {why}\n", study.name)),
    });
    let text = format!(
        "every run:\n{}\nonly with --full, or by name:\n{}\nonly by name:\n{}\n\
         pages that no step measures anew:\n{}",
        steps(Everyday),
        steps(Full),
        steps(Named),
        unheld.collect::<String>()
    );
    output::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

#[derive(clap::Args)]
pub struct Args {
    /// Only these steps (see --list)
    #[arg(value_name = "STEP", value_parser = names())]
    steps: Vec<String>,
    /// All robots, all scenes, all reports and whether the documents are current: what CI runs
    #[arg(long)]
    full: bool,
    /// List the steps
    #[arg(long)]
    list: bool,
}

/// Runs the steps of these names, or those of an everyday or a full run.
pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    if args.list {
        return list();
    }
    let start = Instant::now();
    let context = Context {
        workspace: Workspace { full: args.full, ..Workspace::find()? },
        tools: setup::for_test(options)?,
        options: options.without_questions(),
        full: args.full,
        measured: OnceLock::new(),
    };
    let wanted = |(name, _, scope, _, _): &Step<Task>| match args.steps.as_slice() {
        [] => *scope == Everyday || args.full && *scope == Full,
        names => names.iter().any(|wanted| wanted == name),
    };
    // Later it would wait for the host's tests, which the other lane builds.
    context.meter()?;
    let run = |lane| {
        let steps = steps().filter(|step| step.1 == lane).filter(wanted);
        let outcomes = steps.map(|step| passes(step, &context));
        outcomes.collect::<Result<Vec<_>>>()
    };
    let outcomes = std::thread::scope(|scope| {
        let lanes = [Host, Target].map(|lane| scope.spawn(move || run(lane)));
        let ends = lanes.map(|lane| lane.join().unwrap_or_else(|_| Ok(vec![Some(false)])));
        ends.into_iter().collect::<Result<Vec<_>>>()
    })?
    .concat();
    let count = |what| outcomes.iter().filter(|outcome| **outcome == what).count();
    let (passed, failed) = (count(Some(true)), count(Some(false)));
    if args.steps.is_empty() && !args.full {
        output::line(
            "every robot, scene, report and document: `cargo xtask test --full`; `--list` names what it adds",
        )?;
    }
    let seconds = start.elapsed().as_secs();
    output::line(&format!("took {} min {:02} s", seconds / 60, seconds % 60))?;
    output::line(&format!("{passed} passed, {failed} failed"))?;
    Ok(ExitCode::from(u8::from(failed > 0)))
}

/// Runs a step and says how it ended: whether it passed, if it applied here.
fn passes((name, _, _, title, task): Step<Task>, context: &Context) -> Result<Option<bool>> {
    let start = Instant::now();
    let spinner = Spinner::start(title);
    let result = match task {
        Task::Step(run) => run(context),
        Task::Study(study) => study.check(&context.bench()),
    };
    drop(spinner);
    let in_brackets = |text: &str| format!(" ({text})");
    let (mark, detail, passed) = match result {
        Ok(detail) if detail.is_empty() => ("ok  ", detail, Some(true)),
        Ok(detail) => ("ok  ", in_brackets(&detail), Some(true)),
        Err(Error::Skipped(why)) => ("skip", in_brackets(&why), None),
        Err(error) => ("FAIL", format!("\n{error}\n"), Some(false)),
    };
    let seconds = start.elapsed().as_secs_f64();
    output::line(&format!("{mark} {seconds:6.1} s  {name:16} {title}{detail}"))?;
    Ok(passed)
}
