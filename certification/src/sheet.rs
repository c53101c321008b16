//! The sheet of a robot: one page of what is proven and observed of its functions, of what they
//! take on the target, and of what is assumed.

use std::fmt::Write as _;

use serde::Serialize;

use crate::certificate::Certificate;
use crate::digits::short;
use crate::function::Function;
use crate::limits::Limits;
use crate::page::{accelerations, ranges};
use crate::preconditions::{PRECONDITIONS, Preconditions};
pub use crate::target::Target;

/// How the target's code is compiled.
const CONFIG: &str = include_str!("../../.cargo/config.toml");
const WORKSPACE: &str = include_str!("../../Cargo.toml");
/// What the proven errors assume; cycles and stack have preconditions of their own.
const ASSUMED: [&str; 5] = [
    "the processor rounds to nearest, even, and keeps subnormal numbers, as after a reset",
    "positions, speeds and accelerations are numbers of f32 within the box",
    "torques of forward dynamics are numbers of f32 with which no result overflows",
    "the exact function is that of the model in f64",
    "the host's `sin` and `cos` in f64 are off by less than 10⁻¹⁵",
];

/// The sheet of a robot.
#[derive(Serialize)]
pub struct Sheet<'a> {
    robot: &'a str,
    rustc: &'a str,
    flags: Vec<&'static str>,
    profile: Vec<&'static str>,
    preconditions: Preconditions,
    assumed: [&'static str; 5],
    functions: Vec<Entry<'a>>,
    limits: &'a Limits,
}

#[derive(Serialize)]
struct Entry<'a> {
    effects: &'static str,
    certificate: &'a Certificate,
}

impl<'a> Sheet<'a> {
    /// Of some certificates of one robot, and of what is proven of the robot itself; nothing of
    /// none.
    pub fn of(certificates: &'a [Certificate], limits: &'a Limits) -> Option<Self> {
        let first = certificates.first()?;
        let entry = |certificate: &'a Certificate| Entry {
            effects: effects(certificate.function),
            certificate,
        };
        Some(Self {
            robot: &first.robot,
            rustc: &first.rustc,
            flags: flags(),
            profile: profile(),
            preconditions: PRECONDITIONS,
            assumed: ASSUMED,
            functions: certificates.iter().map(entry).collect(),
            limits,
        })
    }

    /// As a page.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "# Certificate of {}\n\nCompiled by {}, {}, with {}.\n",
            self.robot,
            self.rustc,
            self.profile.join(", "),
            self.flags
                .iter()
                .map(|flag| format!("`{flag}`"))
                .collect::<Vec<_>>()
                .join(" ")
        );
        for entry in &self.functions {
            text += &function(entry);
        }
        let _ = write!(text, "\n## The robot itself\n\n{}", self.limits.markdown());
        text += "\n## What is assumed\n\n";
        for one in self.assumed {
            let _ = writeln!(text, "- Errors: {one}.");
        }
        for (what, one) in self.preconditions.named() {
            let _ = writeln!(text, "- Cycles and stack: {what}: {one}.");
        }
        text
    }
}

fn function(entry: &Entry<'_>) -> String {
    let one = entry.certificate;
    let mut text = format!("\n## {}\n\n| | |\n|---|---|\n", one.function.name());
    let mut row = |what: &str, value: &str| {
        let _ = writeln!(text, "| {what} | {} |", value.replace('|', "\\|"));
    };
    row("effects", entry.effects);
    row("SHA-256 of the machine code", &format!("`{}`", one.hash));
    row("joint box", &ranges(one));
    let operations = format!(
        "{}, {} of them rounded operations",
        one.instructions, one.operations
    );
    row("instructions", &operations);
    if let Some(target) = &one.target {
        let [measured, bound, stack, bits] = target.figures();
        row("cycles, least to most", &measured);
        row("cycles, static bound", &bound);
        row("stack", &stack);
        row("bits, host = target", &bits);
    }
    let (what, unit) = match one.function {
        one if one.is_matrix() => ("entry", "kg·m² or kg"),
        one if one.matrix().is_some() => ("result", "SI units"),
        _ => ("joint", "N·m or N"),
    };
    let _ = writeln!(
        text,
        "\n| {what} | proven error, {unit} | worst observed of {} states | range of the result |\n|---|---|---|---|",
        one.states
    );
    for output in &one.outputs {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {:.3} to {:.3} |",
            output.name,
            short(output.bound),
            short(output.observed),
            output.range.low,
            output.range.high
        );
    }
    if let Some(forward) = &one.forward {
        let rows = forward.roundings.iter().map(|row| format!("{row:?}"));
        let rows: Vec<String> = rows.collect();
        let _ = writeln!(text, "\nRoundings m, by rows: {}.\n", rows.join(", "));
        text += &accelerations(one, forward);
    }
    text
}

fn effects(function: Function) -> &'static str {
    match function {
        Function::Gravity => "gravity",
        _ => "rigid body: gravity, inertia, Coriolis and centrifugal terms",
    }
}

/// The flags of the compiler for the target.
fn flags() -> Vec<&'static str> {
    let section = CONFIG.split("[target.thumbv7em-none-eabihf]").nth(1);
    let list = section.and_then(|text| text.split("rustflags = [").nth(1));
    let list = list.and_then(|text| text.split("\n]").next());
    list.unwrap_or_default()
        .split('"')
        .skip(1)
        .step_by(2)
        .collect()
}

/// The settings of the profile `release`.
fn profile() -> Vec<&'static str> {
    let section = WORKSPACE.split("[profile.release]\n").nth(1);
    let lines = section.unwrap_or_default().lines();
    lines.take_while(|line| !line.is_empty()).collect()
}
