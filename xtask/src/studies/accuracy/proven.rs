//! Errors that are proven for every state of the joints' box: beside the measured ones on the page,
//! in their place for `--proven-error`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::front;
use super::point::{Kind, Point};
use crate::kit::error::{Result, bail, check, refuse_if};
use crate::kit::host_bin;
use crate::kit::workspace::{self, Workspace};

/// The record, which names the machine code that it is of.
pub const FILE: &str = "docs/accuracy-proven.json";

/// The proven errors of a robot, by the keys of configurations.
#[derive(Debug, Default, Deserialize)]
pub struct Proven {
    robot: String,
    joints: Vec<Joint>,
    proven: BTreeMap<String, f64>,
    left_out: BTreeMap<String, String>,
}

#[derive(Debug, Deserialize)]
struct Joint {
    acceleration: f64,
}

/// The proven errors in a file, or in the record.
pub fn read(workspace: &Workspace, file: Option<&Path>) -> Result<Vec<Proven>> {
    let record = workspace.root.join(FILE);
    host_bin::parsed(FILE, &workspace::read(file.unwrap_or(&record))?)
}

/// Gives points the proven errors of their robots.
pub fn attach(all: &[Proven], points: &mut [Point]) {
    for point in points.iter_mut().filter(|one| one.kind == Kind::Inverse) {
        let of = Proven::of(all, &point.robot);
        point.proven = of.and_then(|one| one.proven.get(&point.key).copied());
    }
}

/// Fails if more was measured than is proven, or nothing is proven. The paths of the page's robots
/// lie in their boxes.
pub fn check(points: &[Point]) -> Result<usize> {
    let proven = || points.iter().filter(|point| point.proven.is_some());
    if let Some(wrong) = proven().find(|point| point.proven < point.error_max) {
        let (robot, key, bound, error) = (&wrong.robot, &wrong.key, wrong.proven, wrong.error());
        bail!("{robot} {key}: {bound:?} is proven, and {error} was measured");
    }
    let count = proven().count();
    refuse_if!(count == 0, "nothing is proven of these configurations");
    Ok(count)
}

/// The points of which an error is proven, with that one in place of the measured one and their own
/// fronts; and what holds for them.
pub fn chosen(all: &[Proven], mut points: Vec<Point>) -> Result<(Vec<Point>, String)> {
    attach(all, &mut points);
    let in_place = |point: Point| {
        let share = point.proven? / point.error();
        Some(Point {
            error_max: point.proven,
            relative_max: point.relative_max.map(|relative| relative * share),
            error_rms: None,
            error_p99: None,
            ..point
        })
    };
    let mut points: Vec<Point> = points.into_iter().filter_map(in_place).collect();
    let of = (points.first()).and_then(|point| Proven::of(all, &point.robot));
    let note = of.map(Proven::note);
    let note = note.ok_or_else(|| check!("nothing is proven of these configurations"))?;
    front::mark(&mut points);
    Ok((points, note))
}

impl Proven {
    /// The proven errors of a robot.
    pub fn of<'a>(all: &'a [Self], robot: &str) -> Option<&'a Self> {
        all.iter().find(|one| one.robot == robot)
    }

    /// The states that errors are proven for, and what has no proven error.
    pub fn note(&self) -> String {
        let one = |(what, why): (&String, &String)| format!("{what} ({why})");
        let left_out: Vec<String> = self.left_out.iter().map(one).collect();
        let accelerations = self.joints.iter().map(|joint| joint.acceleration);
        let most = accelerations.fold(0.0, f64::max);
        format!(
            "Errors are proven for every state of the joints' box: limits, rated speeds and accelerations up to {most} rad/s². Nothing \
             is proven of {}.",
            left_out.join("; ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::super::recorded;
    use super::{Joint, Proven, attach, check, chosen};
    use crate::kit::docs::repository::root;
    use crate::kit::workspace::Workspace;

    #[test]
    fn proven_errors_take_the_place_of_measured_ones() {
        let proven = [("default", 1e-4), ("trig=table", 0.02)];
        let all = [Proven {
            robot: "arm".into(),
            joints: vec![Joint { acceleration: 12.0 }],
            proven: proven.map(|(key, bound)| (key.into(), bound)).into(),
            left_out: [("reduced rates".into(), "a path".into())].into(),
        }];
        let rate = point("rate=10", 1e-6, 100, 100.0);
        let (exact, table) = ("default", "trig=table");
        let [exact, table] = [(exact, 1e-5, 1000), (table, 1e-3, 900)]
            .map(|(key, error, cycles)| point(key, error, cycles, cycles as f64));
        let (points, note) = chosen(&all, vec![exact, table, rate.clone()]).expect("two of them");
        let found: Vec<_> = points.iter().map(|one| (&*one.key, one.error())).collect();
        assert_eq!(found, proven);
        assert!(points.iter().all(|point| point.front));
        assert!(note.contains("up to 12 rad/s²") && note.contains("reduced rates (a path)"));
        assert!(chosen(&all, vec![rate]).is_err());
    }

    #[test]
    fn no_recorded_error_is_above_its_proven_one() {
        let mut points = recorded::read(&Workspace::at(&root())).expect("points");
        assert!(check(&points).is_ok_and(|proven| proven > 100));
        let default = points.iter_mut().find(|point| point.is_default());
        default.expect("a default").error_max = Some(1.0);
        let refused = check(&points).expect_err("more than is proven").to_string();
        assert!(refused.contains("default") && refused.contains("is proven"));
        attach(&[], &mut points);
        assert!(check(&points).is_err(), "nothing is proven");
    }
}
