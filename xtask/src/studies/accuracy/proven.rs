//! `--proven-error`: configurations with the error that the package `certification` proves of them for every state, instead of the measured one.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::front;
use super::point::Point;
use crate::kit::error::{Result, bail, check};
use crate::kit::output;
use crate::kit::shell;
use crate::kit::workspace::Workspace;

/// What `certify --configurations` prints.
#[derive(Deserialize)]
pub struct Proven {
    proven: BTreeMap<String, f64>,
    left_out: BTreeMap<String, String>,
}

impl Proven {
    /// Of a robot, by the arguments that name it.
    pub fn of(workspace: &Workspace, robot: &[&str]) -> Result<Self> {
        output::note("The errors of a hundred configurations are proven: this takes some minutes.");
        let words = "--quiet --profile simulated --package certification -- --configurations";
        let mut command = workspace.cargo("run");
        command.args(words.split(' ')).args(["--robot"]).args(robot);
        let text = shell::capture(&mut command)?;
        serde_json::from_str(&text).map_err(|error| check!("certify: {error}"))
    }

    /// The points of which an error is proven, with that error and their own fronts.
    pub fn points(&self, measured: &[Point]) -> Result<Vec<Point>> {
        let mut points: Vec<Point> = measured.iter().filter_map(|one| self.point(one)).collect();
        if points.is_empty() {
            bail!("nothing is proven of these configurations");
        }
        front::mark(&mut points);
        Ok(points)
    }

    /// How the code is optimised changes no number.
    fn point(&self, measured: &Point) -> Option<Point> {
        let axes = measured
            .key
            .split(',')
            .filter(|axis| !axis.starts_with("opt="));
        let key: Vec<&str> = axes.collect();
        let key = match key.is_empty() {
            true => "default".to_owned(),
            false => key.join(","),
        };
        let (bound, observed) = (*self.proven.get(&key)?, measured.error());
        Some(Point {
            error_max: Some(bound),
            relative_max: measured.relative_max.map(|share| share * bound / observed),
            error_rms: None,
            error_p99: None,
            ..measured.clone()
        })
    }

    /// What the errors are of, and what has none.
    pub fn note(&self) -> String {
        let left_out = self.left_out.iter();
        let left_out: Vec<String> = left_out
            .map(|(what, why)| format!("{what} ({why})"))
            .collect();
        format!(
            "\nErrors are proven for every state of the joints' box: limits, rated speeds, and accelerations up to 10 rad/s². Nothing is proven \
             of {}.",
            left_out.join("; ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::choice::{Allowed, Budget};
    use super::super::front::tests::point;
    use super::super::point::{Kind, Point};
    use super::Proven;

    #[test]
    fn the_cheapest_of_which_the_error_is_proven_is_chosen() {
        let proven = Proven {
            proven: [
                ("default", 1e-4),
                ("trig=table", 0.02),
                ("model=gravity", 30.0),
            ]
            .map(|(key, bound)| (key.to_owned(), bound))
            .into(),
            left_out: [("rate".to_owned(), "a path".to_owned())].into(),
        };
        let measured = [
            point("default", 1e-5, 1000, 1000.0),
            point("opt=s", 1e-5, 950, 950.0),
            point("trig=table", 1e-3, 900, 900.0),
            point("rate=10", 1e-6, 100, 100.0),
            point("model=gravity", 10.0, 300, 300.0),
        ];
        let points = proven.points(&measured).expect("four of them");
        let all: Vec<&Point> = points.iter().collect();
        let chosen = |error: f64| {
            let kind = Kind::Inverse;
            let budget = Budget::Error(Allowed { error, kind });
            budget
                .choose(&all)
                .map(|point| (point.key.clone(), point.error()))
        };
        // Measured the table would do, and so would every tenth tick.
        assert!(chosen(0.01).is_ok_and(|chosen| chosen == ("opt=s".to_owned(), 1e-4)));
        assert!(chosen(0.05).is_ok_and(|chosen| chosen == ("trig=table".to_owned(), 0.02)));
        assert!(
            chosen(1e-5).is_err(),
            "less than what is proven of the default"
        );
        assert!(proven.note().contains("rate (a path)"));
        assert!(proven.points(&measured[3..4]).is_err());
    }
}
