//! A platform on six legs.

use core::f64::consts::PI;

use dynamics_core::clusters::{ClusteredRobot, Driven, Leg, Stewart};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// A platform on six legs, 23.8 kg, with motors at the slides of the legs, which are 0.8 m long at
/// zero.
///
/// The numbers are assumed, of the size of motion platforms for laboratories. The tree's
/// coordinates are the platform's position and attitude, and for each leg the two of its universal
/// joint and its slide; the independent ones those of the platform. Both halves of a leg are
/// bodies.
#[derive(Clone, Copy, Debug, Default)]
pub struct StewartPlatform;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
/// The upper half of a leg on the lower, m.
const SLIDE: f64 = 0.4;
/// The ball joint on the upper half, m.
const BALL: f64 = 0.4;

/// cos and sin of −10, 10, 110, 130, 230 and 250 degrees: the legs on the base.
pub const BELOW: [(f64, f64); 6] = [
    (0.984_807_753_012_208, -0.173_648_177_666_930_33),
    (0.984_807_753_012_208, 0.173_648_177_666_930_33),
    (-0.342_020_143_325_668_7, 0.939_692_620_785_908_3),
    (-0.642_787_609_686_539_4, 0.766_044_443_118_978),
    (-0.642_787_609_686_539_4, -0.766_044_443_118_978),
    (-0.342_020_143_325_668_7, -0.939_692_620_785_908_3),
];
/// The same of −50, 50, 70, 170, 190 and 290 degrees: the legs on the platform.
pub const ABOVE: [(f64, f64); 6] = [
    (0.642_787_609_686_539_4, -0.766_044_443_118_978),
    (0.642_787_609_686_539_4, 0.766_044_443_118_978),
    (0.342_020_143_325_668_7, 0.939_692_620_785_908_3),
    (-0.984_807_753_012_208, 0.173_648_177_666_930_33),
    (-0.984_807_753_012_208, -0.173_648_177_666_930_33),
    (0.342_020_143_325_668_7, -0.939_692_620_785_908_3),
];

pub const LEGS: [Leg; 6] = {
    let mut legs = [Leg { base: [0.0; 3], platform: [0.0; 3], length: SLIDE + BALL }; 6];
    let mut i = 0;
    while i < legs.len() {
        let ((below_x, below_y), (above_x, above_y)) = (BELOW[i], ABOVE[i]);
        legs[i].base = [0.5 * below_x, 0.5 * below_y, 0.0];
        legs[i].platform = [0.3 * above_x, 0.3 * above_y, 0.0];
        i += 1;
    }
    legs
};

const LIMITS: JointLimits<f64> =
    JointLimits { lower: -PI, upper: PI, velocity: 5.0, torque: 1000.0 };

/// A body without mass between two axes that meet.
const fn cross(name: &'static str, parent: usize, joint: Joint<f64>) -> Body {
    Body::new(name, parent, joint).limits(LIMITS)
}

const fn lower(name: &'static str, cross: usize) -> Body {
    Body::new(name, cross, Joint::revolute(X))
        .mass(1.5)
        .com([0.002, 0.0, 0.2])
        .inertia([0.02, 0.0, 0.0001, 0.02, 0.0, 0.001])
        .limits(LIMITS)
}

const fn upper(name: &'static str, lower: usize) -> Body {
    Body::new(name, lower, Joint::prismatic(Z))
        .xyz([0.0, 0.0, SLIDE])
        .mass(0.8)
        .com([0.0, 0.001, 0.15])
        .inertia([0.01, 0.0, 0.0, 0.01, 0.0001, 0.0005])
        .limits(LIMITS)
}

const fn foot(name: &'static str, leg: usize) -> Body {
    cross(name, BASE, Joint::revolute(Y)).xyz(LEGS[leg].base)
}

impl Robot<24, 24, 24> for StewartPlatform {
    const MODEL: ArmModel<f64, 24> = Model::new(
        "stewart_platform",
        [
            cross("along", BASE, Joint::prismatic(X)),
            cross("across", 0, Joint::prismatic(Y)),
            cross("up", 1, Joint::prismatic(Z)),
            cross("yaw", 2, Joint::revolute(Z)),
            cross("pitch", 3, Joint::revolute(Y)),
            Body::new("platform", 4, Joint::revolute(X))
                .mass(10.0)
                .com([0.02, -0.01, 0.05])
                .inertia([0.4, 0.01, 0.0, 0.4, 0.02, 0.7])
                .limits(LIMITS),
            foot("cross_a", 0),
            lower("lower_a", 6),
            upper("upper_a", 7),
            foot("cross_b", 1),
            lower("lower_b", 9),
            upper("upper_b", 10),
            foot("cross_c", 2),
            lower("lower_c", 12),
            upper("upper_c", 13),
            foot("cross_d", 3),
            lower("lower_d", 15),
            upper("upper_d", 16),
            foot("cross_e", 4),
            lower("lower_e", 18),
            upper("upper_e", 19),
            foot("cross_f", 5),
            lower("lower_f", 21),
            upper("upper_f", 22),
        ],
    );
}

impl ClusteredRobot<24, 24, 24, 6, 6> for StewartPlatform {
    type Clusters = (Driven<Stewart, 24, 6>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("legs", Stewart::new(LEGS)).actuated([8, 11, 14, 17, 20, 23]),);
    const COORDINATES: &'static [&'static [usize]] =
        &[&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23]];
}

const _: ArmModel<f64, 24> = StewartPlatform::MODEL;
