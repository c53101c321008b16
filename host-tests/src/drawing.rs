//! A drawing of a machine from its own numbers: each body as lines from its joint to the joints and loops on it.

use dynamics_core::algorithms::Pose;
use dynamics_core::scalar::Real;
use serde::Serialize;

use crate::export::Robot;

type Point = [f64; 2];

/// Seen from the front if the machine is planar, else from above at a corner; m.
#[derive(Clone, Debug, Serialize)]
pub struct Drawing {
    pub name: String,
    /// The lines of the bodies, and whether another body slides in or on it.
    pub bodies: Vec<(bool, Vec<Point>)>,
    /// Joints that turn.
    pub joints: Vec<Point>,
    /// Joints on the base.
    pub ground: Vec<Point>,
    /// Where two bodies close a loop.
    pub closed: Vec<Point>,
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
    let (mut bodies, mut joints, mut ground) = (Vec::new(), Vec::new(), Vec::new());
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
            bodies.push((false, ends.iter().map(|end| seen(*end)).collect()));
            continue;
        }
        let lines = ends
            .iter()
            .map(|end| (slides, vec![seen(origins[own]), seen(*end)]));
        bodies.extend(lines);
        if !["prismatic", "free", "fixed"].contains(&&*body.joint) {
            joints.push(seen(origins[own]));
        }
        let parents = std::iter::successors(Some(body.parent), |parent| {
            let axis = robot.bodies.get(usize::try_from(*parent).ok()?)?;
            (axis.mass == 0.0).then_some(axis.parent)
        });
        if parents.last() == Some(-1) && body.joint != "free" {
            ground.push(seen(origins[own]));
        }
    }
    Drawing {
        name: name.into(),
        bodies,
        joints,
        ground,
        closed: loops
            .iter()
            .map(|[(body, point), _]| seen(world(*body, *point)))
            .collect(),
    }
}
