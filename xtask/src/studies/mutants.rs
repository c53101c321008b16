//! `cargo xtask mutants`: small changes to the code, and which of them no test notices.

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::process::ExitCode;

use serde::{Deserialize, Serialize};

use crate::kit::docs::{self, Page};
use crate::kit::error::{Result, check};
use crate::kit::setup::Options;
use crate::kit::table::Table;
use crate::kit::workspace::{self, Workspace};
use crate::kit::{output, shell};

const PAGE: Page<'_> = Page {
    file: "docs/mutants.md",
    name: "mutants",
    command: "cargo xtask mutants",
};
/// The rooms of which every change is taken, and their part of the page.
const WHOLE: [&str; 3] = ["safety", "motion", "estimate"];
const WHOLE_PAGE: Page<'_> = Page {
    name: "mutants-rooms",
    command: "cargo xtask mutants --rooms",
    ..PAGE
};
/// Why a change may survive, by file, function and change.
const REASONS: &str = "lab/mutants/reasons.toml";
/// The largest share of changes that may survive.
const MOST: f64 = 0.08;
const HEADS: [&str; 6] = [
    "part",
    "changes",
    "killed",
    "survived",
    "of these unreached",
    "survived, %",
];
/// Printed in place of a missing reason.
const NO_REASON: &str = "**no reason yet**";

#[derive(clap::Args)]
pub struct Args {
    /// The results as JSON on stdout; progress stays on stderr
    #[arg(long)]
    json: bool,
    /// Only changes to files whose paths begin so; the page stays as it is
    #[arg(long, value_name = "PATH")]
    only: Option<String>,
    /// Only changes that survived the last time; the others keep their verdicts
    #[arg(long)]
    survivors: bool,
    /// Only the rooms of which every change is taken, and their part of the page
    #[arg(long)]
    rooms: bool,
}

/// The verdict on a change, in the words of `lab/mutants`.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
enum Verdict {
    Killed(String),
    Survived,
    Unreached,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
struct Outcome {
    room: String,
    file: String,
    function: String,
    line: usize,
    change: String,
    operator: String,
    verdict: Verdict,
}

#[derive(Debug, Deserialize, Serialize)]
struct Results {
    tests: usize,
    unusable: Vec<String>,
    outcomes: Vec<Outcome>,
}

#[derive(Deserialize)]
struct Reasons {
    #[serde(default)]
    reason: Vec<Reason>,
}

/// A change that may survive.
#[derive(Deserialize)]
struct Reason {
    file: String,
    function: String,
    change: String,
    because: String,
}

/// Runs the changes, then writes the page and prints it.
pub fn run(_: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let results = measure(&workspace, &args)?;
    let reasons: Reasons =
        toml_edit::de::from_str(&workspace::read(&workspace.root.join(REASONS))?)
            .map_err(|e| check!("{REASONS}: {e}"))?;
    for reason in results.idle(&reasons) {
        output::note(&format!(
            "{REASONS} has a reason for a change that does not survive: {reason}"
        ));
    }
    let when = docs::today_and_commit(&workspace);
    let [rooms, sample] = [true, false].map(|whole| results.text(whole, &reasons, &when));
    if args.only.is_none() {
        WHOLE_PAGE.write(&workspace, &rooms)?;
    }
    if args.only.is_none() && !args.rooms {
        PAGE.write(&workspace, &sample)?;
    }
    let shown = match args.rooms {
        true => rooms.clone(),
        false => format!("{rooms}\n\n{sample}"),
    };
    docs::show(args.json, &results, &shown)?;
    match rooms.contains(NO_REASON) {
        true => Err(check!("a change of {WHOLE:?} survives without a reason")),
        false => Ok(ExitCode::SUCCESS),
    }
}

fn measure(workspace: &Workspace, args: &Args) -> Result<Results> {
    let mut command = workspace.cargo("run");
    command
        .args(["--quiet", "--package", "mutants", "--", "--root"])
        .arg(&workspace.root);
    command.arg("--dir").arg(workspace.target.join("mutants"));
    command.args(args.only.iter().flat_map(|only| ["--only", only]));
    command.args(args.survivors.then_some("--survivors"));
    command.args(args.rooms.then_some("--rooms"));
    let mut printed = String::new();
    shell::each_line(&mut command, |line| {
        printed += line;
        Ok(())
    })?;
    serde_json::from_str(&printed)
        .map_err(|e| check!("`mutants` printed what is not understood: {e}"))
}

impl Outcome {
    fn is_killed(&self) -> bool {
        matches!(self.verdict, Verdict::Killed(_))
    }

