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
    let of_number = match robot {
        "panda" => "panda_joint",
        "iiwa14" => "iiwa_joint_",
        "gen3" => "joint_",
        "xarm7" | "z1" => "joint",
        _ => "",
    };
    let joint = |(i, body): (usize, &String)| match &**body {
        "trunk" | "pelvis" => "floating_base".to_owned(),
        "gripperMover" => "jointGripper".to_owned(),
        _ if !of_number.is_empty() => format!("{of_number}{}", i + 1),
        "shoulder" => "shoulder_pan_joint".to_owned(),
        "upper_arm" => "shoulder_lift_joint".to_owned(),
        "forearm" => "elbow_joint".to_owned(),
        "torso" => "waist_pitch_joint".to_owned(),
        "shoulder_link" => "shoulder_pan".to_owned(),
        "upper_arm_link" => "shoulder_lift".to_owned(),
        "lower_arm_link" => "elbow_flex".to_owned(),
        "wrist_link" => "wrist_flex".to_owned(),
        "gripper_link" => "wrist_roll".to_owned(),
        "moving_jaw_so101_v1_link" => "gripper".to_owned(),
        foot if foot.ends_with("_foot") => format!("{foot}_fixed"),
        body => format!("{body}_joint"),
    };
    bodies.iter().enumerate().map(joint).collect()
}

/// The frames of its file that are known here: the tool's of an SO-101.
pub fn frames(robot: &str) -> Vec<Frame> {
    let tool = || Frame {
        name: "gripper_frame_link".to_owned(),
        body: Some(4),
        xyz: [-0.0079, -0.000218121, -0.0981274],
        attitude: Attitude::QuarterTurns([0, 2, 0]),
    };
    if robot == "so101" { vec![tool()] } else { Vec::new() }
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
