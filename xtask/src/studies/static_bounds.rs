//! `cargo xtask static`: the most cycles and the most stack that a call can take, by its machine code, beside what is measured of the rows of
//! `cargo xtask costs`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::kit::elf::Image;
use crate::kit::error::{Result, check};
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::table::{Table, thousands};
use crate::kit::toolchain::RELEASE;
use crate::kit::workspace::Workspace;
use crate::kit::{firmware, shell};
use crate::studies::cores::boards::INTERRUPT;
use crate::studies::cores::walk::Walk;
use crate::studies::costs::BINS;
use crate::studies::study::{Bench, Found};

/// What the figures hold for; the fields are those of the JSON.
#[derive(Serialize)]
struct Preconditions {
    core: &'static str,
    wait_states: u32,
    memory: &'static str,
    interrupts: &'static str,
    divider: &'static str,
}

const PRECONDITIONS: Preconditions = Preconditions {
    core: "Cortex-M4F, by the model of the cycle meter",
    wait_states: 0,
    memory: "code and constants in flash at 0x08000000, stack and variables in RAM at 0x20000000",
    interrupts: "none within the cycles; one, with the state of the FPU, within the stack",
    divider: "no division is pending at the call",
};

/// Why there is no bound: the JSON of the package `certification`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Declined {
    reason: String,
    at: u32,
}

#[derive(Deserialize)]
struct Region {
    cycles: Option<u64>,
    declined: Option<Declined>,
    branches: Vec<u32>,
}

/// A row's bounds beside what was measured; the fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
struct Bound {
    row: String,
    #[serde(skip)]
    robot: String,
    /// Whether every call executed the same number of instructions.
    constant: bool,
    measured_cycles: u64,
    cycles: Option<u64>,
    declined: Option<Declined>,
    /// The branches on data, whose longer way counts although no measured call may have taken it.
    branches: Vec<u32>,
    /// The function that the declined address is in.
    within: Option<String>,
    measured_stack: u64,
    /// With the frame that the hardware pushes on an interrupt.
    stack: Option<u64>,
    stack_declined: Option<String>,
}

#[derive(Serialize)]
struct Report {
    preconditions: Preconditions,
    rows: Vec<Bound>,
}

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let spinner = Spinner::start("building what is measured");
    let elves = firmware::build_bins(workspace, tools.toolchain, RELEASE, &BINS)?;
    let meter = firmware::build_meter(workspace)?;
    let certify = certify(workspace)?;
    let mut bounds = Vec::new();
    for (bin, elf) in BINS.iter().zip(&elves) {
        spinner.say(format!("bounding {bin}"));
        let (rows, _) = rows::run(tools, &meter, bin, elf)?;
        bounds.extend(of_bin(&certify, elf, &rows)?);
    }
    let wrong = bounds.iter().filter_map(complaint).collect();
    let summary = summary(&bounds);
    let text = format!(
        "{summary}.\n\n{}\n{}",
        robots(&bounds).markdown(),
        others(&bounds).markdown()
    );
    let report = Report {
        preconditions: PRECONDITIONS,
        rows: bounds,
    };
    Ok(Found {
        wrong,
        summary,
        rustc: Some(bench.rustc()?),
        ..Found::new(text, &report)?
    })
}

/// The program of the package `certification`, built.
fn certify(workspace: &Workspace) -> Result<PathBuf> {
    let words = ["--profile", "simulated", "--package", "certification"];
    shell::cargo(workspace.cargo("build").args(words))?;
    Ok(workspace.target.join("simulated/certify"))
}

fn of_bin(certify: &Path, elf: &Path, rows: &[Row]) -> Result<Vec<Bound>> {
    let image = Image::read(elf)?;
    let calls: Vec<String> = rows
        .iter()
        .map(|row| format!("{}:{}", row.region, row.address))
        .collect();
    let mut command = Command::new(certify);
    command
        .args(["--json", "--call", &calls.join(","), "--cycles"])
        .arg(elf);
    let regions: Vec<Region> = serde_json::from_str(&shell::capture(&mut command)?)
        .map_err(|error| check!("{}: {error}", certify.display()))?;
    let bound = |(row, region): (&Row, Region)| of_row(&image, row, region);
    Ok(rows.iter().zip(regions).map(bound).collect())
}

fn of_row(image: &Image, row: &Row, region: Region) -> Bound {
    let stack = Walk::of_start(image, row.address).map(|walk| walk.stack + INTERRUPT);
    let within = |one: &Declined| {
        let function = image.functions.iter().find(|f| f.contains(one.at.into()))?;
        function.names.first().cloned()
    };
    Bound {
        row: row.key(),
        robot: row.robot.clone(),
        constant: row.instructions.min == row.instructions.max,
        measured_cycles: row.cycles.max,
        cycles: region.cycles,
        within: region.declined.as_ref().and_then(within),
        declined: region.declined,
        branches: region.branches,
        measured_stack: row.stack_bytes,
        stack_declined: stack.as_ref().err().map(ToString::to_string),
        stack: stack.ok(),
    }
}

/// What is wrong with a row: a bound below what was measured, or above it although nothing branches on data.
fn complaint(one: &Bound) -> Option<String> {
    let (row, measured) = (&one.row, one.measured_cycles);
    if let Some(stack) = one
        .stack
        .filter(|stack| *stack < one.measured_stack + INTERRUPT)
    {
        let measured = one.measured_stack;
        return Some(format!(
            "{row}: the bound of the stack, {stack} B, is below {measured} B that were written and a frame"
        ));
    }
    let cycles = one.cycles?;
    if cycles < measured {
        return Some(format!(
            "{row}: the bound, {cycles} cycles, is below {measured} that were measured"
        ));
    }
    let is_loose = one.branches.is_empty() && cycles > measured;
    is_loose.then(|| {
        format!("{row}: the bound is {cycles} cycles without a branch on data, and at most {measured} were measured")
    })
}

