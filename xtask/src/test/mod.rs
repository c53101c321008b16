//! `cargo xtask test`: what guards correctness, as a table of steps; `--full` adds every robot, every scene,
//! every report and the currency of the documents, which is what CI runs.

mod absent_steps;
mod claims;
mod cost_steps;
mod firmware_steps;
mod host_steps;
mod other_compilers;
mod other_machines;
mod package_steps;
mod scene_steps;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::OnceLock;
use std::time::Instant;

use clap::builder::PossibleValuesParser;

use crate::demo::{self, Measured};
use crate::error::Result;
use crate::firmware;
use crate::output;
use crate::progress::Spinner;
use crate::scene::Scene;
use crate::setup::{self, Options, Tools};
use crate::workspace::Workspace;

/// One thing that is tested.
struct Step {
    /// Its name on the command line.
    name: &'static str,
    /// What holds if it passes.
    title: &'static str,
    lane: Lane,
    scope: Scope,
    run: fn(&Context) -> Result<Outcome>,
}

/// Which runs a step belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Scope {
    /// Every run, on the cheapest witness of each claim; a full run adds the others.
    Everyday,
    /// A full run only, or by name.
    Full,
}

/// Which of the two rows of steps that go on side by side: cargo builds for the host and for the target in
/// different directories, and the one keeps no core busy while the other links or emulates.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lane {
    Host,
    Target,
}

/// How a step ended that did not fail.
enum Outcome {
    /// It passed; what was seen, if there is something to see.
    Passed(String),
    /// It does not apply here, and why.
    Skipped(String),
}

impl Outcome {
    const PASSED: Result<Self> = Ok(Self::Passed(String::new()));
}

/// What the steps share.
struct Context {
    workspace: Workspace,
    options: Options,
    /// Whether every robot, every scene and every report is tested, or the cheapest witness of each claim.
    full: bool,
    /// Whether the step `debian` may install Debian's compiler.
    may_install_debian: bool,
    tools: Tools,
    meter: OnceLock<PathBuf>,
    measured: OnceLock<Vec<Measured>>,
}

