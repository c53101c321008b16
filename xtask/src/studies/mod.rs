//! The studies: each measures something and keeps a page in docs/.
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
use study::Held::Step;
use study::Lane::{Host, Target};
use study::Scope::{Everyday, Full};
use study::{Study, given};

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