    fn is_of(&self, reason: &Reason) -> bool {
        let own = (&self.file, &self.function, &self.change);
        own == (&reason.file, &reason.function, &reason.change)
    }
}

impl Results {
    /// The reasons for changes that are noticed now, or that are not in the sample.
    fn idle<'a>(&self, reasons: &'a Reasons) -> Vec<&'a str> {
        let idle = reasons.reason.iter().filter(|reason| {
            let mut of_reason = self.outcomes.iter().filter(|outcome| outcome.is_of(reason));
            of_reason.next().is_some_and(Outcome::is_killed)
        });
        idle.map(|reason| &*reason.change).collect()
    }

    /// The text between the markers, of the rooms of which every change is taken or of the sample.
    fn text(&self, whole: bool, reasons: &Reasons, when: &str) -> String {
        let outcomes = self.outcomes.iter();
        let outcomes = outcomes.filter(|one| WHOLE.contains(&&*one.room) == whole);
        let all: Vec<&Outcome> = outcomes.collect();
        let mut rooms: BTreeMap<&str, Vec<&Outcome>> = BTreeMap::new();
        let mut rows: BTreeMap<String, Vec<&Outcome>> = BTreeMap::new();
        for &one in &all {
            rooms.entry(&one.room).or_default().push(one);
            let row = match whole {
                true => format!("{}, {}", one.room, one.operator),
                false => one.room.clone(),
            };
            rows.entry(row).or_default().push(one);
        }
        let counted = |(name, of): (&String, &Vec<&Outcome>)| {
            let count = |is: fn(&Outcome) -> bool| of.iter().filter(|one| is(one)).count();
            let killed = count(Outcome::is_killed);
            let unreached = count(|one| matches!(one.verdict, Verdict::Unreached));
            let survived = of.len() - killed;
            let counts = [of.len(), killed, survived, unreached].map(|count| count.to_string());
            let share = format!("{:.1}", 100.0 * share(survived, of.len()));
            [std::slice::from_ref(name), &counts[..], &[share]].concat()
        };
        let mut table = Table::new(&HEADS);
        for row in rows.iter().chain([(&"all".to_owned(), &all)]).map(counted) {
            table.row(row);
        }
        let survived = all.iter().filter(|outcome| !outcome.is_killed()).count();
        let is_met = share(survived, all.len()) <= MOST;
        let verdict = if is_met { "met" } else { "missed" };
        let (changes, tests, most) = (all.len(), self.tests, 100.0 * MOST);
        let bar = match whole {
            true => "Each of them is noticed or has its reason below.".to_owned(),
            false => format!("At most {most:.0} % may survive: {verdict}."),
        };
        let mut text = format!(
            "{changes} changes against {tests} tests, on {when}. {bar}\n\n{}",
            table.markdown()
        );
        for name in self.unusable.iter().filter(|_| !whole) {
            text += &format!(
                "\nNot used, because it fails in the copy without a change, or is too slow there: `{name}`.\n"
            );
        }
        text += if whole { "" } else { "\n## What survived\n" };
        for (room, of) in rooms {
            let survivors = of.iter().filter(|outcome| !outcome.is_killed());
            let lines: BTreeSet<String> = survivors.map(|one| line(one, reasons)).collect();
            if !lines.is_empty() {
                text += &format!("\n### {room}\n\n");
                text.extend(lines);
            }
        }
        text.trim_end().to_owned()
    }
}

fn share(part: usize, all: usize) -> f64 {
    part as f64 / all.max(1) as f64
}

fn line(outcome: &Outcome, reasons: &Reasons) -> String {
    let reason = reasons.reason.iter().find(|reason| outcome.is_of(reason));
    let reason = reason.map_or(NO_REASON, |reason| reason.because.trim());
    let unreached = match outcome.verdict {
        Verdict::Unreached => ", unreached",
        _ => "",
    };
    let (file, line, function) = (&outcome.file, outcome.line, &outcome.function);
    let change = &outcome.change;
    format!("- {file}:{line}, `{function}`{unreached}: {change}. {reason}\n")
}
