//! Unitree A1 with its trunk held, and free.

use core::f64::consts::PI;

use crate::model::{BASE, Body, Joint, JointLimits, Model, Robot, attach_to};

/// Unitree A1 quadruped with its trunk welded to the base: a tree of four equal legs, 12 revolute
/// joints.
///
/// Each leg is hip (about x), thigh and calf (about y), and a foot on a fixed joint, in the order
/// front right, front left, rear right, rear left. The base frame is the trunk's: x ahead, y left,
/// z up.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/a1_description/urdf/a1.urdf`, which states
///   as its origin unitreerobotics/unitree_ros (`robots/a1_description`; the leg numbers at commit
///   0cbd88ee are the same) and MPL-2.0 as the licence; mujoco_menagerie publishes its derivative
///   under BSD-3-Clause.
/// - Masses, centres of mass and inertias of the legs agree with mujoco_menagerie
///   (`unitree_a1/a1.xml`, commit 1b428b08: calf and foot lumped there). It differs in where a leg
///   sits: hip at x = 0.183 m instead of 0.1805 m, thigh at 0.08505 m instead of 0.0838 m. Another
///   revision of unitree_ros (xacro constants at 49e936b9) has lighter legs: 0.595, 0.888 and 0.151
///   kg.
///
/// # Changed
///
/// Not written by `robot-import`: three robots share the legs. The legs are written once and
/// mirrored, since the source's four are exact mirror images. Omitted are the trunk since it does
/// not move, the IMU (1 g, with the inertia of a placeholder), and the shoulder links since they
/// have no mass. The foot's inertia is 2/5 m r² of a 20 mm sphere, which the source prints as
/// 9.600000000000001e-06. Limits are the degrees of the source's constants.
#[derive(Clone, Copy, Debug, Default)]
pub struct A1;

/// From `lower` to `upper` degrees; all motors are the same.
const fn limits(lower: f64, upper: f64) -> JointLimits<f64> {
    JointLimits {
        lower: lower * PI / 180.0,
        upper: upper * PI / 180.0,
        velocity: 21.0,
        torque: 33.5,
    }
}

/// `ahead`: 1 for a front leg, -1 for a rear one. `left`: 1 for a left leg, -1 for a right one.
const fn hip(name: &'static str, ahead: f64, left: f64) -> Body {
    Body::new(name, BASE, Joint::revolute([1.0, 0.0, 0.0]))
        .xyz([ahead * 0.1805, left * 0.047, 0.0])
        .mass(0.696)
        .com([ahead * -0.003311, left * 0.000635, 0.000031])
        .inertia([
            0.000469246,
            ahead * left * -0.000009409,
            ahead * -0.000000342,
            0.00080749,
            left * -0.000000466,
            0.000552929,
        ])
        .limits(limits(-46.0, 46.0))
}

const fn thigh(name: &'static str, parent: usize, left: f64) -> Body {
    Body::new(name, parent, Joint::revolute([0.0, 1.0, 0.0]))
        .xyz([0.0, left * 0.0838, 0.0])
        .mass(1.013)
        .com([-0.003237, left * -0.022327, -0.027326])
        .inertia([
            0.005529065,
            left * 0.000004825,
            0.000343869,
            0.005139339,
            left * 0.000022448,
            0.001367788,
        ])
        .limits(limits(-60.0, 240.0))
}

const fn calf(name: &'static str, parent: usize) -> Body {
    Body::new(name, parent, Joint::revolute([0.0, 1.0, 0.0]))
        .xyz([0.0, 0.0, -0.2])
        .mass(0.166)
        .com([0.006435, 0.0, -0.107388])
        .inertia([0.002997972, 0.0, -0.000141163, 0.003014022, 0.0, 0.000032426])
        .limits(limits(-154.5, -52.5))
}

const fn foot(name: &'static str, parent: usize) -> Body {
    Body::new(name, parent, Joint::fixed())
        .xyz([0.0, 0.0, -0.2])
        .mass(0.06)
        .inertia([0.0000096, 0.0, 0.0, 0.0000096, 0.0, 0.0000096])
}

/// The legs on the trunk.
const LEGS: [Body; 16] = [
    hip("FR_hip", 1.0, -1.0),
    thigh("FR_thigh", 0, -1.0),
    calf("FR_calf", 1),
    foot("FR_foot", 2),
    hip("FL_hip", 1.0, 1.0),
    thigh("FL_thigh", 4, 1.0),
    calf("FL_calf", 5),
    foot("FL_foot", 6),
    hip("RR_hip", -1.0, -1.0),
    thigh("RR_thigh", 8, -1.0),
    calf("RR_calf", 9),
    foot("RR_foot", 10),
    hip("RL_hip", -1.0, 1.0),
    thigh("RL_thigh", 12, 1.0),
    calf("RL_calf", 13),
    foot("RL_foot", 14),
];

impl A1 {
    /// The front right leg alone, for machines that stand on one: hip, thigh, calf and foot, the
    /// hip where it is on a trunk.
    ///
    /// ```
    /// use dynamics_core::model::{BASE, Body, Joint, Model, attach_to};
    /// use dynamics_core::robots::A1;
    /// const CARRIAGE: Body = Body::new("carriage", BASE, Joint::prismatic([0.0, 0.0, 1.0])).mass(1.5);
    /// const HOPPER: Model<f64, 5, 4, 4> = Model::new("hopper", attach_to(CARRIAGE, &A1::LEG));
    /// assert_eq!(HOPPER.links[4].name, "FR_foot");
    /// ```
    pub const LEG: [Body; 4] = [LEGS[0], LEGS[1], LEGS[2], LEGS[3]];
}

impl Robot<16, 12, 12> for A1 {
    const MODEL: Model<f64, 16, 12, 12> = Model::new("a1", LEGS);
}

const _: Model<f64, 16, 12, 12> = A1::MODEL;

/// The front right leg of [`A1`] alone, its hip on the base: 3 revolute joints and a fixed foot.
#[derive(Clone, Copy, Debug, Default)]
pub struct A1Leg;

impl Robot<4, 3, 3> for A1Leg {
    const MODEL: Model<f64, 4, 3, 3> = Model::new("a1_leg", A1::LEG);
}

const _: Model<f64, 4, 3, 3> = A1Leg::MODEL;

/// Unitree A1 on a free joint: the trunk of 6 kg, then the legs of [`A1`]; 17 bodies, 18 degrees of
/// freedom.
///
/// Source and licence as [`A1`]; mujoco_menagerie gives the trunk 4.713 kg.
#[derive(Clone, Copy, Debug, Default)]
pub struct A1Free;

const TRUNK: Body = Body::new("trunk", BASE, Joint::free())
    .mass(6.0)
    .com([0.0, 0.0041, -0.0005])
    .inertia([0.0158533, -0.0000366, -0.0000611, 0.0377999, -0.0000275, 0.0456542]);

impl Robot<17, 19, 18> for A1Free {
    const MODEL: Model<f64, 17, 19, 18> = Model::new("a1_free", attach_to(TRUNK, &LEGS));
}

const _: Model<f64, 17, 19, 18> = A1Free::MODEL;
