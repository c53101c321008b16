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
/// The rooms of which every change is taken.
const WHOLE_PAGE: Page<'_> = Page {
    file: "docs/mutants.md",
    name: "mutants-rooms",
    command: "cargo xtask mutants --rooms",
};
const WHOLE: [&str; 3] = ["safety", "motion", "estimate"];
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
    let (rooms, open) = results.of_rooms(true).whole_text(&reasons, &when);
    let sample = results.of_rooms(false).text(&reasons, &when);
    if args.only.is_none() {
        WHOLE_PAGE.write(&workspace, &rooms)?;
        if !args.rooms {
            PAGE.write(&workspace, &sample)?;
        }
    }
    docs::show(args.json, &results, &[&*rooms, "\n\n", &sample].concat())?;
    match open {
        0 => Ok(ExitCode::SUCCESS),
        _ => Err(check!(
            "{open} changes survive without a reason in {}",
            WHOLE.join(", ")
        )),
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

    /// Those of the rooms of which every change is taken, or of the others.
    fn of_rooms(&self, whole: bool) -> Self {
        let is_one = |outcome: &&Outcome| WHOLE.contains(&&*outcome.room) == whole;
        Self {
            tests: self.tests,
            unusable: self.unusable.clone(),
            outcomes: self.outcomes.iter().filter(is_one).cloned().collect(),
        }
    }

    fn by(&self, name: impl Fn(&Outcome) -> String) -> BTreeMap<String, Vec<&Outcome>> {
        let mut by: BTreeMap<String, Vec<&Outcome>> = BTreeMap::new();
        for outcome in &self.outcomes {
            by.entry(name(outcome)).or_default().push(outcome);
        }
        by
    }

    /// The text of the rooms of which every change is taken, and how many survive without a reason.
    fn whole_text(&self, reasons: &Reasons, when: &str) -> (String, usize) {
        let has_none = |one: &&Outcome| !reasons.reason.iter().any(|reason| one.is_of(reason));
        let survivors = self.outcomes.iter().filter(|one| !one.is_killed());
        let open = survivors.filter(has_none).count();
        let verdict = if open == 0 { "met" } else { "missed" };
        let text = format!(
            "{} changes, every statement among them, on {when}. None may survive without a reason: {verdict}.\n\n{}{}",
            self.outcomes.len(),
            self.table(|one| format!("{}: {}", one.room, one.operator))
                .markdown(),
            self.survivors(reasons)
        );
        (text.trim_end().to_owned(), open)
    }

    fn table(&self, name: impl Fn(&Outcome) -> String) -> Table {
        let all: Vec<&Outcome> = self.outcomes.iter().collect();
        let counted = |(name, of): (&String, &Vec<&Outcome>)| {
            let count = |is: fn(&Outcome) -> bool| of.iter().filter(|one| is(one)).count();
            let killed = count(Outcome::is_killed);
            let unreached = count(|one| matches!(one.verdict, Verdict::Unreached));
            let survived = of.len() - killed;
            let counts = [of.len(), killed, survived, unreached].map(|count| count.to_string());
            let share = format!("{:.1}", 100.0 * share(survived, of.len()));
            [&[name.to_string()], &counts[..], &[share]].concat()
        };
        let mut table = Table::new(&HEADS);
        let last = ("all".to_owned(), all);
        for row in self
            .by(name)
            .iter()
            .chain([(&last.0, &last.1)])
            .map(counted)
        {
            table.row(row);
        }
        table
    }

    /// The text between the markers.
    fn text(&self, reasons: &Reasons, when: &str) -> String {
        let changes = self.outcomes.len();
        let survived = self
            .outcomes
            .iter()
            .filter(|outcome| !outcome.is_killed())
            .count();
        let is_met = share(survived, changes) <= MOST;
        let verdict = if is_met { "met" } else { "missed" };
        let (tests, most) = (self.tests, 100.0 * MOST);
        let mut text = format!(
            "{changes} changes against {tests} tests, on {when}. At most {most:.0} % may survive: {verdict}.\n\n{}",
            self.table(|one| one.room.clone()).markdown()
        );
        for name in &self.unusable {
            text += &format!(
                "\nNot used, because it fails in the copy without a change, or is too slow there: `{name}`.\n"
            );
        }
        text += "\n## What survived\n";
        text += &self.survivors(reasons);
        text.trim_end().to_owned()
    }

    fn survivors(&self, reasons: &Reasons) -> String {
        let mut text = String::new();
        for (room, of) in self.by(|one| one.room.clone()) {
            let survivors = of.iter().filter(|outcome| !outcome.is_killed());
            let lines: BTreeSet<String> = survivors.map(|one| line(one, reasons)).collect();
            if !lines.is_empty() {
                text += &format!("\n### {room}\n\n");
                text.extend(lines);
            }
        }
        text
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
