//! The bounds of cycles and stack of measured rows beside what was measured: what `cargo xtask static` runs.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use crate::cycles::{self, Declined};
use crate::error::{Error, Result};
use crate::image::Image;
use crate::stack::{self, INTERRUPT_FRAME};

/// A row of `docs/costs.md`.
#[derive(Clone, Debug, Deserialize)]
pub struct Measured {
    /// Robot, algorithm, form and effects.
    pub row: String,
    /// The fewest and the most cycles of its calls.
    pub cycles: [u64; 2],
    /// The stack that its calls wrote to.
    pub stack: u64,
    /// The address of the function.
    pub function: u32,
    /// The address of the mark that opens the measured region.
    pub region: u32,
}

/// What bounds hold for; it is part of the JSON.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Preconditions {
    core: &'static str,
    wait_states: u32,
    memory: &'static str,
    interrupts: &'static str,
    divider: &'static str,
    pointers: &'static str,
    copies: &'static str,
}

impl Preconditions {
    /// Each with its name.
    pub fn named(&self) -> [(&'static str, &'static str); 6] {
        [
            ("core", self.core),
            ("memory", self.memory),
            ("interrupts", self.interrupts),
            ("divider", self.divider),
            ("pointers", self.pointers),
            ("copies", self.copies),
        ]
    }
}

/// What every bound of cycles and stack holds for.
pub const PRECONDITIONS: Preconditions = Preconditions {
    core: "Cortex-M4F without wait states, by the model of the cycle meter",
    wait_states: 0,
    memory: "code and constants in flash at 0x08000000, stack and variables in RAM at 0x20000000",
    interrupts: "none within the cycles; one, with the state of the FPU, within the stack",
    divider: "no division is pending at the call",
    pointers: "a pointer that the caller gives reaches no word of the stack that the compiler keeps for itself",
    copies: "what is copied and cleared at once, by `memcpy` and its kin, lies at multiples of four",
};

/// A row's bounds.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    row: String,
    measured: [u64; 2],
    /// The most cycles of the measured region.
    cycles: Option<u64>,
    declined: Option<Declined>,
    /// The function that the declined address is in.
    within: Option<String>,
    /// The branches on data, of which the longer way counts although no measured call may have taken it.
    branches: Vec<u32>,
    stack_written: u64,
    /// With the frame that the hardware pushes on an interrupt.
    stack: Option<u64>,
    stack_declined: Option<Declined>,
}

/// The bounds of some rows, as text and as data.
#[derive(Serialize)]
pub struct Report {
    preconditions: Preconditions,
    rows: Vec<Row>,
    /// Bounds that contradict what was measured.
    pub wrong: Vec<String>,
    /// Their numbers, in a sentence.
    pub summary: String,
    /// The part of the page.
    pub text: String,
}

/// The bound of a measured row of a program.
///
/// # Errors
/// [`Error::Missing`] if there is no such region.
pub fn bound(image: &Image, of: Measured) -> Result<Row> {
    let missing = || Error::Missing(format!("measured region at {:#x}", of.region));
    let region = cycles::region(image, of.region, Some(of.function)).ok_or_else(missing)?;
    let stack = stack::stack(image, of.function);
    let declined = region.cycles.err();
    Ok(Row {
        row: of.row,
        measured: of.cycles,
        cycles: region.cycles.ok(),
        within: declined.and_then(|one| image.name(one.at())),
        declined,
        branches: region.branches,
        stack_written: of.stack,
        stack_declined: stack.err(),
        stack: stack.ok(),
    })
}

impl Row {
    /// Whether the bound is what was measured.
    fn is_equal(&self) -> bool {
        self.cycles == Some(self.measured[1])
    }

    /// What is wrong with it: a bound below what was measured, or above it although nothing branches on data.
    fn complaint(&self) -> Option<String> {
        let (row, [_, most], written) = (&self.row, self.measured, self.stack_written);
        if let Some(stack) = self
            .stack
            .filter(|bytes| *bytes < written + INTERRUPT_FRAME)
        {
            return Some(format!(
                "{row}: the bound of the stack, {stack} B, is below {written} B that were written and a frame"
            ));
        }
        let cycles = self.cycles?;
        if cycles < most {
            return Some(format!(
                "{row}: the bound, {cycles} cycles, is below {most} that were measured"
            ));
        }
        (self.branches.is_empty() && cycles > most).then(|| {
            format!("{row}: the bound is {cycles} cycles without a branch on data, and {most} were measured")
        })
    }
}

impl Report {
    /// Of rows in their order.
    pub fn of(rows: Vec<Row>) -> Self {
        let summary = summary(&rows);
        Self {
            preconditions: PRECONDITIONS,
            wrong: rows.iter().filter_map(Row::complaint).collect(),
            text: format!("{summary}.\n\n{}{}", above(&rows), declined(&rows)),
            summary,
            rows,
        }
    }
}

/// How many rows are bounded, equal, and declined for which reason.
fn summary(rows: &[Row]) -> String {
    let count = |is: &dyn Fn(&&Row) -> bool| rows.iter().filter(is).count();
    let bounded = count(&|one| one.cycles.is_some());
    let straight = count(&|one| one.cycles.is_some() && one.branches.is_empty());
    let (equal, stacks) = (
        count(&|one| one.is_equal()),
        count(&|one| one.stack.is_some()),
    );
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for one in rows.iter().filter_map(|one| one.declined) {
        *reasons.entry(one.name()).or_default() += 1;
    }
    let reasons: Vec<String> = reasons
        .iter()
        .map(|(reason, n)| format!("{n} `{reason}`"))
        .collect();
    format!(
        "Of {} rows {bounded} are bounded; {straight} of them have no branch on data, and their bound is what every call takes. {equal} bounds \
         are the measured maximum, {} are above it and none below. Declined: {}. {stacks} stacks are bounded",
        rows.len(),
        bounded - equal,
        if reasons.is_empty() {
            "none".to_owned()
        } else {
            reasons.join(", ")
        },
    )
}

/// A table of the rows whose bound is above what was measured.
fn above(rows: &[Row]) -> String {
    let mut text = String::new();
    for one in rows.iter().filter(|one| !one.is_equal()) {
        let Some(cycles) = one.cycles else { continue };
        let share = 100.0 * (cycles as f64 / one.measured[1] as f64 - 1.0);
        let _ = writeln!(
            text,
            "| {} | {} | {cycles} | {share:.1} % | {} |",
            one.row,
            one.measured[1],
            one.branches.len()
        );
    }
    match text.is_empty() {
        true => text,
        false => format!(
            "| row whose bound is above what was measured | most measured | bound | above | branches on data |\n|---|---|---|---|---|\n{text}\n"
        ),
    }
}

/// A table of the rows without a bound, those of the same reason and function together.
fn declined(rows: &[Row]) -> String {
    let mut groups: BTreeMap<(&str, &str), Vec<&str>> = BTreeMap::new();
    for one in rows {
        if let Some(declined) = one.declined {
            let within = one.within.as_deref().unwrap_or("–");
            let rows = groups.entry((declined.name(), within)).or_default();
            rows.push(&one.row);
        }
    }
    let mut text = String::new();
    for ((reason, within), rows) in groups {
        let _ = writeln!(text, "| `{reason}` in `{within}` | {} |", rows.join(", "));
    }
    match text.is_empty() {
        true => text,
        false => format!("| declined | rows |\n|---|---|\n{text}"),
    }
}
