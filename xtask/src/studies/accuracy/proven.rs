//! Errors that the package `certification` proves of configurations for every state of the joints'
//! box: beside the measured ones on the page, in their place for `--proven-error`.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::front;
use super::point::{Kind, Point};
use crate::kit::error::{Result, bail, refuse_if};
use crate::kit::host_bin::{self, SIMULATED};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{output, shell};

/// The record, which `certify --hashes` compares with today's machine code.
pub const FILE: &str = "docs/accuracy-proven.json";

/// The box of states, as `certify` takes it.
#[derive(clap::Args)]
#[group(skip)]
pub struct StateBox {
    /// The greatest acceleration of each joint in the box, rad/s² or m/s²: 10 if not given
    #[arg(long, value_name = "A", requires = "proven_error", conflicts_with_all = ["error", "cycles"])]
    acceleration: Option<String>,
    /// The greatest speed of joints whose description has none, rad/s or m/s
    #[arg(long, value_name = "V", requires = "proven_error", conflicts_with_all = ["error", "cycles"])]
    speed: Option<String>,
    /// The greatest |q| of joints that slide and whose description has no limits, m
    #[arg(long, value_name = "Q", requires = "proven_error", conflicts_with_all = ["error", "cycles"])]
    range: Option<String>,
    /// A narrower range of a joint, as `certify` takes it: 2:-1.5..1.5, 2:v:0.5 or 2:a:4
    #[arg(long = "box", value_name = "RANGE", requires = "proven_error", conflicts_with_all = ["error", "cycles"])]
    narrow: Vec<String>,
}

impl StateBox {
    /// The words for `certify`.
    pub fn words(&self) -> Vec<String> {
        let [a, v, q] = [&self.acceleration, &self.speed, &self.range].map(Option::iter);
        let one = |name: &'static str| move |value: &String| format!("--{name}={value}");
        let ranges = self.narrow.iter().map(one("box"));
        let magnitudes = a.map(one("acceleration")).chain(v.map(one("speed")));
        magnitudes
            .chain(q.map(one("range")))
            .chain(ranges)
            .collect()
    }
}

/// What `certify --configurations` prints of a robot.
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

/// What `certify --configurations` prints: of the robots of the page, or of those of these words.
pub fn prove(workspace: &Workspace, words: &[String]) -> Result<String> {
    output::note("The errors of a hundred configurations are proven: this takes some minutes.");
    let mut certify = SIMULATED.program(workspace, "certify")?;
    shell::capture(certify.arg("--configurations").args(words))
}

pub fn parsed(text: &str) -> Result<Vec<Proven>> {
    host_bin::parsed("certify", text)
}

pub fn recorded(workspace: &Workspace) -> Result<Vec<Proven>> {
    parsed(&workspace::read(&workspace.root.join(FILE))?)
}

/// Gives points the proven errors of their robots. How the code is optimised changes no number.
pub fn attach(all: &[Proven], points: &mut [Point]) {
    for point in points.iter_mut().filter(|one| one.kind == Kind::Inverse) {
        let axes = point.key.split(',');
        let axes: Vec<&str> = axes.filter(|axis| !axis.starts_with("opt=")).collect();
        let key = match &*axes.join(",") {
            "" => "default".to_owned(),
            key => key.to_owned(),
        };
        let of = Proven::of(all, &point.robot);
        point.proven = of.and_then(|one| one.proven.get(&key).copied());
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
    let note = of.note(", or what --box gives,");
    front::mark(&mut points);
    Ok((points, note))
}

impl Proven {
    /// Of a robot.
    pub fn of<'a>(all: &'a [Self], robot: &str) -> Option<&'a Self> {
        all.iter().find(|one| one.robot == robot)
    }

    /// The states that errors are proven for, and what has no proven error.
    pub fn note(&self, narrower: &str) -> String {
        let left_out = self.left_out.iter();
        let left_out: Vec<String> = left_out
            .map(|(what, why)| format!("{what} ({why})"))
            .collect();
        let accelerations = self.joints.iter().map(|joint| joint.acceleration);
        let most = accelerations.fold(0.0, f64::max);
        format!(
            "Errors are proven for every state of the joints' box: limits, rated speeds{narrower} and accelerations up to {most} rad/s². Nothing \
             is proven of {}.",
            left_out.join("; ")
        )
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::super::choice::{Allowed, Budget};
    use super::super::front::tests::point;
    use super::super::point::{Kind, Point};
    use super::super::{Args, recorded};
    use super::{Joint, Proven, attach, check, chosen};
    use crate::kit::docs::repository::root;
    use crate::kit::workspace::Workspace;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        args: Args,
    }

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

    fn measured() -> [Point; 5] {
        [
            point("default", 1e-5, 1000, 1000.0),
            point("opt=s", 1e-5, 950, 950.0),
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
        assert!(chosen(0.01).is_ok_and(|chosen| chosen == ("opt=s".to_owned(), 1e-4)));
        assert!(chosen(0.05).is_ok_and(|chosen| chosen == ("trig=table".to_owned(), 0.02)));
        assert!(
            chosen(1e-5).is_err(),
            "less than what is proven of the default"
        );
        assert!(note.contains("up to 12 rad/s²") && note.contains("reduced rates (a path)"));
        assert!(super::chosen(&proven(), measured()[3..4].to_vec()).is_err());
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

    #[test]
    fn the_box_is_passed_to_certify_with_a_proven_error_alone() {
        let words = |line: &str| {
            let words = ["accuracy"].into_iter().chain(line.split(' '));
            let parsed = Line::try_parse_from(words);
            parsed.map(|line| line.args.state_box.words()).ok()
        };
        let given = words(
            "--robot ur5e --proven-error 0.01Nm --acceleration 4 --box 2:-1.5..1.5 --box 2:v:0.5",
        );
        let given = given.expect("options of certify");
        assert_eq!(
            given,
            ["--acceleration=4", "--box=2:-1.5..1.5", "--box=2:v:0.5"]
        );
        assert_eq!(words("--robot ur5e --error 0.01Nm --acceleration 4"), None);
        assert_eq!(words("--robot ur5e --prove"), None);
    }
}
