//! The sheet of a robot: one page of what is proven and observed of its functions, of what they take on the target, and of what is assumed.

use std::fmt::Write as _;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::certificate::{self, Certificate, Function};
use crate::cycles::{self, Declined};
use crate::emulation::Emulation;
use crate::error::{Error, Result};
use crate::image::Image;
use crate::limits::Limits;
use crate::page::{accelerations, ranges, short};
use crate::preconditions::{PRECONDITIONS, Preconditions};
use crate::search::Evaluation;
use crate::stack::{self, INTERRUPT_FRAME};
use crate::state_box::Robot;

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

/// What a call of a function takes on the target.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Target {
    /// The fewest and the most cycles of the calls in QEMU, or why there were none.
    #[serde(with = "untagged")]
    pub measured: std::result::Result<[u64; 2], String>,
    /// The number of these calls.
    pub states: usize,
    /// The most cycles of any call by the machine code, or why they have no bound.
    #[serde(with = "untagged")]
    pub bound: std::result::Result<u64, Declined>,
    /// The branches on data in it.
    pub branches: Vec<u32>,
    /// The most stack with the frame of an interrupt, or why it has no bound.
    #[serde(with = "untagged")]
    pub stack: std::result::Result<u64, Declined>,
}

/// A result as JSON: what it is, or why it is not.
mod untagged {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<T: Serialize, E: Serialize, S: Serializer>(
        one: &Result<T, E>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        match one {
            Ok(value) => value.serialize(to),
            Err(why) => why.serialize(to),
        }
    }

    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Either<T, E> {
        Value(T),
        Why(E),
    }

    pub fn deserialize<'de, T: Deserialize<'de>, E: Deserialize<'de>, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Result<T, E>, D::Error> {
        Ok(match Either::deserialize(from)? {
            Either::Value(value) => Ok(value),
            Either::Why(why) => Err(why),
        })
    }
}

impl Target {
    /// Of a function of a program that was run, or was not for a reason. The calls must take what the machine code says, and results must
    /// have the bits that the host computes.
    ///
    /// # Errors
    /// [`Error::Cycles`], [`Error::Bits`], [`Error::Missing`].
    pub fn of(
        image: &Image,
        function: Function,
        robot: &Robot,
        emulation: &std::result::Result<Emulation, String>,
    ) -> Result<Self> {
        let key = function.to_possible_value();
        let key = key.as_ref().map_or("", |value| value.get_name());
        let address = certificate::address(image, function)?;
        let calls: Vec<_> = emulation.iter().flat_map(|run| run.of(key)).collect();
        let cycles = calls.iter().map(|(sample, _)| sample.cycles);
        let measured = match (emulation, cycles.clone().min(), cycles.max()) {
            (_, Some(least), Some(most)) => Ok([least, most]),
            (Err(why), ..) => Err(why.clone()),
            _ => Err("the program does not call it".to_owned()),
        };
        let region = calls.first().map(|(sample, _)| sample.at);
        let region = region.and_then(|at| cycles::region(image, at, Some(address)));
        let bound = region.unwrap_or_else(|| cycles::function(image, address));
        let target = Self {
            measured,
            states: calls.len(),
            bound: bound.cycles,
            branches: bound.branches,
            stack: stack::stack(image, address),
        };
        target.check(function)?;
        if let Ok(run) = emulation {
            let results = calls.iter().map(|(_, bits)| *bits);
            same_bits(image, function, robot, &run.states, results)?;
        }
        Ok(target)
    }

    fn check(&self, function: Function) -> Result<()> {
        let (Ok([least, most]), Ok(bound)) = (&self.measured, self.bound) else {
            return Ok(());
        };
        let is_loose = self.branches.is_empty() && (bound != *most || bound != *least);
        if bound < *most || is_loose {
            return Err(Error::Cycles {
                function: function.name(),
                bound,
                least: *least,
                most: *most,
            });
        }
        Ok(())
    }

    /// In a sentence.
    pub fn sentence(&self) -> String {
        let [measured, bound, stack, bits] = self.figures();
        format!("Cycles: {measured}; static bound: {bound}. Stack: {stack}. Bits: {bits}.")
    }

    /// What was measured, the bounds of cycles and stack, and whether the bits are the host's.
    fn figures(&self) -> [String; 4] {
        let states = self.states;
        let measured = match &self.measured {
            Ok([least, most]) => format!("{least} to {most} in QEMU at {states} states"),
            Err(why) => format!("not measured ({why})"),
        };
        let of = match states {
            0 => ", from its first instruction to its return",
            _ => "",
        };
        let bound = match self.bound {
            Ok(cycles) if self.branches.is_empty() => {
                format!("{cycles} of every call{of}: the code has no branch on data")
            }
            Ok(cycles) => format!(
                "at most {cycles}{of}, with {} branches on data",
                self.branches.len()
            ),
            Err(declined) => format!("none: {declined}"),
        };
        let stack = match self.stack {
            Ok(bytes) => format!("at most {bytes} B, of them {INTERRUPT_FRAME} B for an interrupt"),
            Err(declined) => format!("no bound: {declined}"),
        };
        let bits = match states {
            0 => "not compared".to_owned(),
            _ => {
                format!("QEMU's at {states} states are those of the proven expression on the host")
            }
        };
        [measured, bound, stack, bits]
    }
}

/// Fails unless each result has the bits of the function's expression on the host.
fn same_bits<'a>(
    image: &Image,
    function: Function,
    robot: &Robot,
    states: &[Vec<f64>],
    results: impl Iterator<Item = &'a [u32]>,
) -> Result<()> {
    let graph = certificate::expression(image, function)?.graph;
    let mut evaluation = Evaluation::new(&graph, robot);
    for (number, (state, bits)) in states.iter().zip(results).enumerate() {
        let host = evaluation.at(state).map(|(single, _)| single.to_bits());
        for ((offset, _), host) in graph.outputs.iter().zip(host) {
            let result = *offset as usize / 4;
            let target = bits.get(result).copied();
            let target = target.ok_or_else(|| Error::Missing(format!("result {}", result + 1)))?;
            if target != host {
                return Err(Error::Bits {
                    function: function.name(),
                    state: number + 1,
                    result: result + 1,
                    target,
                    host,
                });
            }
        }
    }
    Ok(())
}

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
    /// Of some certificates of one robot, and of what is proven of the robot itself; nothing of none.
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
