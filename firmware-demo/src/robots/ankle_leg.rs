//! A shank with a parallel ankle.

use core::f64::consts::PI;

use dynamics_core::clusters::{Branch, ClusteredRobot, Driven, ParallelAnkle, Rod};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Knee and ankle, 4.4 kg, 0.35 m: two motors at the shank pitch and roll the foot by rods.
///
/// The numbers are assumed, of the size of legs of humanoids. The tree's coordinates are the knee,
/// pitch and roll of the ankle, and for each motor its crank and the two of its rod; the
/// independent ones knee, pitch, roll. The rods are bodies.
#[derive(Clone, Copy, Debug, Default)]
pub struct AnkleLeg;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// The centre of the ankle in the shank.
const ANKLE: f64 = -0.35;

pub const RODS: [Rod; 2] = [rod(0.035, 0.15, 0.16), rod(-0.035, 0.25, 0.26)];

const fn rod(side: f64, height: f64, length: f64) -> Rod {
    Rod {
        joint: [-0.01, side, height],
        crank: [-0.04, 0.0, 0.0],
        foot: [-0.045, 0.9 * side, -0.01],
        length,
        branch: Branch::Negative,
    }
}

const LIMITS: JointLimits<f64> =
    JointLimits { lower: -PI, upper: PI, velocity: 20.0, torque: 100.0 };

const fn crank(name: &'static str, parent: usize, rod: &Rod) -> Body {
    let [x, y, z] = rod.joint;
    Body::new(name, parent, Joint::revolute(Y))
        .xyz([x, y, ANKLE + z])
        .mass(0.2)
        .com([-0.015, 0.0, 0.0])
        .inertia([0.00004, 0.0, 0.0, 0.00009, 0.0, 0.00007])
        .limits(LIMITS)
}

/// The massless body between a rod's two axes.
const fn cross(name: &'static str, parent: usize, rod: &Rod) -> Body {
    Body::new(name, parent, Joint::revolute(Y)).xyz(rod.crank).limits(LIMITS)
}

const fn bar(name: &'static str, parent: usize, rod: &Rod) -> Body {
    let about = 0.12 * rod.length * rod.length / 12.0;
    Body::new(name, parent, Joint::revolute(X))
        .mass(0.12)
        .com([0.0, 0.001, -0.5 * rod.length])
        .inertia([about, 0.0, 0.0, about, 0.0, 0.000002])
        .limits(LIMITS)
}

impl AnkleLeg {
    /// The bodies, the shank being on this joint.
    pub const fn bodies(shank: Joint<f64>) -> [Body; 9] {
        let [left, right] = &RODS;
        [
            Body::new("shank", BASE, shank)
                .xyz([0.0, 0.0, 0.5])
                .mass(2.8)
                .com([0.004, 0.002, -0.14])
                .inertia([0.03, 0.0001, 0.0005, 0.03, 0.0, 0.004])
                .limits(LIMITS),
            Body::new("cross", 0, Joint::revolute(Y))
                .xyz([0.0, 0.0, ANKLE])
                .mass(0.08)
                .inertia([0.00002, 0.0, 0.0, 0.00001, 0.0, 0.00002])
                .limits(LIMITS),
            Body::new("foot", 1, Joint::revolute(X))
                .mass(0.9)
                .com([0.04, 0.002, -0.03])
                .inertia([0.0009, 0.0001, 0.0002, 0.0035, 0.0, 0.0033])
                .limits(LIMITS),
            crank("left_crank", 0, left),
            cross("left_cross", 3, left),
            bar("left_rod", 4, left),
            crank("right_crank", 0, right),
            cross("right_cross", 6, right),
            bar("right_rod", 7, right),
        ]
    }
}

impl Robot<9, 9, 9> for AnkleLeg {
    const MODEL: ArmModel<f64, 9> = Model::new("ankle_leg", Self::bodies(Joint::revolute(Y)));
}

impl ClusteredRobot<9, 9, 9, 3, 3> for AnkleLeg {
    type Clusters = (Driven<ParallelAnkle, 8, 2>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("ankle", ParallelAnkle::new(RODS)).actuated([2, 5]),);
    const COORDINATES: &'static [&'static [usize]] = &[&[1, 2, 3, 4, 5, 6, 7, 8]];
}

const _: ArmModel<f64, 9> = AnkleLeg::MODEL;
