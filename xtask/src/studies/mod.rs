//! The studies: each measures something and keeps a page in docs/.
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
        files: &["docs/costs.md"],
        held: Step(Target, Everyday, "every function costs what docs/costs.md says, and is within its bar"),
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
        held: Step(Target, Full, "docs/accuracy.md has today's costs and errors of single changes; what is printed as generated code keeps them"),
        form: Own(accuracy::Args::augment_args, |options, matches| accuracy::run(options, given(matches)?), accuracy::check),
    },
    Study {
        name: "effects", about: "Measure what each effect costs and the torque it contributes, rewrite docs/effects.md",
        files: &["docs/effects.md", "docs/effects.svg"],
        held: Step(Target, Full, "docs/effects.md has today's prices"),
        form: Part(effects::measure),
    },
    Study {
        name: "hard-cases", about: "Measure on the host what breaks dynamics codes, rewrite docs/hard-cases.md",
        files: &["docs/hard-cases.md", "docs/hard-cases.svg"],
        held: Step(Host, Full, "every hard case holds, and docs/hard-cases.md has today's figures"),
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

#[cfg(test)]
mod tests {
    use super::STUDIES;
    use super::study::Held;
    use crate::kit::docs::repository::{read, root};

    /// The files that no study writes: those of the demo, which the step `readme` compares, and the
    /// film, which a test of its program compares.
    const OF_THE_DEMO: [&str; 4] =
        ["README.md", "docs/scenes.md", "docs/film.svg", "docs/ur5e.svg"];

    fn below(directory: &str) -> Vec<String> {
        let entries = std::fs::read_dir(root().join(directory)).expect("a directory");
        let each = entries.flatten().flat_map(|entry| {
            let name = format!("{directory}/{}", entry.file_name().to_string_lossy());
            match entry.path().is_dir() {
                true => below(&name),
                false => vec![name],
            }
        });
        each.collect()
    }

    /// Whether a command writes it: all data and pictures, and pages that say so.
    fn is_generated(name: &str) -> bool {
        !name.ends_with(".md") || read(name).contains("<!-- written by `")
    }

    #[test]
    fn every_generated_file_belongs_to_a_study_that_is_held() {
        let mut there = below("docs");
        // The guide is written by hand, its programs included.
        there.retain(|name| !name.starts_with("docs/guide/") && is_generated(name));
        there.push("README.md".into());
        there.sort();
        let of_studies = STUDIES.iter().flat_map(|study| study.files.iter().copied());
        let mut listed: Vec<&str> = of_studies.chain(OF_THE_DEMO).collect();
        listed.sort_unstable();
        assert_eq!(there, listed);
        for study in STUDIES {
            let (Held::Step(_, _, why) | Held::Bars(why)) = study.held;
            assert!(!why.is_empty(), "{}", study.name);
        }
    }
}
