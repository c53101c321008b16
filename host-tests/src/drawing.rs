//! A drawing of a machine from its own numbers: each body as lines from its joint to the joints and loops on it.

use dynamics_core::algorithms::Pose;
use dynamics_core::scalar::Real;
use serde::Serialize;

use crate::export::Robot;

type Point = [f64; 2];

/// Lines and dots of a machine, in the order in which they are drawn, from 0 to 1 to the right and up: seen from the front if it
/// is planar, else from above at a corner.
#[derive(Clone, Debug, Serialize)]
pub struct Drawing {
    pub name: String,
    parts: Vec<(Part, Vec<Point>)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Part {
    /// A body's line or surface.
    Body,
    /// That of a body in or on which another one slides.
    Cylinder,
    /// The sign below a joint on the base.
    Base,
    /// A dot where a joint turns.
    Joint,
    /// A dot where two bodies close a loop.
    Closure,
}

/// Two ends of a loop: on each body, −1 for the base, a point in its frame.
pub type Ends = [(i64, [f64; 3]); 2];

/// The drawing of a robot whose bodies are at these poses.
pub fn drawing(name: &str, robot: &Robot, poses: &[Pose<f64>], loops: &[Ends]) -> Drawing {
    let world = |body: i64, point: [f64; 3]| match usize::try_from(body) {
        Ok(body) => {
            let pose = poses[body];
            (pose.rot * <f64 as Real>::Vec3::from(point) + pose.pos).to_array()
        }
        Err(_) => point,
    };
    let origins: Vec<[f64; 3]> = poses.iter().map(|pose| pose.pos.to_array()).collect();
    let flat = origins.iter().all(|at| at[1].abs() < 1e-9);
    let seen = |[x, y, z]: [f64; 3]| match flat {
        true => [x, z],
        false => [0.85 * x - 0.45 * y, 0.2 * x + 0.3 * y + 0.9 * z],
    };
    let mut parts = Vec::new();
    let mut ground = Vec::new();
    for (body, number) in robot.bodies.iter().zip(0_i64..) {
        // A body of no mass is the axis between two joints, or carries a platform whose place is a coordinate.
        if body.mass == 0.0 {
            continue;
        }
        let own = number as usize;
        let children =
            || (robot.bodies.iter().zip(&origins)).filter(|(child, _)| child.parent == number);
        let ends = loops.iter().flatten().filter(|(end, _)| *end == number);
        let closures: Vec<[f64; 3]> = ends.map(|&(end, point)| world(end, point)).collect();
        let carried = children().map(|(_, origin)| *origin);
        let mut ends: Vec<[f64; 3]> = carried.chain(closures.clone()).collect();
        let slides = children().any(|(child, _)| child.joint == "prismatic");
        if ends.is_empty() {
            ends.push(world(number, body.com.map(|x| 2.0 * x)));
        }
        let is_platform = ends.len() >= 3 && ends.len() == closures.len();
        if is_platform {
            ends.push(ends[0]);
            parts.push((Part::Body, ends.iter().map(|end| seen(*end)).collect()));
            continue;
        }
        let kind = if slides { Part::Cylinder } else { Part::Body };
        let lines = ends
            .iter()
            .map(|end| (kind, vec![seen(origins[own]), seen(*end)]));
        parts.extend(lines);
        if !["prismatic", "free", "fixed"].contains(&&*body.joint) {
            parts.push((Part::Joint, vec![seen(origins[own])]));
        }
        let parents = std::iter::successors(Some(body.parent), |parent| {
            let axis = robot.bodies.get(usize::try_from(*parent).ok()?)?;
            (axis.mass == 0.0).then_some(axis.parent)
        });
        if parents.last() == Some(-1) && body.joint != "free" {
            ground.push(seen(origins[own]));
        }
    }
    for [(body, point), _] in loops {
        parts.push((Part::Closure, vec![seen(world(*body, *point))]));
    }
    let at = fitted(&parts, &ground);
    for point in parts.iter_mut().flat_map(|(_, points)| points) {
        *point = at(*point);
    }
    parts.extend(ground.into_iter().flat_map(|point| base(at(point))));
    let order = [
        Part::Base,
        Part::Cylinder,
        Part::Body,
        Part::Joint,
        Part::Closure,
    ];
    parts.sort_by_key(|(part, _)| order.iter().position(|one| one == part));
    Drawing {
        name: name.into(),
        parts,
    }
}

/// The place in the unit square of a point, so that all lines fit and keep their proportions.
fn fitted(parts: &[(Part, Vec<Point>)], more: &[Point]) -> impl Fn(Point) -> Point + use<> {
    let all = || parts.iter().flat_map(|(_, points)| points).chain(more);
    let ends = [0, 1].map(|axis| {
        let values = || all().map(|point| point[axis]);
        let [low, high] = [f64::min, f64::max].map(|pick| values().reduce(pick).unwrap_or(0.0));
        [0.5 * (low + high), high - low]
    });
    let size = f64::max(ends[0][1], ends[1][1]);
    move |point| [0, 1].map(|axis| 0.5 + (point[axis] - ends[axis][0]) / size)
}

/// A triangle below a joint, and hatching below that.
fn base([x, y]: Point) -> Vec<(Part, Vec<Point>)> {
    let [(left, right), (below, end)] = [(x - 0.08, x + 0.08), (y - 0.05, y - 0.08)];
    let mut lines = vec![vec![[left, below], [x, y], [right, below], [left, below]]];
    lines.extend(
        (0..4)
            .map(|n| left + 0.04 * f64::from(n))
            .map(|x| vec![[x, end], [x + 0.03, below]]),
    );
    lines.into_iter().map(|line| (Part::Base, line)).collect()
}
