//! Costs from the target and errors from the host, joined by robot, kind and key.

use serde::Deserialize;
use serde_json::json;

use super::front;
use super::point::{Kind, Point};
use super::proven::Proven;
use crate::kit::error::{Result, bail, check};
use crate::kit::rows::Row;

/// The accuracy of the reference as a share of full scale: smaller errors count as that.
const KNOWN: f64 = 1e-13;

/// A row from the target, with its bin.
pub type Bin = (&'static str, Row);

#[derive(Default)]
pub struct Host {
    lines: Vec<Line>,
    /// The recorded proofs.
    pub proven: Vec<Proven>,
}

/// A line: a configuration without its costs, and what lines of other kinds than these have.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct Line {
    #[serde(skip)]
    pub point: Point,
    pub full_scale: f64,
    /// The largest error over states anywhere, as a share of full scale.
    pub anywhere: Option<f64>,
    pub what: String,
    /// The oracle's own: Pinocchio's version, the recorded states, and those of 50 digits with how
    /// far it is off there.
    pub pinocchio: String,
    pub from_50_digits: f64,
}

impl Host {
    pub fn read(lines: &str) -> Result<Self> {
        let read = |text: &str| {
            let point = serde_json::from_str(text)?;
            Ok(Line { point, ..serde_json::from_str(text)? })
        };
        let line = |text| {
            read(text).map_err(|e: serde_json::Error| {
                check!("the host's line {text:?} cannot be understood: {e}")
            })
        };
        Ok(Self { lines: lines.lines().map(line).collect::<Result<_>>()?, proven: Vec::new() })
    }

    /// The points of all lines.
    pub fn points(&mut self) -> impl Iterator<Item = &mut Point> {
        self.lines.iter_mut().map(|line| &mut line.point)
    }

    /// The lines of a kind about a robot.
    pub fn of(&self, kind: Kind, robot: &str) -> impl Iterator<Item = &Line> {
        let of = move |line: &&Line| line.point.kind == kind && line.point.robot == robot;
        self.lines.iter().filter(of)
    }

    /// The error of a robot's default over states anywhere, as a share of full scale.
    pub fn anywhere(&self, robot: &str) -> Option<f64> {
        let mut ways = self.of(Kind::Inverse, robot);
        ways.find(|line| line.point.key == "default")?.anywhere
    }
}

/// A point for each way.
pub fn join(host: &Host, measured: &[Bin]) -> Result<Vec<Point>> {
    let mut points = Vec::new();
    for (_, row) in measured {
        let (robot, kind, key) = (&row.robot, &row.algorithm, &row.inputs);
        let of = |line: &&Line| {
            let known = (&line.point.robot, &line.point.key) == (robot, key);
            known && json!(line.point.kind) == **kind
        };
        let before = points.len();
        let ways = host.lines.iter().filter(of);
        points.extend(ways.map(|way| way.costing(row)));
        if points.len() == before {
            bail!("the host knows no error of {robot} {kind} {key}");
        }
    }
    front::mark(&mut points);
    Ok(points)
}

impl Line {
    /// The configuration with what it costs.
    fn costing(&self, row: &Row) -> Point {
        let mut point = self.point.clone();
        // A simulation is as good as its steps are short: what counts is a simulated second.
        let step: Option<u64> = point.on("step").parse().ok();
        let calls = step.map_or(1, |step| 1_000_000 / step);
        point.instructions = row.instructions.max * calls;
        point.cycles = row.cycles.max * calls;
        point.cycles_mean = row.cycles_mean * calls as f64;
        for error in [&mut point.error_max, &mut point.error_rms, &mut point.error_p99] {
            *error = error.map(|error| error.max(KNOWN * self.full_scale));
        }
        point.relative_max = point.relative_max.map(|share| share.max(KNOWN));
        if let Some(step) = step.map(|step| format!("step={step}")) {
            match &*point.key {
                "default" => point.key = step,
                _ => point.key += &format!(",{step}"),
            }
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use super::{Host, KNOWN, Line, join};
    use crate::kit::meter::Spread;
    use crate::kit::rows::Row;

    fn row(algorithm: &str, inputs: &str) -> Row {
        let spread = Spread { min: 10, median: 10, max: 20 };
        Row {
            instructions: spread,
            cycles: spread,
            cycles_mean: 12.5,
            ..Row::sample(["arm", algorithm, "engine", inputs], 0)
        }
    }

    const LINES: &str = r#"
{"kind":"inverse","robot":"arm","key":"default","configuration":{"trig":"table3"},"unit":"N·m","full_scale":10.0,"error_max":1e-5,"error_rms":1e-6,"error_p99":9e-6,"relative_max":1e-6}
{"kind":"simulation","robot":"arm","key":"default","configuration":{"step":"1000"},"unit":"rad","full_scale":1.0,"error_max":null,"error_rms":null,"error_p99":null,"relative_max":null}"#;

    #[test]
    fn the_error_over_states_anywhere_is_that_of_the_default() {
        let lines = LINES.replacen(r#""full_scale""#, r#""anywhere":0.25,"full_scale""#, 1);
        let other = lines.replace("default", "other");
        let [host, other] = [&lines, &other].map(|lines| Host::read(lines.trim()).expect("good"));
        let found = [host.anywhere("arm"), host.anywhere("leg"), other.anywhere("arm")];
        assert_eq!(found, [Some(0.25), None, None]);
    }

    #[test]
    fn rows_and_lines_meet_by_robot_kind_and_key() {
        let host = Host::read(LINES.trim()).expect("good lines");
        let rows = ["inverse", "simulation"].map(|kind| ("bin", row(kind, "default")));
        let points = join(&host, &rows).expect("complete");
        assert_eq!((points[0].cycles, points[0].cycles_mean), (20, 12.5));
        assert!(points[0].front);
        // A thousand steps make a second.
        assert_eq!((points[1].cycles, points[1].front), (20_000, false));
        assert_eq!(points[1].instructions, 20_000);
        assert!(join(&host, &[("bin", row("inverse", "trig=new"))]).is_err());
        assert!(Host::read("{").is_err());
    }

    #[test]
    fn an_error_smaller_than_the_referees_is_the_referees() {
        let exact = LINES.replace("1e-5", "1e-15").replace("9e-6", "1e-15");
        let host = Host::read(exact.trim()).expect("good lines");
        let points = join(&host, &[("bin", row("inverse", "default"))]).expect("complete");
        let known = Some(10.0 * KNOWN);
        assert_eq!((points[0].error_max, points[0].error_p99), (known, known));
        assert_eq!(points[0].error_rms, Some(1e-6));
    }

    #[test]
    fn a_key_names_what_is_not_the_default() {
        let key = |key: &str, step: Option<&str>| {
            let mut line = Line::default();
            line.point.key = key.into();
            let step = step.map(|step: &str| ("step".into(), step.into()));
            line.point.configuration.extend(step);
            line.costing(&row("inverse", key)).key
        };
        assert_eq!(key("default", None), "default");
        assert_eq!(key("default", Some("5")), "step=5");
        assert_eq!(key("trig=table", Some("5")), "trig=table,step=5");
    }
}
