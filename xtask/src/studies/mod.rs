//! The studies: each measures something, holds its bounds, and writes a page for a release.
//!
//! A study is a file of this folder and its row in [`STUDIES`].

pub mod accuracy;
pub mod budgets;
pub mod costs;
pub mod effects;
pub mod hard_cases;
pub mod scenes;
pub mod study;

use clap::{ArgMatches, Args, Command};

use study::Form::{Own, Part};
use study::Held::{Bars, Step};
use study::Lane::{Host, Target};
use study::Scope::{Everyday, Full};
use study::{Study, given};

/// In the order in which their steps run.
#[rustfmt::skip]
pub const STUDIES: &[Study] = &[
    Study {
        name: "costs", about: "Measure what each algorithm costs on each robot, rewrite docs/costs.md",
        files: &["docs/costs.md", "docs/costs.json"],
        held: Step(Target, Everyday, "72 functions that users meet cost what docs/costs.json says, or up to 3 % more, and are within their bars"),
        form: Own(costs::Args::augment_args, |options, matches| costs::run(options, given(matches)?), costs::check),
    },
    Study {
        name: "accuracy", about: "Measure what accuracy costs in time, rewrite docs/accuracy.md and its plots; or choose a configuration",
        files: &[
            "docs/accuracy.md", "docs/accuracy.json", "docs/accuracy-ur5e.svg", "docs/accuracy-panda.svg",
            "docs/accuracy-a1_leg.svg", "docs/accuracy-simulation.svg", "docs/accuracy-proven.json",
        ],
        held: Step(Target, Full, "the code that `cargo xtask accuracy` prints costs and errs no more than it promises"),
        form: Own(accuracy::Args::augment_args, |options, matches| accuracy::run(options, given(matches)?), accuracy::check),
    },
    Study {
        name: "effects", about: "Measure what each effect costs and the torque it contributes, rewrite docs/effects.md",
        files: &["docs/effects.md", "docs/effects.svg"],
        held: Bars("its prices are those of a release; `absent-effects` and the scenes' budgets guard them"),
        form: Part(effects::measure),
    },
    Study {
        name: "hard-cases", about: "Measure on the host what breaks dynamics codes, rewrite docs/hard-cases.md",
        files: &["docs/hard-cases.md", "docs/hard-cases.svg"],
        held: Step(Host, Full, "every hard case is within its bounds"),
        form: Part(hard_cases::measure),
    },
];

/// The commands of the studies.
pub fn commands() -> impl Iterator<Item = Command> {
    STUDIES.iter().map(Study::command)
}

/// The study that was chosen on the command line, with its arguments.
pub fn chosen(matches: &ArgMatches) -> Option<(&'static Study, &ArgMatches)> {
    let (name, matches) = matches.subcommand()?;
    let study = STUDIES.iter().find(|study| study.name == name)?;
    Some((study, matches))
}
