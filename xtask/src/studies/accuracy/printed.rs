//! The generated code is built and measured as it is printed: it must cost and err no more than
//! the record promises of the ways that it is chosen for.

use std::path::PathBuf;

use super::point::{Kind, Point};
use super::robot::Robot;
use super::{code, page, recorded};
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::workspace::{self, Workspace};

/// The variable that says to the bins `accuracy_quick` where the file is.
pub const PRINTED: &str = "ACCURACY_PRINTED";

/// The bins, here and there, that measure generated code alone.
pub const QUICK_BIN: &str = "accuracy_quick";

/// Generated code may cost and err by so much more than is promised, as multiples: a caller gets
/// torques in registers in the one program and through memory in the other, and a function may be
/// compiled into its caller.
const COST: f64 = 1.05;
const ERROR: f64 = 1.01;

/// Every single change of the UR5e for which there is code, and one of the leg.
fn is_sample(point: &Point) -> bool {
    let all = point.robot == "ur5e" || (&*point.robot, &*point.key) == ("a1_leg", "trig=minimax7");
    all && page::is_single(point, usize::MAX)
}

/// Writes it, as a module for each and a visit of all of a robot's.
pub fn write(workspace: &Workspace) -> Result<PathBuf> {
    let points = recorded::read(workspace)?;
    let file = workspace.target.join("accuracy_printed.rs");
    let mut text = include_str!("templates/uses.txt").to_owned();
    for robot in Robot::COMPUTED {
        let [name, _, _, n] = robot.names();
        let of = |point: &&Point| point.robot == name && is_sample(point);
        let codes = points.iter().filter(of).enumerate();
        let codes = codes.filter_map(|(i, point)| Some((i, point, code::rust(point).ok()?)));
        // The visitor is unused if nothing is printed for a robot.
        let mut visits = String::from("    let _ = &visitor;\n");
        for (i, point, code) in codes {
            let way = format!("{name}_{i}");
            text += &wrapped(point, &way, &code, n);
            visits += &format!("    visitor.way::<{way}::Way>();\n");
        }
        text += &format!("pub fn {name}(visitor: &mut impl Visitor<{n}>) {{\n{visits}}}\n");
    }
    workspace::write(&file, text)?;
    Ok(file)
}

/// A module with the code as a way to compute.
fn wrapped(point: &Point, way: &str, code: &str, joints: &str) -> String {
    let axes = point.changes();
    let axes: String = axes.map(|(axis, value)| format!("{axis}: {value:?}, ")).collect();
    let template = match code::ticks(point) {
        true => include_str!("templates/ticking_way.txt"),
        false => include_str!("templates/way.txt"),
    };
    let ahead = match point.on("between") {
        "interpolated" => point.on("rate"),
        _ => "0",
    };
    let values =
        [("WAY", way), ("AXES", &axes), ("AHEAD_BY", ahead), ("JOINTS", joints), ("CODE", code)];
    code::filled(template, &values)
}

/// Fails unless all generated code costs and errs as is promised of the points that it was chosen
/// for; else says how much that is.
pub fn check(generated: &[Point], recorded: &[Point]) -> Result<usize> {
    let name = |point: &Point| format!("{} {}", point.robot, point.key);
    let costs = |point: &Point| [point.costs()[0], point.costs()[1]];
    let mut wrong = Vec::new();
    for found in generated {
        let what = name(found);
        let promised =
            recorded.iter().find(|point| point.kind == Kind::Inverse && name(point) == what);
        let promised = promised.ok_or_else(|| check!("{what} is generated, but not recorded"))?;
        let mut pairs = std::iter::zip(costs(found), costs(promised));
        let cheap = pairs.all(|(found, promised)| found <= COST * promised);
        if !cheap || !found.error().is_finite() || found.error() > ERROR * promised.error() {
            let [now, then] = [found, promised].map(|one| (costs(one), one.error()));
            wrong.push(format!("{what}: cycles and error are {now:?}, promised are {then:?}"));
        }
    }
    refuse_if!(!wrong.is_empty(), "{}", wrong.join("\n"));
    let count = generated.len();
    refuse_if!(count == 0, "no generated code was measured");
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::check;

    #[test]
    fn code_that_costs_or_errs_more_than_promised_is_refused() {
        let recorded = [point("default", 1e-6, 1000, 1000.0)];
        let held = |error, cycles, mean| {
            check(&[point("default", error, cycles, mean)], &recorded).map_err(|e| e.to_string())
        };
        assert_eq!(held(1e-6, 1050, 1050.0), Ok(1));
        assert_eq!(held(1e-9, 10, 10.0), Ok(1));
        for (error, cycles, mean) in [
            (1.02e-6, 1000, 1000.0),
            (f64::NAN, 1000, 1000.0),
            (1e-6, 1051, 1000.0),
            (1e-6, 1000, 1051.0),
        ] {
            assert!(held(error, cycles, mean).is_err_and(|said| said.contains("promised are")));
        }
        assert!(check(&[point("trig=a", 1.0, 1, 1.0)], &recorded).is_err());
        assert!(check(&[], &recorded).is_err(), "nothing is measured");
    }
}