const STEPS: &[Step] = &[
    Step {
        name: "fmt",
        title: "rustfmt has nothing to change",
        lane: Lane::Host,
        scope: Scope::Everyday,
        run: host_steps::fmt,
    },
    Step {
        name: "clippy",
        title: "clippy has nothing to say of the host crates",
        lane: Lane::Host,
        scope: Scope::Full,
        run: host_steps::clippy,
    },
    Step {
        name: "clippy-firmware",
        title: "clippy has nothing to say of the firmware",
        lane: Lane::Target,
        scope: Scope::Full,
        run: firmware_steps::clippy,
    },
    Step {
        name: "host",
        title: "the host tests pass",
        lane: Lane::Host,
        scope: Scope::Everyday,
        run: host_steps::tests,
    },
    Step {
        name: "doctests",
        title: "the examples in the documentation run",
        lane: Lane::Host,
        scope: Scope::Everyday,
        run: host_steps::doctests,
    },
    Step {
        name: "doc",
        title: "the documentation builds without a warning",
        lane: Lane::Host,
        scope: Scope::Full,
        run: host_steps::doc,
    },
    Step {
        name: "examples",
        title: "the library's examples run",
        lane: Lane::Host,
        scope: Scope::Everyday,
        run: package_steps::examples,
    },
    Step {
        name: "features",
        title: "the library's features build for the target and change no number",
        lane: Lane::Host,
        scope: Scope::Full,
        run: package_steps::features,
    },
    Step {
        name: "package",
        title: "the crate packages, and builds vendored from git",
        lane: Lane::Host,
        scope: Scope::Full,
        run: package_steps::package,
    },
    Step {
        name: "deny",
        title: "dependencies, their licences and their sources are those that deny.toml allows",
        lane: Lane::Host,
        scope: Scope::Full,
        run: package_steps::deny,
    },
    Step {
        name: "firmware",
        title: "every bin of the firmware builds",
        lane: Lane::Target,
        scope: Scope::Full,
        run: firmware_steps::build,
    },
    Step {
        name: "meter",
        title: "the cycle meter agrees with sequences counted by hand",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: firmware_steps::meter,
    },
    Step {
        name: "bits",
        title: "the host and QEMU compute the same bits",
        lane: Lane::Host,
        scope: Scope::Everyday,
        run: firmware_steps::bits,
    },
    Step {
        name: "scene",
        title: "every scene runs to its end",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: scene_steps::runs,
    },
    Step {
        name: "determinism",
        title: "two runs of a scene give the same bytes",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: scene_steps::determinism,
    },
    Step {
        name: "tracking",
        title: "every scene tracks within its bound, the default one better than PD as promised",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: scene_steps::tracking,
    },
    Step {
        name: "cycles",
        title: "the longest tick is short enough",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: scene_steps::cycles,
    },
    Step {
        name: "no-f64",
        title: "the tick reaches no f64 arithmetic, no libm trigonometry and no panic",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: firmware_steps::no_f64,
    },
    Step {
        name: "opcodes",
        title: "the firmware has no instruction that a Cortex-M4F lacks",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: firmware_steps::opcodes,
    },
    Step {
        name: "budgets",
        title: "every scene is within budgets.toml",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: scene_steps::budgets,
    },
    Step {
        name: "constant",
        title: "the work costs the same whatever the data",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: cost_steps::constant,
    },
    Step {
        name: "costs",
        title: "every function is within budgets.toml and its bar, and docs/costs.md says so",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: cost_steps::costs,
    },
    Step {
        name: "growth",
        title: "inverse and forward dynamics grow in step with a chain, and docs/growth.md says so",
        lane: Lane::Target,
        scope: Scope::Full,
        run: cost_steps::growth,
    },
    Step {
        name: "absent-effects",
        title: "an effect that a scene does not name costs it nothing",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: absent_steps::absent_effects_cost_nothing,
    },
    Step {
        name: "accuracy",
        title: "docs/accuracy.md has today's costs and errors of single changes; what is printed to be pasted keeps them",
        lane: Lane::Target,
        scope: Scope::Full,
        run: cost_steps::accuracy,
    },
    Step {
        name: "effects",
        title: "docs/effects.md has today's prices",
        lane: Lane::Target,
        scope: Scope::Full,
        run: cost_steps::effects,
    },
    Step {
        name: "eliminations",
        title: "docs/eliminations.md has today's accuracies",
        lane: Lane::Host,
        scope: Scope::Full,
        run: host_steps::eliminations,
    },
    Step {
        name: "hard-cases",
        title: "every hard case holds, and docs/hard-cases.md has today's figures",
        lane: Lane::Host,
        scope: Scope::Full,
        run: host_steps::hard_cases,
    },
    Step {
        name: "readme",
        title: "the tables of README.md and docs/scenes.md are those of this run",
        lane: Lane::Target,
        scope: Scope::Everyday,
        run: scene_steps::readme,
    },
    Step {
        name: "debian",
        title: "Debian's own compiler builds a scene that runs",
        lane: Lane::Target,
        scope: Scope::Full,
        run: scene_steps::debian,
    },
    Step {
        name: "qemu-10",
        title: "QEMU 10 logs and measures what this machine's QEMU does, byte for byte",
        lane: Lane::Target,
        scope: Scope::Full,
        run: other_machines::qemu_10,
    },
    Step {
        name: "compilers",
        title: "the UR5e's demo and costs are within their budgets with rustup's other compilers",
        lane: Lane::Target,
        scope: Scope::Full,
        run: other_compilers::compilers,
    },
];

impl Context {
    /// The cycle meter, built once.
    fn meter(&self) -> Result<&PathBuf> {
        if self.meter.get().is_none() {
            let meter = firmware::build_meter(&self.workspace)?;
            // Set just now, by nobody else: there is one thread.
            let _ = self.meter.set(meter);
        }
        Ok(self.meter.get_or_init(PathBuf::new))
    }

    /// The scenes under test: all of them in a full run, the default one else.
    fn scenes(&self) -> &'static [Scene] {
        if self.full {
            Scene::ALL
        } else {
            &Scene::ALL[..1]
        }
    }

    /// One run of each scene under test, done once.
    fn measured(&self) -> Result<&[Measured]> {
        if self.measured.get().is_none() {
            let all = demo::build_and_measure(&self.workspace, &self.tools, self.scenes())?;
            let _ = self.measured.set(all);
        }
        Ok(self.measured.get_or_init(Vec::new))
    }
}

/// The steps' names, for the command line.
pub fn names() -> PossibleValuesParser {
    STEPS
        .iter()
        .map(|step| step.name)
        .collect::<Vec<_>>()
        .into()
}

