//! Errors that are proven for every state of the joints' box: beside the measured ones on the page,
//! in their place for `--proven-error`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::front;
use super::point::{Kind, Point};
use crate::kit::error::{Result, bail, refuse_if};
use crate::kit::host_bin;
use crate::kit::workspace::{self, Workspace};

/// The record, which names the machine code that it is of.
pub const FILE: &str = "docs/accuracy-proven.json";

/// What is proven of a robot, by the keys of configurations.
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

/// What a file has, or the record.
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
    refuse_if!(
        proven().count() == 0,
        "nothing is proven of these configurations"
    );
    Ok(proven().count())
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
    let Some(of) = points
        .first()
        .and_then(|point| Proven::of(all, &point.robot))
    else {
        bail!("nothing is proven of these configurations");
    };
    let note = of.note();
    front::mark(&mut points);
    Ok((points, note))
}

impl Proven {
    /// Of a robot.
    pub fn of<'a>(all: &'a [Self], robot: &str) -> Option<&'a Self> {
        all.iter().find(|one| one.robot == robot)
    }

    /// The states that errors are proven for, and what has no proven error.
    pub fn note(&self) -> String {
        let left_out = self.left_out.iter();
        let left_out: Vec<String> = left_out
            .map(|(what, why)| format!("{what} ({why})"))
            .collect();
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
    use super::super::choice::{Allowed, Budget};
    use super::super::front::tests::point;
    use super::super::point::{Kind, Point};
    use super::super::recorded;
    use super::{Joint, Proven, attach, check, chosen};
    use crate::kit::docs::repository::root;
    use crate::kit::workspace::Workspace;

    fn proven() -> [Proven; 1] {
        let bounds = [
            ("default", 1e-4),
            ("trig=table", 0.02),
            ("model=gravity", 30.0),
        ];
        [Proven {
            robot: "arm".to_owned(),
            joints: vec![Joint { acceleration: 12.0 }],
            proven: bounds.map(|(key, bound)| (key.to_owned(), bound)).into(),
            left_out: [("reduced rates".to_owned(), "a path".to_owned())].into(),
        }]
    }

    fn measured() -> [Point; 4] {
        [
            point("default", 1e-5, 1000, 1000.0),
            point("trig=table", 1e-3, 900, 900.0),
            point("rate=10", 1e-6, 100, 100.0),
            point("model=gravity", 10.0, 300, 300.0),
        ]
    }

    #[test]
    fn the_cheapest_of_which_the_error_is_proven_is_chosen() {
        let (points, note) = chosen(&proven(), measured().into()).expect("four of them");
        let all: Vec<&Point> = points.iter().collect();
        let chosen = |error: f64| {
            let kind = Kind::Inverse;
            let budget = Budget::Error(Allowed { error, kind });
            budget
                .choose(&all)
                .map(|point| (point.key.clone(), point.error()))
        };
        // Measured the table would do, and so would every tenth tick.
        assert!(chosen(0.01).is_ok_and(|chosen| chosen == ("default".to_owned(), 1e-4)));
        assert!(chosen(0.05).is_ok_and(|chosen| chosen == ("trig=table".to_owned(), 0.02)));
        assert!(
            chosen(1e-5).is_err(),
            "less than what is proven of the default"
        );
        assert!(note.contains("up to 12 rad/s²") && note.contains("reduced rates (a path)"));
        assert!(super::chosen(&proven(), measured()[2..3].to_vec()).is_err());
        assert!(super::chosen(&[], measured().into()).is_err());
    }

    #[test]
    fn no_recorded_error_is_above_its_proven_one() {
        let mut points = recorded::read(&Workspace::at(&root())).expect("points");
        assert!(check(&points).is_ok_and(|proven| proven > 100));
        let default = points.iter_mut().find(|point| point.is_default());
        default.expect("a default").error_max = Some(1.0);
        let refused = check(&points).expect_err("more than is proven").to_string();
        assert!(
            refused.contains("default") && refused.contains("is proven"),
            "{refused}"
        );
        let mut points = measured();
        attach(&[], &mut points);
        assert!(check(&points).is_err(), "nothing is proven");
    }
}
