//! What is printed to be pasted is built and measured beside the ways that it was chosen for, as it is printed: it must
//! cost and err the same.

use std::fmt::Write;
use std::path::PathBuf;

use super::measure::Measured;
use super::point::Point;
use super::{code, page, recorded};
use crate::error::{Error, Result};
use crate::workspace::{self, Workspace};

/// The variable that says to the bins `accuracy_quick` where the file is.
pub const PRINTED: &str = "ACCURACY_PRINTED";
/// What the log calls its rows.
pub const ALGORITHM: &str = "pasted";

/// What is pasted may take so much more than was promised, or less, as shares: a caller gets torques in registers in
/// the one program and through memory in the other, and a function may be compiled into its caller.
const CLOSE: std::ops::RangeInclusive<f64> = 0.95..=1.02;

/// Of the UR5e, every single change that can be pasted; of the leg, one.
fn is_sample(point: &Point) -> bool {
    let all = point.robot == "ur5e" || (&*point.robot, &*point.key) == ("a1_leg", "trig=minimax7");
    all && point.on("plant") == "rigid" && page::is_single(point, usize::MAX)
}

/// Writes it, as a module for each and a visit of all of a robot's.
pub fn write(workspace: &Workspace) -> Result<PathBuf> {
    let points = recorded::read(workspace)?;
    let file = workspace.target.join("accuracy_printed.rs");
    let mut text = String::from(
        "use dynamics_core::{drivetrain::ElasticReference, state::State};\nuse firmware_demo::accuracy::{Inverse, Visitor, key::Key};\n",
    );
    for (robot, n) in [("ur5e", 6), ("panda", 7), ("a1_leg", 3)] {
        let samples = points
            .iter()
            .filter(|point| point.robot == robot && is_sample(point));
        let mut visits = String::new();
        for (i, point) in samples.enumerate() {
            let Ok(code) = code::rust(point) else {
                continue;
            };
            let way = format!("{robot}_{i}");
            text += &wrapped(point, &way, &code, n);
            visits += &format!("    visitor.way::<{way}::Way>();\n");
        }
        // Writing to a string does not fail.
        let _ = write!(
            text,
            "#[allow(unused_variables)]\npub fn {robot}(visitor: &mut impl Visitor<{n}>) {{\n{visits}}}\n"
        );
    }
    workspace::write(&file, text)?;
    Ok(file)
}

/// A module with the code as a way to compute.
fn wrapped(point: &Point, way: &str, code: &str, n: usize) -> String {
    let axes = point.key.split(',').filter_map(|axis| axis.split_once('='));
    let axes: String = axes
        .map(|(axis, value)| format!("{axis}: {value:?}, "))
        .collect();
    let ticks = code::ticks(point);
    let (state, start, tick, address) = if ticks {
        (
            "printed::Torques",
            "printed::Torques::start(first)",
            "self.0.tick(state)",
            "printed::Torques::tick as fn(&mut _, &_) -> _",
        )
    } else {
        (
            "()",
            "{ let _ = first; }",
            "printed::torques(state)",
            "printed::torques as fn(&_) -> _",
        )
    };
    let ahead = if point.on("between") == "interpolated" {
        point.on("rate")
    } else {
        "0"
    };
    format!(
        "#[allow(missing_docs, dead_code)]
mod {way} {{
mod printed {{
{code}}}
pub struct Way({state});
use super::*;
impl Inverse<{n}> for Way {{
    const KEY: Key = Key {{ {axes}..Key::DEFAULT }};
    const MEMORY: bool = {ticks};
    const AHEAD: usize = {ahead};
    type Input = State<f32, {n}, {n}>;
    type Scalar = f32;
    fn start(first: &State<f32, {n}, {n}>) -> Self {{ Self({start}) }}
    fn input(course: &ElasticReference<f32, {n}, {n}>) -> Self::Input {{ course.state }}
    #[inline(always)]
    fn tick(&mut self, state: &Self::Input) -> [f32; {n}] {{ {tick} }}
    fn address() -> usize {{ {address} as usize }}
}}
}}
"
    )
}

/// Fails unless all that is pasted reproduces its figures, errors to the bit; else says how much that is.
pub fn check(measured: &Measured) -> Result<usize> {
    let mut unlike = Vec::new();
    for row in &measured.pasted {
        let of = |point: &&Point| {
            (&*point.robot, &*point.key, point.on("plant")) == (&*row.robot, &*row.inputs, "rigid")
        };
        let point = measured.single.iter().find(of);
        let mut lines = measured.host.pasted.iter();
        let line = lines.find(|line| (&line.robot, &line.key) == (&row.robot, &row.inputs));
        let (Some(point), Some(line)) = (point, line) else {
            let what = format!(
                "{} {} is pasted, but not measured otherwise",
                row.robot, row.inputs
            );
            return Err(Error::check(what));
        };
        let found = [
            row.instructions.max as f64,
            row.cycles.max as f64,
            row.cycles_mean,
        ];
        let promised = [
            point.instructions as f64,
            point.cycles as f64,
            point.cycles_mean,
        ];
        let mut ratios = std::iter::zip(found, promised).map(|(found, promised)| found / promised);
        if !ratios.all(|ratio| CLOSE.contains(&ratio)) || line.errors() != point.errors() {
            unlike.push(format!(
                "{} {}: instructions, cycles and their mean were promised as {promised:?}, errors as {:?}, but what is \
                 pasted has {found:?} and {:?}",
                row.robot, row.inputs, point.errors(), line.errors()
            ));
        }
    }
    match (measured.pasted.len(), unlike.is_empty()) {
        (0, _) => Err(Error::check("nothing that is pasted was measured")),
        (count, true) => Ok(count),
        _ => Err(Error::check(unlike.join("\n"))),
    }
}
