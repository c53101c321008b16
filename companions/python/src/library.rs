//! The robots of the library by their names.

use dynamics_core::model::{JointLimits, Link, Model, Robot};
use dynamics_core::robots;

use robot_dynamics_kernels::model::Bodies;
use robot_import::number::Attitude;

use crate::robot::frames::Frame;

/// A robot of the library.
pub struct Known {
    /// The bodies of the robot.
    pub bodies: Bodies,
    /// The names of its bodies.
    pub names: Vec<String>,
    /// The limits of their joints.
    pub limits: Vec<JointLimits<f64>>,
}

fn known<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>() -> Known {
    let model: &Model<f64, B, Q, V> = const { &T::MODEL };
    let of = |link: &Link<f64>| link.name.to_owned();
    Known {
        bodies: Bodies::of_model(model),
        names: model.links.iter().map(of).collect(),
        limits: model.links.iter().map(|link| link.limits).collect(),
    }
}

/// The names of its joints in the file of its source.
pub fn joints(robot: &str, bodies: &[String]) -> Vec<String> {
    bodies.iter().enumerate().map(|(i, body)| crate::names::joint(robot, i, body)).collect()
}

/// The frames of its file that are known here: the tool's of an SO-101.
pub fn frames(robot: &str) -> Vec<Frame> {
    let (body, xyz) = (Some(4), [-0.0079, -0.000218121, -0.0981274]);
    let (name, attitude) = ("gripper_frame_link".to_owned(), Attitude::QuarterTurns([0, 2, 0]));
    if robot == "so101" { vec![Frame { name, body, xyz, attitude }] } else { Vec::new() }
}

/// A function that builds a robot.
type Build = fn() -> Known;

/// Names and robots, in the order of the library's documentation.
pub const ROBOTS: [(&str, Build); 12] = [
    ("ur5e", known::<robots::Ur5e, 6, 6, 6>),
    ("panda", known::<robots::Panda, 7, 7, 7>),
    ("iiwa14", known::<robots::Iiwa14, 7, 7, 7>),
    ("a1", known::<robots::A1, 16, 12, 12>),
    ("a1_leg", known::<robots::A1Leg, 4, 3, 3>),
    ("a1_free", known::<robots::A1Free, 17, 19, 18>),
    ("gen3", known::<robots::Gen3, 7, 7, 7>),
    ("so101", known::<robots::So101, 6, 6, 6>),
    ("xarm7", known::<robots::XArm7, 7, 7, 7>),
    ("z1", known::<robots::Z1, 7, 7, 7>),
    ("g1", known::<robots::G1, 29, 29, 29>),
    ("g1_free", known::<robots::G1Free, 30, 36, 35>),
];

/// The robot of a name, which may have another case.
pub fn find(name: &str) -> Option<(&'static str, Known)> {
    let given = name.to_ascii_lowercase();
    let (name, robot) = ROBOTS.iter().find(|(name, _)| *name == given)?;
    Some((name, robot()))
}
