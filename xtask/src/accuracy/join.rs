//! Costs from the target and errors from the host, joined by robot, kind and key.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::front;
use super::point::{Errors, Kind, Point, Speed, Yardstick};
use crate::costs::Row;
use crate::error::{Error, Result};

/// What errors are held against is known to this share of full scale and no better: smaller ones count as that.
const KNOWN: f64 = 1e-13;

/// The axis that only the target has.
const OPT: &str = "opt";

/// What the host printed.
#[derive(Default)]
pub struct Host {
    ways: Vec<Way>,
    /// What is printed to be pasted.
    pub pasted: Vec<Value>,
    /// Errors of other causes.
    pub yardsticks: Vec<Yardstick>,
    /// What leaving out velocity products loses.
    pub speeds: Vec<Speed>,
    /// How far what errors are held against is itself off, by robot.
    pub oracles: Vec<(String, Value)>,
}

/// A line about a way to compute.
#[derive(Deserialize)]
struct Way {
    robot: String,
    kind: Kind,
    key: String,
    #[serde(default)]
    plant: Option<String>,
    /// µs.
    #[serde(default)]
    step: Option<u64>,
    configuration: BTreeMap<String, String>,
    unit: String,
    full_scale: f64,
    error_max: Option<f64>,
    error_rms: Option<f64>,
    error_p99: Option<f64>,
    relative_max: Option<f64>,
    #[serde(default)]
    energy_drift_relative: Option<f64>,
    #[serde(default)]
    trajectory: Option<Joints>,
    #[serde(default)]
    states: Option<Joints>,
}

#[derive(Deserialize)]
struct Joints {
    relative_max: f64,
    joint_max: Vec<f64>,
    joint_rms: Vec<f64>,
    joint_p99: Vec<f64>,
}

impl Host {
    /// Reads the host's lines.
    pub fn read(lines: &str) -> Result<Self> {
        let mut host = Self::default();
        for line in lines.lines() {
            let bad = |e| {
                Error::check(format!(
                    "the host's line {line:?} cannot be understood: {e}"
                ))
            };
            let value: Value = serde_json::from_str(line).map_err(bad)?;
            match value["kind"].as_str().unwrap_or_default() {
                "inverse" | "simulation" => {
                    host.ways.push(serde_json::from_value(value).map_err(bad)?);
                }
                "pasted" => host.pasted.push(value),
                "yardstick" => {
                    let yardstick = serde_json::from_value(value).map_err(bad)?;
                    host.yardsticks.push(yardstick);
                }
                "oracle" => {
                    let robot = value["robot"].as_str().unwrap_or_default().to_owned();
                    host.oracles.push((robot, value));
                }
                "speed" => host
                    .speeds
                    .push(serde_json::from_value(value).map_err(bad)?),
                other => {
                    return Err(Error::check(format!(
                        "the host's line is of an unknown kind {other:?}"
                    )));
                }
            }
        }
        Ok(host)
    }
}

/// A point for each way and opt-level; `measured` are the rows of each.
pub fn join(host: &Host, measured: &[(&'static str, Vec<Row>)]) -> Result<Vec<Point>> {
    let mut known: BTreeMap<(&str, Kind, &str), Vec<&Way>> = BTreeMap::new();
    for way in &host.ways {
        let key = (&*way.robot, way.kind, &*way.key);
        known.entry(key).or_default().push(way);
    }
    let mut points = Vec::new();
    for (opt, rows) in measured {
        for row in rows {
            let kind = match &*row.algorithm {
                "inverse" => Kind::Inverse,
                "simulation" => Kind::Simulation,
                other => {
                    return Err(Error::check(format!(
                        "the firmware ran an unknown {other:?}"
                    )));
                }
            };
            let ways = known
                .get(&(&*row.robot, kind, &*row.inputs))
                .ok_or_else(|| {
                    let (robot, key) = (&row.robot, &row.inputs);
                    Error::check(format!("the host knows no error of {robot} {key}"))
                })?;
            points.extend(ways.iter().map(|way| point(way, row, opt)));
        }
    }
    front::mark(&mut points);
    Ok(points)
}

fn point(way: &Way, row: &Row, opt: &str) -> Point {
    let mut configuration = way.configuration.clone();
    configuration.insert(OPT.into(), opt.into());
    configuration.extend(
        way.plant
            .iter()
            .map(|plant| ("plant".into(), plant.clone())),
    );
    // A simulation is as good as its steps are short: what counts is a simulated second.
    let calls = way.step.map_or(1, |step| 1_000_000 / step);
    let stated = |error: Option<f64>| error.map(|error| error.max(KNOWN * way.full_scale));
    let each = way.trajectory.as_ref().map_or_else(Vec::new, |of| {
        std::iter::zip(&of.joint_max, std::iter::zip(&of.joint_rms, &of.joint_p99))
            .map(|(&max, (&rms, &p99))| Errors { max, rms, p99 })
            .collect()
    });
    Point {
        robot: way.robot.clone(),
        kind: way.kind,
        instructions: row.instructions.max * calls,
        cycles: row.cycles.max * calls,
        cycles_mean: row.cycles_mean * calls as f64,
        error_max: stated(way.error_max),
        error_rms: stated(way.error_rms),
        error_p99: stated(way.error_p99),
        unit: way.unit.clone(),
        relative_max: way.relative_max.map(|share| share.max(KNOWN)),
        front: false,
        fronts: [false; 2],
        key: key(&way.key, way.step, opt),
        configuration,
        full_scale: way.full_scale,
        joints: each,
        anywhere: way.states.as_ref().map(|states| states.relative_max),
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
        return key.to_owned();
    }
    axes.join(",")
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
        let rows = vec![row("inverse", "default"), row("simulation", "default")];
        let points = join(&host, &[("s", rows)]).expect("complete");
        assert_eq!((points[0].cycles, points[0].cycles_mean), (20, 12.5));
        assert_eq!((&*points[0].key, points[0].on("opt")), ("opt=s", "s"));
        assert!(points[0].front);
        // A thousand steps make a second.
        assert_eq!((points[1].cycles, points[1].front), (20_000, false));
        assert!(join(&host, &[("3", vec![row("inverse", "trig=new")])]).is_err());
        assert!(Host::read("{").is_err());
    }

    #[test]
    fn a_key_names_what_is_not_the_default() {
        assert_eq!(key("default", None, "3"), "default");
        assert_eq!(key("default", Some(5), "3"), "step=5");
        assert_eq!(key("trig=table", None, "z"), "trig=table,opt=z");
    }
}
