//! `cargo xtask test`: everything that CI runs, as a table of steps.

mod absent_steps;
mod cost_steps;
mod firmware_steps;
mod host_steps;
mod scene_steps;

use std::cell::OnceCell;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::builder::PossibleValuesParser;

use crate::demo::{self, Measured};
use crate::error::Result;
use crate::firmware;
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
    run: fn(&Context) -> Result<Outcome>,
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
    /// Whether the step `debian` may install Debian's compiler.
    may_install_debian: bool,
    tools: Tools,
    meter: OnceCell<PathBuf>,
    measured: OnceCell<Vec<Measured>>,
}

const STEPS: &[Step] = &[
    Step {
        name: "fmt",
        title: "rustfmt has nothing to change",
        run: host_steps::fmt,
    },
    Step {
        name: "clippy",
        title: "clippy has nothing to say of the host crates",
        run: host_steps::clippy,
    },
    Step {
        name: "clippy-firmware",
        title: "clippy has nothing to say of the firmware",
        run: firmware_steps::clippy,
    },
    Step {
        name: "host",
        title: "the host tests pass",
        run: host_steps::tests,
    },
    Step {
        name: "doctests",
        title: "the examples in the documentation run",
        run: host_steps::doctests,
    },
    Step {
        name: "doc",
        title: "the documentation builds without a warning",
        run: host_steps::doc,
    },
    Step {
        name: "firmware",
        title: "every bin of the firmware builds",
        run: firmware_steps::build,
    },
    Step {
        name: "meter",
        title: "the cycle meter agrees with sequences counted by hand",
        run: firmware_steps::meter,
    },
    Step {
        name: "bits",
        title: "the host and QEMU compute the same bits",
        run: firmware_steps::bits,
    },
    Step {
        name: "scene",
        title: "every scene runs to its end",
        run: scene_steps::runs,
    },
    Step {
        name: "determinism",
        title: "two runs of a scene give the same bytes",
        run: scene_steps::determinism,
    },
    Step {
        name: "tracking",
        title: "feed-forward tracks better than PD by what was promised",
        run: scene_steps::tracking,
    },
    Step {
        name: "cycles",
        title: "the longest tick is short enough",
        run: scene_steps::cycles,
    },
    Step {
        name: "no-f64",
        title: "the tick reaches no f64 arithmetic, no libm trigonometry and no panic",
        run: firmware_steps::no_f64,
    },
    Step {
        name: "opcodes",
        title: "the firmware has no instruction that a Cortex-M4F lacks",
        run: firmware_steps::opcodes,
    },
    Step {
        name: "budgets",
        title: "every scene is within budgets.toml",
        run: scene_steps::budgets,
    },
    Step {
        name: "constant",
        title: "the work costs the same whatever the data",
        run: cost_steps::constant,
    },
    Step {
        name: "costs",
        title: "every function is within budgets.toml and its bar, and docs/costs.md says so",
        run: cost_steps::costs,
    },
    Step {
        name: "growth",
        title: "inverse and forward dynamics grow in step with a chain, and docs/growth.md says so",
        run: cost_steps::growth,
    },
    Step {
        name: "absent-effects",
        title: "an effect that a scene does not name costs it nothing",
        run: absent_steps::absent_effects_cost_nothing,
    },
    Step {
        name: "eliminations",
        title: "docs/eliminations.md has today's accuracies",
        run: host_steps::eliminations,
    },
    Step {
        name: "hard-cases",
        title: "every hard case holds, and docs/hard-cases.md has today's figures",
        run: host_steps::hard_cases,
    },
    Step {
        name: "readme",
        title: "the README's tables are those of this run",
        run: scene_steps::readme,
    },
    Step {
        name: "debian",
        title: "Debian's own compiler builds a scene that runs",
        run: scene_steps::debian,
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

    /// One run of each scene, done once.
    fn measured(&self) -> Result<&[Measured]> {
        if self.measured.get().is_none() {
            let all = Scene::ALL
                .iter()
                .map(|scene| demo::build_and_measure(&self.workspace, &self.tools, *scene))
                .collect::<Result<Vec<_>>>()?;
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

/// Prints the steps.
pub fn list() {
    for step in STEPS {
        println!("{:16} {}", step.name, step.title);
    }
}

/// Runs the steps of these names, or all of them.
pub fn run(options: Options, only: &[String], debian: bool) -> Result<ExitCode> {
    let context = Context {
        workspace: Workspace::find()?,
        tools: setup::for_test(options)?,
        options,
        // A CI machine is thrown away: what is installed there is in nobody's way.
        may_install_debian: debian || std::env::var_os("CI").is_some_and(|ci| ci == "true"),
        meter: OnceCell::new(),
        measured: OnceCell::new(),
    };
    let wanted = |step: &&Step| only.is_empty() || only.iter().any(|name| name == step.name);
    let (mut passed, mut failed) = (0, 0);
    for step in STEPS.iter().filter(wanted) {
        let start = Instant::now();
        let spinner = Spinner::start(step.title);
        let result = (step.run)(&context);
        drop(spinner);
        let (mark, detail) = match &result {
            Ok(Outcome::Passed(seen)) => ("ok  ", seen.clone()),
            Ok(Outcome::Skipped(why)) => ("skip", why.clone()),
            Err(_) => ("FAIL", String::new()),
        };
        let detail = if detail.is_empty() {
            detail
        } else {
            format!(" ({detail})")
        };
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{mark} {seconds:6.1} s  {:16} {}{detail}",
            step.name, step.title
        );
        match result {
            Ok(Outcome::Passed(_)) => passed += 1,
            Ok(Outcome::Skipped(_)) => {}
            Err(error) => {
                failed += 1;
                println!("{error}\n");
            }
        }
    }
    println!("{passed} passed, {failed} failed");
    Ok(if failed == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}
