//! The studies: each measures something, holds its bounds, and writes a page for a release.
//!
//! A study is a file of this folder and its row in [`STUDIES`].

pub mod accuracy;
pub mod budgets;
pub mod cores;
pub mod costs;
pub mod effects;
pub mod flags;
pub mod hard_cases;
pub mod history;
pub mod peers;
pub mod robots;
pub mod rtl;
pub mod scenes;
pub mod study;

use clap::{ArgMatches, Args, Command};

use crate::kit::error::Result;
use study::Form::{Own, Part, Whole};
use study::Held::{Bars, Step};
use study::Lane::{Host, Target};
use study::Scope::{Everyday, Full, Named};
use study::{Study, given};

/// The check of a study that no step measures.
const NO_STEP: fn(&study::Bench<'_>) -> Result<String> = |_| Ok(String::new());

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
        name: "flags", about: "Measure what other flags of the compiler and profiles cost, rewrite docs/flags.md and a part of the guide's page on firmware",
        files: &["docs/flags.md"],
        held: Step(Target, Named, "docs/flags.md has today's costs by other flags of the compiler and the functions of core in a tick, the guide those of profiles"),
        form: Part(flags::measure),
    },
    Study {
        name: "history", about: "Measure what today's algorithms replaced and rewrite docs/history.md",
        files: &["docs/history.md"],
        held: Step(Target, Full, "docs/history.md has today's costs of the algorithms that today's replaced"),
        form: Whole(history::measure),
    },
    Study {
        name: "cores", about: "Run the control loop on four cores that QEMU emulates: the same bits, the stack",
        files: &["docs/boards.md"],
        held: Step(Target, Full, "a Cortex-M0, M3 and M33 and an RV32 compute the host's torques, and docs/boards.md has the stack that they take and the sizes of the boards' images"),
        form: Own(cores::Args::augment_args, |options, matches| cores::run(options, given(matches)?), cores::check),
    },
    Study {
        name: "rtl", about: "Count cycles on a RISC-V core simulated from its register-transfer source, rewrite docs/rtl.md",
        files: &["docs/rtl.md", "docs/rtl.svg"],
        held: Step(Target, Full, "a core's gates count the cycles of docs/rtl.md, and compute the bits of QEMU and of the host"),
        form: Whole(rtl::measure),
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
    Study {
        name: "robots", about: "Import, check and measure the robots of published packages, rewrite docs/robots.md: takes minutes",
        files: &["docs/robots.md"],
        held: Step(Target, Full, "an imported robot is checked, and costs what docs/robots.md says"),
        form: Own(robots::Args::augment_args, |options, matches| robots::run(options, given(matches)?), robots::check),
    },
    Study {
        name: "peers", about: "Measure other libraries and this one side by side, rewrite docs/peers.md: takes minutes",
        files: &["docs/peers.md"],
        held: Bars("the other libraries are not installed for a test, and times are those of one machine"),
        form: Own(peers::Args::augment_args, |options, matches| peers::run(options, given(matches)?), NO_STEP),
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
