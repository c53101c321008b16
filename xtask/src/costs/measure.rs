//! Runs the firmware's bins `costs_…` and `forward_…` under the meter and cuts its samples by their logs.

use std::path::Path;

use cycle_meter::Sample;
use serde::Serialize;

use crate::callgraph::Reach;
use crate::elf::Image;
use crate::error::{Error, Result};
use crate::firmware;
use crate::meter::{self, Cost, Spread};
use crate::progress::Spinner;
use crate::qemu::Run;
use crate::setup::Tools;
use crate::toolchain::{RELEASE, SMALL};
use crate::workspace::Workspace;

/// Two bins for each robot, inverse dynamics and the rest: the compiler builds them side by side.
const BINS: [&str; 8] = [
    "costs_ur5e",
    "forward_ur5e",
    "costs_panda",
    "forward_panda",
    "costs_iiwa14",
    "forward_iiwa14",
    "costs_a1",
    "forward_a1",
];

/// What a function costs; the fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The robot's name.
    pub robot: String,
    /// `rnea`, `aba` …
    pub algorithm: String,
    /// `core` or `engine`.
    pub form: String,
    /// Which effects: `full`, `bias`, `gravity`, `no_coriolis`.
    pub inputs: String,
    /// Whether sines and cosines are computed inside.
    pub trig: bool,
    /// Joints.
    #[serde(skip)]
    pub joints: usize,
    /// Instructions of a call, exact.
    pub instructions: Spread,
    /// Modelled cycles of a call.
    pub cycles: Spread,
    /// Their mean: what a call of those costs that take turns.
    #[serde(skip)]
    pub cycles_mean: f64,
    /// Floating-point operations of the longest call, exact.
    pub flops: u64,
    /// Instructions and literals of the function and of all that it calls, but for library
    /// functions of trigonometry.
    pub code_bytes: u64,
    /// Stack that it and all that it calls write to.
    pub stack_bytes: u64,
    /// Where the function lies.
    #[serde(skip)]
    pub address: u64,
}

impl Row {
    /// Its name in budgets.
    pub fn key(&self) -> String {
        let trig = if self.trig { " trig" } else { "" };
        format!(
            "{} {} {} {}{trig}",
            self.robot, self.algorithm, self.form, self.inputs
        )
    }
}

/// Builds the bins, runs each of them, and returns their rows in order.
pub fn all(workspace: &Workspace, tools: &Tools) -> Result<Vec<Row>> {
    measure(workspace, tools, RELEASE, &BINS)
}

/// The rows of the first robot.
pub fn first(workspace: &Workspace, tools: &Tools) -> Result<Vec<Row>> {
    measure(workspace, tools, RELEASE, &BINS[..2])
}

/// The engine's rows of inverse dynamics of the first robot in a firmware that is built for size.
pub fn small(workspace: &Workspace, tools: &Tools) -> Result<Vec<Row>> {
    let mut rows = measure(workspace, tools, SMALL, &BINS[..1])?;
    rows.retain(|row| row.form == "engine");
    Ok(rows)
}

