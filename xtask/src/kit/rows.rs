//! The costs of the firmware's functions: runs bins that announce their calls under the meter and
//! cuts its samples by their logs.

use std::path::{Path, PathBuf};

use cycle_meter::Sample;
use serde::Serialize;

use crate::kit::callgraph::Reach;
use crate::kit::elf::{Image, is_panic};
use crate::kit::error::{Result, bail, check};
use crate::kit::firmware;
use crate::kit::meter::{self, Cost, Spread};
use crate::kit::progress::Spinner;
use crate::kit::qemu::Run;
use crate::kit::setup::Tools;
use crate::kit::workspace::Workspace;

/// The cost of a function; the fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub robot: String,
    /// `rnea`, `aba` …
    pub algorithm: String,
    /// `core` or `engine`.
    pub form: String,
    /// The effects: `full`, `bias`, `gravity`, `no_coriolis`.
    pub inputs: String,
    /// Whether sines and cosines are computed inside.
    pub trig: bool,
    #[serde(skip)]
    pub joints: usize,
    /// Instructions of a call, exact.
    pub instructions: Spread,
    /// Modelled cycles of a call.
    pub cycles: Spread,
    /// The same from the flash of each of [`meter::CHIPS`].
    pub in_flash: [Spread; 2],
    /// The mean of the cycles: what a call of those costs that take turns.
    #[serde(skip)]
    pub cycles_mean: f64,
    /// Floating-point operations of the longest call, exact.
    pub flops: u64,
    /// Instructions and literals of the function and of all that it calls, but for library
    /// functions of trigonometry.
    pub code_bytes: u64,
    /// Stack that it and all that it calls write to.
    pub stack_bytes: u64,
    #[serde(skip)]
    pub address: u64,
}

impl Row {
    /// A row for tests, of robot, algorithm, form and inputs, with sines and cosines computed
    /// inside.
    pub fn sample([robot, algorithm, form, inputs]: [&str; 4], cycles: u64) -> Self {
        let spread = Spread { min: cycles, median: cycles, max: cycles };
        Self {
            robot: robot.into(),
            algorithm: algorithm.into(),
            form: form.into(),
            inputs: inputs.into(),
            trig: true,
            joints: 1,
            instructions: spread,
            cycles: spread,
            in_flash: [spread; 2],
            cycles_mean: 0.0,
            flops: 0,
            code_bytes: 0,
            stack_bytes: 0,
            address: 0,
        }
    }
}

impl Row {
    pub fn key(&self) -> String {
        let trig = if self.trig { " trig" } else { "" };
        format!("{} {} {} {}{trig}", self.robot, self.algorithm, self.form, self.inputs)
    }
}

/// Builds these bins in a profile, runs each of them under the meter, and returns their rows in
/// order.
pub fn measure(
    workspace: &Workspace,
    tools: &Tools,
    profile: &str,
    bins: &[&'static str],
) -> Result<Vec<Row>> {
    let building = Spinner::start(&format!("building {} ({profile})", bins.join(", ")));
    let elves = firmware::build_bins(workspace, tools.toolchain, profile, bins)?;
    drop(building);
    Ok(run_all(workspace, tools, bins, &elves)?.0)
}

/// Runs bins under the meter; returns their rows in order, and their logs.
pub fn run_all(
    workspace: &Workspace,
    tools: &Tools,
    bins: &[&'static str],
    elves: &[PathBuf],
) -> Result<(Vec<Row>, Vec<String>)> {
    let spinner = Spinner::start("building the cycle meter");
    let meter = firmware::build_meter(workspace)?;
    let (mut rows, mut log) = (Vec::new(), Vec::new());
    for (name, elf) in bins.iter().zip(elves) {
        spinner.say(format!("running {name} in QEMU"));
        let (mine, lines) = run(tools, &meter, name, elf)?;
        rows.extend(mine);
        log.extend(lines);
    }
    Ok((rows, log))
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
    let rows =
        cut(&lines, &samples, |address| code_bytes(&image, address, |name| name.contains("libm")))?;
    Ok((rows, lines))
}

/// Runs a bin under the meter for what its rows take, not how long their code is: of code that
/// calls through registers nobody knows.
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
    let run = Run::logging(name, elf, Some((meter, &regions)));
    Ok((tools.qemu.lines(&run)?, meter::read(&regions)?))
}

/// The rows that a log announces, each with its share of the samples.
fn cut(
    lines: &[String],
    mut samples: &[Sample],
    code_bytes: impl Fn(u64) -> Result<u64>,
) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for line in lines {
        let words: Vec<&str> = line.split(' ').collect();
        let ["config", robot, algorithm, form, inputs, ref numbers @ ..] = *words else {
            continue;
        };
        let numbers = numbers.iter().map(|word| word.parse());
        let numbers = numbers.collect::<std::result::Result<Vec<u64>, _>>();
        let Ok(&[trig, joints, states, address, stack_bytes]) = numbers.as_deref() else {
            bail!("the firmware's line {line:?} cannot be understood");
        };
        let (mine, rest) = samples
            .split_at_checked(states as usize)
            .ok_or_else(|| check!("the cycle meter saw fewer calls than the firmware made"))?;
        samples = rest;
        let cost = Cost::of(mine.iter().map(meter::passage))?;
        let cycles = mine.iter().map(|sample| sample.cycles);
        rows.push(Row {
            robot: robot.into(),
            algorithm: algorithm.into(),
            form: form.into(),
            inputs: inputs.into(),
            trig: trig != 0,
            joints: joints as usize,
            instructions: cost.instructions,
            cycles: cost.cycles,
            in_flash: cost.in_flash,
            cycles_mean: cycles.sum::<u64>() as f64 / mine.len() as f64,
            flops: mine.iter().map(|sample| sample.flops).max().unwrap_or(0),
            code_bytes: code_bytes(address)?,
            stack_bytes,
            address,
        });
    }
    if rows.is_empty() || !samples.is_empty() {
        bail!("the cycle meter saw more calls than the firmware announced");
    }
    Ok(rows)
}

/// Instructions and literals of the function at an address and of all that it calls, but for those
/// that are left out by their names.
pub fn code_bytes(image: &Image, address: u64, left_out: impl Fn(&str) -> bool) -> Result<u64> {
    if !image.functions.iter().any(|f| f.address == address) {
        bail!("the firmware has no function at {address:#x}");
    }
    let reach = Reach::of(image, |f| f.address == address)?;
    for (function, path) in reach.functions() {
        if let Some(name) = function.names.iter().find(|name| is_panic(name)) {
            bail!("the function at {address:#x} reaches `{name}`: {path}");
        }
    }
    let functions = reach.functions();
    let counted = functions.filter(|(f, _)| !f.names.iter().any(|name| left_out(name)));
    Ok(counted.map(|(f, _)| f.bytes.len() as u64).sum())
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::cut;

    #[test]
    fn samples_go_to_the_rows_that_announced_them() {
        let samples = [1, 2, 3].map(|n| Sample::of(0, [n, 10 * n, 100 * n]));
        let lines = [
            "config ur5e rnea core full 1 6 1 4096 128",
            "hello",
            "config ur5e rnea engine gravity 0 6 2 8192 64",
            "done",
        ]
        .map(str::to_owned);
        let rows = cut(&lines, &samples, |address| Ok(address / 2)).expect("enough samples");
        let found: Vec<_> = rows
            .iter()
            .map(|row| {
                let costs = (row.instructions.min, row.cycles.max, row.flops);
                (row.key(), costs, row.code_bytes, row.stack_bytes)
            })
            .collect();
        assert_eq!(
            found,
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
