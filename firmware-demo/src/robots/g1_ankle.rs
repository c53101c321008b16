//! The shank and the foot of a humanoid, with its parallel ankle.

use core::f64::consts::PI;

use dynamics_core::clusters::{Branch, ClusteredRobot, Driven, ParallelAnkle, Rod};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Knee and ankle of a Unitree G1, 2.8 kg, its thigh held upright: a motor at the knee, and two at
/// the shank that pitch and roll the foot by rods.
///
/// # Source
///
/// - Masses, inertias, and ranges of the left knee, cross and foot: those of
///   [`G1`](dynamics_core::robots::G1), which names its source.
/// - Motors: torques and speeds (7520-22 at the knee: 139 N·m, 20 rad/s; 5020 at the ankle, two of
///   them: 25 N·m, 37 rad/s) are those of mujocolab/mjlab, `g1_constants.py` ("Motor specs (from
///   Unitree)"), Apache-2.0.
///
/// # Changed
///
/// The source's roll axis is 17.6 mm below its pitch axis; here they meet at the pitch axis, with
/// the foot in its place.
///
/// # Assumed
///
/// The source has no rods. Their lengths and places fit the shank; the cranks and rods have 0.2 kg
/// together, which the source counts with the shank. The range of the cranks follows.
///
/// The tree's coordinates are those of [`AnkleLeg`](super::AnkleLeg).
#[derive(Clone, Copy, Debug, Default)]
pub struct G1Ankle;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// The centre of the ankle in the shank.
const ANKLE: [f64; 3] = [0.0, -9.4445e-5, -0.30001];

/// The distance of the source's roll axis below its pitch axis.
const ROLL_AXIS: f64 = 0.017558;

const RODS: [Rod; 2] = [rod(0.032, 0.12), rod(-0.032, 0.2)];

const fn rod(side: f64, height: f64) -> Rod {
    Rod {
        joint: [-0.005, side, height],
        crank: [-0.04, 0.0, 0.0],
        foot: [-0.045, 0.9 * side, -0.01],
        length: height + 0.01,
        branch: Branch::Negative,
    }
}

/// Degrees, N·m and rad/s.
const fn limits(lower: f64, upper: f64, torque: f64, velocity: f64) -> JointLimits<f64> {
    JointLimits { lower: lower * PI / 180.0, upper: upper * PI / 180.0, velocity, torque }
}

const fn crank(name: &'static str, rod: &Rod) -> Body {
    let [x, y, z] = rod.joint;
    Body::new(name, 0, Joint::revolute(Y))
        .xyz([ANKLE[0] + x, ANKLE[1] + y, ANKLE[2] + z])
        .mass(0.05)
        .com([-0.018, 0.0, 0.0])
        .inertia([0.000003, 0.0, 0.0, 0.00001, 0.0, 0.00001])
        .limits(limits(-75.0, 75.0, 25.0, 37.0))
}

/// A body without mass between the two axes of a rod.
const fn cross(name: &'static str, crank: usize, rod: &Rod) -> Body {
    Body::new(name, crank, Joint::revolute(Y)).xyz(rod.crank).limits(limits(-90.0, 90.0, 0.0, 37.0))
}

const fn bar(name: &'static str, cross: usize, rod: &Rod) -> Body {
    let about = 0.05 * rod.length * rod.length / 12.0;
    Body::new(name, cross, Joint::revolute(X))
        .mass(0.05)
        .com([0.0, 0.0, -0.5 * rod.length])
        .inertia([about, 0.0, 0.0, about, 0.0, 0.000001])
        .limits(limits(-90.0, 90.0, 0.0, 37.0))
}

impl G1Ankle {
    /// The motors' coordinates in the tree: knee, left crank, right crank.
    pub const MOTORS: [usize; 3] = [0, 3, 6];
}

/// Shank, cross and foot, then the drives.
const BODIES: [Body; 9] = [
    Body::new("shank", BASE, Joint::revolute(Y))
        .mass(1.932)
        .com([0.005457, 0.003964, -0.12074])
        .inertia([0.011329, 4.82e-5, -4.49e-5, 0.011277, -0.0007146, 0.0015168])
        .limits(limits(-5.0, 165.0, 139.0, 20.0)),
    Body::new("cross", 0, Joint::revolute(Y))
        .xyz(ANKLE)
        .mass(0.074)
        .com([-0.007269, 0.0, 0.011137])
        .inertia([8.4e-6, 0.0, -2.9e-6, 1.89e-5, 0.0, 1.26e-5])
        .limits(limits(-50.0, 30.0, 0.0, 30.0)),
    Body::new("foot", 1, Joint::revolute(X))
        .mass(0.608)
        .com([0.026505, 0.0, -0.016425 - ROLL_AXIS])
        .inertia([0.0002231, 2e-7, 8.91e-5, 0.0016161, -1e-7, 0.0016667])
        .limits(limits(-15.0, 15.0, 0.0, 30.0)),
    crank("left_crank", &RODS[0]),
    cross("left_cross", 3, &RODS[0]),
    bar("left_rod", 4, &RODS[0]),
    crank("right_crank", &RODS[1]),
    cross("right_cross", 6, &RODS[1]),
    bar("right_rod", 7, &RODS[1]),
];

impl Robot<9, 9, 9> for G1Ankle {
    const MODEL: ArmModel<f64, 9> = Model::new("g1_ankle", BODIES);
}

impl ClusteredRobot<9, 9, 9, 3, 3> for G1Ankle {
    type Clusters = (Driven<ParallelAnkle, 8, 2>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("ankle", ParallelAnkle::new(RODS)).actuated([2, 5]),);
    const COORDINATES: &'static [&'static [usize]] = &[&[1, 2, 3, 4, 5, 6, 7, 8]];
}

const _: ArmModel<f64, 9> = G1Ankle::MODEL;

/// The same leg as a chain of joints, without cranks and rods: a model that controllers and
/// simulations often use.
#[derive(Clone, Copy, Debug, Default)]
pub struct SerialAnkle;

impl Robot<3, 3, 3> for SerialAnkle {
    const MODEL: ArmModel<f64, 3> = Model::new("serial_ankle", [BODIES[0], BODIES[1], BODIES[2]]);
}

const _: ArmModel<f64, 3> = SerialAnkle::MODEL;
