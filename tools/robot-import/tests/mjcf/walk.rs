//! A walk of a description's tree: where its bodies and joints are at given coordinates.

use std::collections::HashMap;

use dynamics_core::glam::{DMat3, DQuat, DVec3};
use robot_import::description::{Description, Joint, Kind, Pose};
use serde::Deserialize;

/// The state of MuJoCo at some coordinates.
#[derive(Deserialize)]
pub struct State {
    pub bodies: HashMap<String, Body>,
    pub joints: HashMap<String, Placed>,
    pub residuals: HashMap<String, Vec<f64>>,
}

#[derive(Deserialize)]
pub struct Body {
    pub mass: f64,
    pub com: [f64; 3],
    pub inertia: [f64; 6],
}

#[derive(Deserialize)]
pub struct Placed {
    pub q: Vec<f64>,
    pub anchor: [f64; 3],
    pub axis: [f64; 3],
}

/// The placement of each link in the world.
pub struct Walked {
    links: Vec<Pose>,
}

impl Walked {
    pub fn new(robot: &Description, state: &State) -> Self {
        let mut links = vec![Pose::IDENTITY; robot.links.len()];
        // Parents are before their children in this format.
        for joint in &robot.joints {
            let q = state.joints.get(&joint.name).map(|placed| placed.q.as_slice());
            let motion = motion(joint, q.unwrap_or_default());
            links[joint.child] = links[joint.parent].then(&joint.origin).then(&motion);
        }
        Self { links }
    }

    /// Mass, centre of mass and inertia about it in the world.
    pub fn body(&self, robot: &Description, name: &str) -> Option<(f64, [f64; 3], [f64; 6])> {
        let link = robot.links.iter().position(|link| link.name == name)?;
        let Some(inertial) = robot.links[link].inertial else {
            return Some((0.0, [0.0; 3], [0.0; 6]));
        };
        let frame = self.links[link].then(&inertial.frame);
        let [xx, xy, xz, yy, yz, zz] = inertial.inertia;
        let tensor = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        let [x, y, z] = (frame.rotation * tensor * frame.rotation.transpose()).to_cols_array_2d();
        Some((inertial.mass, frame.position.to_array(), [x[0], x[1], x[2], y[1], y[2], z[2]]))
    }

    /// Kind, anchor and axis in the world.
    pub fn joint(&self, robot: &Description, name: &str) -> Option<(Kind, [f64; 3], [f64; 3])> {
        let joint = robot.joints.iter().find(|joint| joint.name == name)?;
        let frame = self.links[joint.parent].then(&joint.origin);
        // If sliding joints are among several, the anchor moves with its own joint.
        let at = match joint.kind {
            Kind::Prismatic => frame.position,
            _ => self.links[joint.child].position,
        };
        let axis = frame.rotation * joint.axis.normalize_or_zero();
        Some((joint.kind, at.to_array(), axis.to_array()))
    }

    /// The open part of a constraint: position, and sine of half of the angle.
    pub fn residual(&self, robot: &Description, state: &State, name: &str) -> Vec<f64> {
        if let Some(closed) = robot.loops.iter().find(|closed| closed.name == name) {
            let end = |i: usize| self.links[closed.links[i]].then(&closed.frames[i]);
            let [one, other] = [end(0), end(1)];
            let mut all = (one.position - other.position).to_array().to_vec();
            if closed.kind == Kind::Fixed {
                let apart = DQuat::from_mat3(&(one.rotation.transpose() * other.rotation));
                all.push(apart.xyz().length());
            }
            return all;
        }
        // The joint that follows, and its coefficient in the constraint.
        let (first, coefficient) = match name {
            "mimic" => ("b", 1.0),
            "mimic by default" => ("a", 1.0),
            "b follows a" => ("b", -2.0),
            "c follows b" => ("c", 3.0),
            _ => return Vec::new(),
        };
        let joint = robot.joints.iter().find(|joint| joint.name == first);
        let Some(mimic) = joint.and_then(|joint| joint.mimic.as_ref()) else {
            return Vec::new();
        };
        let [q, other] = [first, mimic.joint.as_str()].map(|name| state.joints[name].q[0]);
        vec![coefficient * (q - mimic.multiplier * other - mimic.offset)]
    }
}

fn motion(joint: &Joint, q: &[f64]) -> Pose {
    let axis = joint.axis.normalize_or_zero();
    let turn = |quaternion: &[f64]| match quaternion {
        [w, x, y, z] => DMat3::from_quat(DQuat::from_xyzw(*x, *y, *z, *w)),
        _ => DMat3::IDENTITY,
    };
    match (joint.kind, q) {
        (Kind::Revolute | Kind::Continuous, [q]) => {
            Pose { position: DVec3::ZERO, rotation: DMat3::from_axis_angle(axis, *q) }
        }
        (Kind::Prismatic, [q]) => Pose::translation(axis * *q),
        (Kind::Spherical, q) => Pose { position: DVec3::ZERO, rotation: turn(q) },
        (Kind::Free, [x, y, z, quaternion @ ..]) => {
            Pose { position: DVec3::new(*x, *y, *z), rotation: turn(quaternion) }
        }
        _ => Pose::IDENTITY,
    }
}