/// Builds these bins in a profile, runs each of them under the meter, and returns their rows in order.
pub fn measure(
    workspace: &Workspace,
    tools: &Tools,
    profile: &str,
    bins: &[&'static str],
) -> Result<Vec<Row>> {
    let spinner = Spinner::start(&format!("building {} ({profile})", bins.join(", ")));
    let elves = firmware::build_bins(workspace, tools.toolchain, profile, bins)?;
    spinner.say("building the cycle meter".into());
    let meter = firmware::build_meter(workspace)?;
    let mut rows = Vec::new();
    for (name, elf) in bins.iter().zip(elves) {
        spinner.say(format!("running {name} in QEMU"));
        rows.extend(run(tools, &meter, name, &elf)?.0);
    }
    Ok(rows)
}

/// Runs a bin under the meter; returns its rows in order, and its log.
pub fn run(
    tools: &Tools,
    meter: &Path,
    name: &'static str,
    elf: &Path,
) -> Result<(Vec<Row>, Vec<String>)> {
    let image = Image::read(elf)?;
    let (lines, samples) = watch(tools, meter, name, elf)?;
    let rows = cut(&lines, &samples, |address| code_bytes(&image, address))?;
    Ok((rows, lines))
}

/// Runs a bin under the meter for what its rows take, not how long their code is: of code that calls through
/// registers nobody knows.
pub fn run_for_time(
    tools: &Tools,
    meter: &Path,
    name: &'static str,
    elf: &Path,
) -> Result<Vec<Row>> {
    let (lines, samples) = watch(tools, meter, name, elf)?;
    cut(&lines, &samples, |_| Ok(0))
}

fn watch(
    tools: &Tools,
    meter: &Path,
    name: &'static str,
    elf: &Path,
) -> Result<(Vec<String>, Vec<Sample>)> {
    let regions = elf.with_extension("regions");
    let run = Run {
        name,
        elf,
        meter: Some((meter, &regions)),
        logs: true,
    };
    let mut lines = Vec::new();
    tools.qemu.run(&run, |line| {
        lines.push(line.to_owned());
        Ok(())
    })?;
    Ok((lines, meter::read(&regions)?))
}

/// The rows that a log announces, each with its share of the samples.
fn cut(
    lines: &[String],
    samples: &[Sample],
    code_bytes: impl Fn(u64) -> Result<u64>,
) -> Result<Vec<Row>> {
    let mut samples = samples;
    let mut rows = Vec::new();
    for line in lines {
        let words: Vec<&str> = line.split(' ').collect();
        let [
            "config",
            robot,
            algorithm,
            form,
            inputs,
            trig,
            joints,
            states,
            address,
            stack,
        ] = *words.as_slice()
        else {
            continue;
        };
        let number = |word: &str| {
            let bad =
                |_| Error::check(format!("the firmware's line {line:?} cannot be understood"));
            word.parse::<u64>().map_err(bad)
        };
        let (mine, rest) = samples
            .split_at_checked(number(states)? as usize)
            .ok_or_else(|| {
                Error::check("the cycle meter saw fewer calls than the firmware made")
            })?;
        samples = rest;
        let Cost {
            instructions,
            cycles,
        } = Cost::of(
            mine.iter().map(|sample| sample.instructions),
            mine.iter().map(|sample| sample.cycles),
        )?;
        rows.push(Row {
            robot: robot.into(),
            algorithm: algorithm.into(),
            form: form.into(),
            inputs: inputs.into(),
            trig: number(trig)? != 0,
            joints: number(joints)? as usize,
            instructions,
            cycles,
            cycles_mean: mean(mine),
            flops: mine.iter().map(|sample| sample.flops).max().unwrap_or(0),
            code_bytes: code_bytes(number(address)?)?,
            stack_bytes: number(stack)?,
            address: number(address)?,
        });
    }
    if rows.is_empty() || !samples.is_empty() {
        return Err(Error::check(
            "the cycle meter saw more calls than the firmware announced",
        ));
    }
    Ok(rows)
}

fn mean(samples: &[Sample]) -> f64 {
    let cycles: u64 = samples.iter().map(|sample| sample.cycles).sum();
    cycles as f64 / samples.len() as f64
}

/// Instructions and literals of the function at an address and of all that it calls.
fn code_bytes(image: &Image, address: u64) -> Result<u64> {
    let mut functions = image.functions.iter();
    let function = functions.find(|function| function.address == address);
    let function = function
        .ok_or_else(|| Error::check(format!("the firmware has no function at {address:#x}")))?;
    let reach = Reach::of(image, |f| f.address == function.address)?;
    let counted = reach
        .functions()
        .filter(|(function, _)| !function.names.iter().any(|name| name.contains("libm")));
    Ok(counted
        .map(|(function, _)| function.bytes.len() as u64)
        .sum())
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::cut;

    #[test]
    fn samples_go_to_the_rows_that_announced_them() {
        let samples: Vec<Sample> = (1..=3)
            .map(|n| Sample {
                region: 0,
                instructions: n,
                cycles: 10 * n,
                flops: 100 * n,
            })
            .collect();
        let lines = [
            "config ur5e rnea core full 1 6 1 4096 128",
            "hello",
            "config ur5e rnea engine gravity 0 6 2 8192 64",
            "done",
        ]
        .map(str::to_owned);
        let rows = cut(&lines, &samples, |address| Ok(address / 2)).expect("enough samples");
        let seen: Vec<_> = rows
            .iter()
            .map(|row| {
                let costs = (row.instructions.min, row.cycles.max, row.flops);
                (row.key(), costs, row.code_bytes, row.stack_bytes)
            })
            .collect();
        assert_eq!(
            seen,
            [
                ("ur5e rnea core full trig".into(), (1, 10, 100), 2048, 128),
                ("ur5e rnea engine gravity".into(), (2, 30, 300), 4096, 64),
            ]
        );
        assert!(cut(&lines, &samples[..2], |_| Ok(0)).is_err());
        assert!(cut(&lines[..2], &samples, |_| Ok(0)).is_err());
        assert!(cut(&["done".into()], &[], |_| Ok(0)).is_err());
    }
}
