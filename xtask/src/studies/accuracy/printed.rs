//! The generated code is built and measured beside the ways that it was chosen for, as it is
//! printed: it must cost and err the same.

use std::path::PathBuf;

use super::point::Point;
use super::robot::Robot;
use super::{code, page, recorded};
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::workspace::{self, Workspace};

/// The variable that says to the bins `accuracy_quick` where the file is.
pub const PRINTED: &str = "ACCURACY_PRINTED";

/// Generated code may take so much more than was promised, or less, as shares: a caller gets
/// torques in registers in the one program and through memory in the other, and a function may be
/// compiled into its caller.
const CLOSE: std::ops::RangeInclusive<f64> = 0.95..=1.02;

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

/// Fails unless all generated code reproduces the figures of the points that it was chosen for,
/// errors to the bit; else says how much that is.
pub fn check(all: &[Point], single: &[Point]) -> Result<usize> {
    let mut different = Vec::new();
    let name = |point: &Point| format!("{} {}", point.robot, point.key);
    let figures = |point: &Point| [point.instructions as f64, point.costs()[0], point.costs()[1]];
    for generated in all {
        let what = name(generated);
        let chosen = single.iter().find(|point| name(point) == what);
        let lacks = || check!("{what} is generated, but not measured otherwise");
        let chosen = chosen.ok_or_else(lacks)?;
        let [found, promised] = [generated, chosen].map(figures);
        let mut ratios = std::iter::zip(found, promised).map(|(found, promised)| found / promised);
        let errors = [chosen, generated].map(Point::errors);
        if !ratios.all(|ratio| CLOSE.contains(&ratio)) || errors[0] != errors[1] {
            different.push(format!(
                "{what}: instructions, cycles and their mean were promised as {promised:?}, errors as {:?}, but what is \
                 generated has {found:?} and {:?}",
                errors[0], errors[1]
            ));
        }
    }
    refuse_if!(!different.is_empty(), "{}", different.join("\n"));
    let count = all.len();
    refuse_if!(count == 0, "no generated code was measured");
    Ok(count)
}