/// Prints the steps, with those last that only a full run takes, and the tests that it adds to the step `host`.
pub fn list() -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let steps = |scope| STEPS.iter().filter(move |step| step.scope == scope);
    let mut text = String::from("every run:\n");
    for step in steps(Scope::Everyday) {
        text += &format!("  {:16} {}\n", step.name, step.title);
    }
    text += "\nonly with --full, or by name:\n";
    for step in steps(Scope::Full) {
        text += &format!("  {:16} {}\n", step.name, step.title);
    }
    text += "\ntests that only --full adds to the step `host`; every other step then takes all robots and scenes:\n";
    let folders = ["host-tests/tests", "host-tests/unoptimised/tests"];
    let claims = folders.map(|folder| claims::full_only(&workspace.root.join(folder)));
    for (program, test) in claims.into_iter().collect::<Result<Vec<_>>>()?.concat() {
        text += &format!("  {program:16} {}\n", test.replace('_', " "));
    }
    output::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// Which steps to run, and how.
pub struct Args {
    /// The steps of these names; none: those of the run.
    pub steps: Vec<String>,
    /// Every step, every robot, every scene.
    pub full: bool,
    /// Whether the step `debian` may install Debian's compiler.
    pub debian: bool,
}

/// Runs the steps of these names, or those of an everyday or a full run.
pub fn run(options: Options, args: &Args) -> Result<ExitCode> {
    let start = Instant::now();
    let context = Context {
        workspace: Workspace::find()?,
        tools: setup::for_test(options)?,
        options,
        full: args.full,
        // A CI machine is thrown away: what is installed there is in nobody's way.
        may_install_debian: args.debian || std::env::var_os("CI").is_some_and(|ci| ci == "true"),
        meter: OnceLock::new(),
        measured: OnceLock::new(),
    };
    let wanted = |step: &&Step| match args.steps.as_slice() {
        [] => args.full || step.scope == Scope::Everyday,
        names => names.iter().any(|name| name == step.name),
    };
    let run = |lane| {
        let steps = STEPS.iter().filter(|step| step.lane == lane).filter(wanted);
        steps
            .map(|step| passes(step, &context))
            .collect::<Result<Vec<_>>>()
    };
    let outcomes = std::thread::scope(|scope| {
        let lanes = [Lane::Host, Lane::Target].map(|lane| scope.spawn(move || run(lane)));
        let panicked = |_| Ok(vec![Some(false)]);
        let ends = lanes.map(|lane| lane.join().unwrap_or_else(panicked));
        ends.into_iter().collect::<Result<Vec<_>>>()
    })?;
    let count = |what| {
        outcomes
            .iter()
            .flatten()
            .filter(|outcome| **outcome == what)
            .count()
    };
    let (passed, failed) = (count(Some(true)), count(Some(false)));
    if args.steps.is_empty() && !args.full {
        output::line(
            "every robot, scene, report and document: `cargo xtask test --full`; `--list` names what it adds",
        )?;
    }
    let seconds = start.elapsed().as_secs();
    output::line(&format!("took {} min {:02} s", seconds / 60, seconds % 60))?;
    output::line(&format!("{passed} passed, {failed} failed"))?;
    Ok(if failed == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// Runs a step and says how it ended: whether it passed, if it applied here.
fn passes(step: &Step, context: &Context) -> Result<Option<bool>> {
    let start = Instant::now();
    let spinner = Spinner::start(step.title);
    let result = (step.run)(context);
    drop(spinner);
    let (mark, detail) = match &result {
        Ok(Outcome::Passed(seen)) => ("ok  ", seen.clone()),
        Ok(Outcome::Skipped(why)) => ("skip", why.clone()),
        Err(_) => ("FAIL", String::new()),
    };
    let detail = match detail.as_str() {
        "" => detail,
        seen => format!(" ({seen})"),
    };
    let (name, title, seconds) = (step.name, step.title, start.elapsed().as_secs_f64());
    let line = format!("{mark} {seconds:6.1} s  {name:16} {title}{detail}");
    match result {
        Ok(Outcome::Passed(_)) => {
            output::line(&line)?;
            Ok(Some(true))
        }
        Ok(Outcome::Skipped(_)) => {
            output::line(&line)?;
            Ok(None)
        }
        Err(error) => {
            output::line(&format!("{line}\n{error}\n"))?;
            Ok(Some(false))
        }
    }
}