/// How many rows are bounded, equal, and declined for which reason.
fn summary(bounds: &[Bound]) -> String {
    let count = |is: &dyn Fn(&&Bound) -> bool| bounds.iter().filter(is).count();
    let bounded = count(&|one| one.cycles.is_some());
    let straight = count(&|one| one.cycles.is_some() && one.branches.is_empty());
    let equal = count(&|one| one.cycles == Some(one.measured_cycles));
    let above = bounded - equal;
    let stacks = count(&|one| one.stack.is_some());
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for one in bounds.iter().filter_map(|one| one.declined.as_ref()) {
        *reasons.entry(&one.reason).or_default() += 1;
    }
    let reasons: Vec<String> = reasons
        .iter()
        .map(|(reason, n)| format!("{n} `{reason}`"))
        .collect();
    let all = bounds.len();
    format!(
        "{bounded} of {all} rows are bounded, {straight} of them without a branch on data; {equal} bounds are the measured maximum, \
         {above} are above it and none below; declined: {}; {stacks} stacks are bounded",
        if reasons.is_empty() {
            "none".to_owned()
        } else {
            reasons.join(", ")
        }
    )
}

fn robots(bounds: &[Bound]) -> Table {
    let robots: Vec<&[Bound]> = bounds.chunk_by(|a, b| a.robot == b.robot).collect();
    let count =
        |rows: &[Bound], is: fn(&&Bound) -> bool| rows.iter().filter(is).count().to_string();
    let most =
        |rows: &[Bound], of: fn(&Bound) -> u64| thousands(rows.iter().map(of).max().unwrap_or(0));
    Table::of(
        &robots,
        &[
            ("robot", &|rows| rows[0].robot.clone()),
            ("rows", &|rows| rows.len().to_string()),
            ("constant", &|rows| count(rows, |one| one.constant)),
            ("bounded", &|rows| count(rows, |one| one.cycles.is_some())),
            ("equal", &|rows| {
                count(rows, |one| one.cycles == Some(one.measured_cycles))
            }),
            ("declined", &|rows| {
                count(rows, |one| one.declined.is_some())
            }),
            ("largest stack written, B", &|rows| {
                most(rows, |one| one.measured_stack)
            }),
            ("largest bound with the interrupt's frame, B", &|rows| {
                most(rows, |one| one.stack.unwrap_or(0))
            }),
        ],
    )
}

/// The rows whose bound is not what was measured.
fn others(bounds: &[Bound]) -> Table {
    let is_other = |one: &&Bound| one.cycles != Some(one.measured_cycles);
    let others: Vec<&Bound> = bounds.iter().filter(is_other).collect();
    Table::of(
        &others,
        &[
            ("row whose bound is not the measured maximum", &|one| {
                one.row.clone()
            }),
            ("measured", &|one| thousands(one.measured_cycles)),
            ("bound", &|one| one.cycles.map_or("–".into(), thousands)),
            ("branches on data", &|one| one.branches.len().to_string()),
            ("declined", &|one| {
                let reason = one.declined.as_ref().map(|one| format!("`{}`", one.reason));
                let within = one
                    .within
                    .as_deref()
                    .map(|name| format!(" in `{}`", short(name)));
                reason.unwrap_or_default() + &within.unwrap_or_default()
            }),
        ],
    )
}

/// The last part of a mangled path, without the hash.
fn short(name: &str) -> String {
    let mut parts = Vec::new();
    let mut rest = name.strip_prefix("_ZN").unwrap_or_default();
    while let Some(end) = rest
        .find(|c: char| !c.is_ascii_digit())
        .filter(|end| *end > 0)
    {
        let length = rest[..end].parse().unwrap_or(0);
        let Some((part, after)) = rest[end..].split_at_checked(length) else {
            break;
        };
        parts.push(part);
        rest = after;
    }
    let last = parts.iter().rev().nth(1);
    last.map_or(name, |part| *part).to_owned()
}

#[cfg(test)]
mod tests {
    use super::{Bound, Declined, complaint, summary};

    fn bound(cycles: Option<u64>, branches: &[u32]) -> Bound {
        Bound {
            row: "arm rnea engine full".into(),
            robot: "arm".into(),
            constant: true,
            measured_cycles: 100,
            declined: cycles.is_none().then(|| Declined {
                reason: "loop".into(),
                at: 0x0800_0000,
            }),
            cycles,
            branches: branches.to_vec(),
            within: None,
            measured_stack: 64,
            stack: Some(64 + 108),
            stack_declined: None,
        }
    }

    #[test]
    fn a_bound_that_is_wrong_by_one_is_rejected() {
        assert_eq!(complaint(&bound(Some(100), &[])), None);
        assert_eq!(complaint(&bound(Some(101), &[0x0800_0000])), None);
        assert_eq!(complaint(&bound(None, &[])), None);
        let said = |one: &Bound| complaint(one).unwrap_or_default();
        assert!(said(&bound(Some(99), &[0x0800_0000])).contains("below"));
        assert!(said(&bound(Some(101), &[])).contains("without a branch"));
        let shallow = Bound {
            stack: Some(64 + 107),
            ..bound(Some(100), &[])
        };
        assert!(said(&shallow).contains("stack"));
        let text = summary(&[bound(Some(100), &[]), bound(None, &[])]);
        assert!(
            text.starts_with("1 of 2") && text.contains("1 `loop`"),
            "{text}"
        );
    }
}
