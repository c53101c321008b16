//! Costs from the target and errors from the host, joined by robot, kind and key.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::front;
use super::point::{Kind, Point};
use crate::costs::Row;
use crate::error::{Error, Result};

/// What errors are measured from is known to this share of full scale and no better: smaller ones count as that.
const KNOWN: f64 = 1e-13;

/// The axis that only the target has.
const OPT: &str = "opt";

/// What the target ran, each at its opt-level.
pub type Rows = [(&'static str, Row)];

/// What the host printed.
#[derive(Default)]
pub struct Host {
    ways: Vec<(Kind, Line)>,
    /// What is printed to be pasted.
    pub pasted: Vec<Line>,
    /// Errors of other causes.
    pub yardsticks: Vec<Line>,
    /// What leaving out velocity products loses.
    pub speeds: Vec<Line>,
    /// How far what errors are measured from is itself off.
    pub oracles: Vec<Line>,
}

/// A line; what not every kind has is empty.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Line {
    pub robot: String,
    pub kind: String,
    pub key: String,
    plant: Option<String>,
    /// µs.
    step: Option<u64>,
    configuration: BTreeMap<String, String>,
    unit: String,
    pub full_scale: f64,
    pub error_max: Option<f64>,
    pub error_rms: Option<f64>,
    pub error_p99: Option<f64>,
    pub relative_max: Option<f64>,
    energy_drift_relative: Option<f64>,
    /// The largest error over states anywhere, as a share of full scale.
    pub anywhere: Option<f64>,
    /// What is off.
    pub what: String,
    /// rad/s: no joint is faster.
    pub speed: f64,
    /// The oracle's own: Pinocchio's version, the recorded states, and those of 50 digits with how far it is off there.
    pub pinocchio: String,
    pub states: u64,
    pub sample: u64,
    pub from_50_digits: f64,
}

impl Host {
    /// Reads the host's lines.
    pub fn read(lines: &str) -> Result<Self> {
        let mut host = Self::default();
        for text in lines.lines() {
            let bad = |e: &dyn std::fmt::Display| {
                Error::check(format!(
                    "the host's line {text:?} cannot be understood: {e}"
                ))
            };
            let line: Line = serde_json::from_str(text).map_err(|e| bad(&e))?;
            match &*line.kind {
                "inverse" => host.ways.push((Kind::Inverse, line)),
                "simulation" => host.ways.push((Kind::Simulation, line)),
                "pasted" => host.pasted.push(line),
                "yardstick" => host.yardsticks.push(line),
                "oracle" => host.oracles.push(line),
                "speed" => host.speeds.push(line),
                other => return Err(bad(&format!("unknown kind {other:?}"))),
            }
        }
        Ok(host)
    }

    /// How far a robot's default is off over states anywhere, as a share of full scale.
    pub fn anywhere(&self, robot: &str) -> Option<f64> {
        let mut ways = self.ways.iter().map(|(_, line)| line);
        ways.find(|line| (&*line.robot, &*line.key) == (robot, "default"))?
            .anywhere
    }
}

impl Line {
    /// All that is said of its errors.
    pub fn errors(&self) -> [Option<f64>; 4] {
        [
            self.error_max,
            self.error_p99,
            self.error_rms,
            self.relative_max,
        ]
    }
}

/// A point for each way and opt-level; `measured` are the rows of each.
pub fn join(host: &Host, measured: &Rows) -> Result<Vec<Point>> {
    let mut points = Vec::new();
    for (opt, row) in measured {
        let of = |way: &&(Kind, Line)| {
            let Line {
                robot, kind, key, ..
            } = &way.1;
            (robot, kind, key) == (&row.robot, &row.algorithm, &row.inputs)
        };
        let before = points.len();
        let ways = host.ways.iter().filter(of);
        points.extend(ways.map(|(kind, way)| point(*kind, way, row, opt)));
        if points.len() == before {
            let (robot, kind, key) = (&row.robot, &row.algorithm, &row.inputs);
            let what = format!("the host knows no error of {robot} {kind} {key}");
            return Err(Error::check(what));
        }
    }
    front::mark(&mut points);
    Ok(points)
}

fn point(kind: Kind, way: &Line, row: &Row, opt: &str) -> Point {
    let mut configuration = way.configuration.clone();
    configuration.insert(OPT.into(), opt.into());
    let plant = way
        .plant
        .iter()
        .map(|plant| ("plant".into(), plant.clone()));
    configuration.extend(plant);
    // A simulation is as good as its steps are short: what counts is a simulated second.
    let calls = way.step.map_or(1, |step| 1_000_000 / step);
    let known = |error: Option<f64>, scale: f64| error.map(|error| error.max(KNOWN * scale));
    Point {
        robot: way.robot.clone(),
        kind,
        instructions: row.instructions.max * calls,
        cycles: row.cycles.max * calls,
        cycles_mean: row.cycles_mean * calls as f64,
        error_max: known(way.error_max, way.full_scale),
        error_rms: known(way.error_rms, way.full_scale),
        error_p99: known(way.error_p99, way.full_scale),
        relative_max: known(way.relative_max, 1.0),
        unit: way.unit.clone(),
        front: false,
        fronts: [false; 2],
        key: key(&way.key, way.step, opt),
        configuration,
        drift: way.energy_drift_relative,
    }
}

/// The key with the axes that the host's or the firmware's lacks.
fn key(key: &str, step: Option<u64>, opt: &str) -> String {
    let known = (key != "default").then(|| key.to_owned());
    let step = step.map(|step| format!("step={step}"));
    let opt = (opt != "3").then(|| format!("{OPT}={opt}"));
    let axes: Vec<String> = known.into_iter().chain(step).chain(opt).collect();
    if axes.is_empty() {
        key.to_owned()
    } else {
        axes.join(",")
    }
}

#[cfg(test)]
mod tests {
    use super::{Host, join, key};
    use crate::costs::Row;
    use crate::meter::Spread;

    fn row(algorithm: &str, inputs: &str) -> Row {
        let spread = Spread {
            min: 10,
            median: 10,
            max: 20,
        };
        Row {
            robot: "arm".into(),
            algorithm: algorithm.into(),
            form: "engine".into(),
            inputs: inputs.into(),
            trig: true,
            joints: 2,
            instructions: spread,
            cycles: spread,
            cycles_mean: 12.5,
            flops: 0,
            code_bytes: 0,
            stack_bytes: 0,
            address: 0,
        }
    }

    const LINES: &str = r#"
{"kind":"inverse","robot":"arm","plant":"rigid","key":"default","configuration":{"trig":"table3"},"unit":"N·m","full_scale":10.0,"error_max":1e-5,"error_rms":1e-6,"error_p99":9e-6,"relative_max":1e-6}
{"kind":"simulation","robot":"arm","key":"default","step":1000,"configuration":{"step":"1000"},"unit":"rad","full_scale":1.0,"error_max":null,"error_rms":null,"error_p99":null,"relative_max":null}"#;

    #[test]
    fn rows_and_lines_meet_by_robot_kind_and_key() {
        let host = Host::read(LINES.trim()).expect("good lines");
        let rows = ["inverse", "simulation"].map(|kind| ("s", row(kind, "default")));
        let points = join(&host, &rows).expect("complete");
        assert_eq!((points[0].cycles, points[0].cycles_mean), (20, 12.5));
        assert_eq!((&*points[0].key, points[0].on("opt")), ("opt=s", "s"));
        assert!(points[0].front);
        // A thousand steps make a second.
        assert_eq!((points[1].cycles, points[1].front), (20_000, false));
        assert!(join(&host, &[("3", row("inverse", "trig=new"))]).is_err());
        assert!(Host::read("{").is_err());
    }

    #[test]
    fn a_key_names_what_is_not_the_default() {
        assert_eq!(key("default", None, "3"), "default");
        assert_eq!(key("default", Some(5), "3"), "step=5");
        assert_eq!(key("trig=table", None, "z"), "trig=table,opt=z");
    }
}
