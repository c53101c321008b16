//! A Delta robot.

use core::f64::consts::{PI, TAU};

use dynamics_core::clusters::{ClusteredRobot, Delta, Driven};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// A Delta robot: three cranks with motors carry a platform by pairs of rods.
///
/// The numbers are assumed, of the size of pick-and-place machines. The tree's coordinates are, for
/// each arm, the crank and the two of its pair of rods, and the platform's position; the
/// independent ones the cranks. A pair of rods is one body, as [`Delta`] has it.
#[derive(Clone, Copy, Debug, Default)]
pub struct DeltaRobot;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
/// Radius of the cranks' joints, m.
const BASE_RADIUS: f64 = 0.2;
/// Crank and rods, m.
const CRANK: f64 = 0.2;
const ROD: f64 = 0.45;
/// Radius of the rods' ends on the platform, m.
const PLATFORM_RADIUS: f64 = 0.05;

const LIMITS: JointLimits<f64> =
    JointLimits { lower: -PI, upper: PI, velocity: 20.0, torque: 100.0 };

const fn crank(name: &'static str, side: usize) -> Body {
    let (sin, cos) = SIDES[side];
    Body::new(name, BASE, Joint::revolute(Y))
        .xyz([BASE_RADIUS * cos, BASE_RADIUS * sin, 0.0])
        .rpy([0.0, 0.0, side as f64 * TAU / 3.0])
        .mass(0.3)
        .com([0.1, 0.0, 0.005])
        .inertia([0.0002, 0.0, 0.00001, 0.001, 0.0, 0.001])
        .limits(LIMITS)
}

/// sin and cos of 0, 120 and 240 degrees.
const SIDES: [(f64, f64); 3] =
    [(0.0, 1.0), (0.866_025_403_784_438_6, -0.5), (-0.866_025_403_784_438_6, -0.5)];

/// The massless body between the axes of a pair of rods.
const fn cross(name: &'static str, crank: usize) -> Body {
    Body::new(name, crank, Joint::revolute(Y)).xyz([CRANK, 0.0, 0.0]).limits(LIMITS)
}

const fn rods(name: &'static str, cross: usize) -> Body {
    Body::new(name, cross, Joint::revolute(X))
        .mass(2.0 * 0.05)
        .com([0.0, 0.0, -0.5 * ROD])
        .inertia([2.0 * 0.0009, 0.0, 0.0, 2.0 * 0.0009, 0.0, 2.0 * 0.00001])
        .limits(LIMITS)
}

impl Robot<12, 12, 12> for DeltaRobot {
    const MODEL: ArmModel<f64, 12> = Model::new(
        "delta_robot",
        [
            crank("crank_a", 0),
            cross("cross_a", 0),
            rods("rods_a", 1),
            crank("crank_b", 1),
            cross("cross_b", 3),
            rods("rods_b", 4),
            crank("crank_c", 2),
            cross("cross_c", 6),
            rods("rods_c", 7),
            Body::new("along", BASE, Joint::prismatic(X)).limits(LIMITS),
            Body::new("across", 9, Joint::prismatic(Y)).limits(LIMITS),
            Body::new("platform", 10, Joint::prismatic(Z))
                .mass(0.4)
                .com([0.004, -0.003, -0.02])
                .inertia([0.0004, 0.00001, 0.0, 0.0004, 0.00002, 0.0006])
                .limits(LIMITS),
        ],
    );
}

impl ClusteredRobot<12, 12, 12, 3, 3> for DeltaRobot {
    type Clusters = (Driven<Delta, 12, 3>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("arms", Delta::new(BASE_RADIUS, CRANK, ROD, PLATFORM_RADIUS)),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]];
}

const _: ArmModel<f64, 12> = DeltaRobot::MODEL;
