//! A UR5e as the importer writes it, with the numbers of dynamics-core/src/robots/ur5e.rs, where their source and
//! licence are; friction and rotors are assumed.

use core::f64::consts::{PI, TAU};

use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The robot.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ur5e;

/// Joints 1 to 3, the large ones; the elbow turns half as far.
const LARGE: JointLimits<f64> = JointLimits {
    lower: -TAU,
    upper: TAU,
    velocity: PI,
    torque: 150.0,
};
const ELBOW: JointLimits<f64> = JointLimits {
    lower: -PI,
    upper: PI,
    velocity: PI,
    torque: 150.0,
};
/// Joints 4 to 6, the wrist.
const SMALL: JointLimits<f64> = JointLimits {
    lower: -TAU,
    upper: TAU,
    velocity: PI,
    torque: 28.0,
};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

impl Robot<6, 6, 6> for Ur5e {
    const MODEL: ArmModel<f64, 6> = Model::new(
        "ur5e",
        [
            Body::new("shoulder", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.1625])
                .mass(3.761)
                .com([0.0, -0.00193, -0.02561])
                .inertia([
                    0.0070021, 1.053e-5, 7.3e-7, 0.00657286, -4.9994e-4, 0.00648091,
                ])
                .limits(LARGE),
            Body::new("upper_arm", 0, Joint::revolute(Z))
                .quarter_turns([1, 0, 0])
                .mass(8.058)
                .com([-0.2125, 0.0, 0.11336])
                .inertia([
                    0.01505885, -5.4e-5, 5.63e-6, 0.33388086, -1.81e-6, 0.33247207,
                ])
                .limits(LARGE),
            Body::new("forearm", 1, Joint::revolute(Z))
                .xyz([-0.425, 0.0, 0.0])
                .mass(2.846)
                .com([-0.2422, 0.0, 0.0265])
                .inertia([
                    0.00399632, -1.365e-5, 0.00137272, 0.07879254, -6.6e-6, 0.0784851,
                ])
                .limits(ELBOW),
            Body::new("wrist_1", 2, Joint::revolute(Z))
                .xyz([-0.3922, 0.0, 0.1333])
                .mass(1.37)
                .com([0.0, -0.01634, -0.0018])
                .inertia([
                    0.00165491, 4.38e-6, -2.82e-6, 0.00126279, -1.0157e-4, 0.00135962,
                ])
                .limits(SMALL),
            Body::new("wrist_2", 3, Joint::revolute(Z))
                .xyz([0.0, -0.0997, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.3)
                .com([0.0, 0.01634, -0.0018])
                .inertia([
                    0.00135617, 4.44e-6, 2.74e-6, 9.6614e-4, 5.048e-5, 0.00127827,
                ])
                .limits(SMALL),
            Body::new("wrist_3", 4, Joint::revolute(Z))
                .xyz([0.0, 0.0996, 0.0])
                .quarter_turns([-1, 0, 0])
                .mass(0.365)
                .com([0.0, 0.0, -0.001159])
                .inertia([1.8694e-4, 6.0e-8, -1.7e-7, 1.8908e-4, -9.2e-7, 2.5756e-4])
                .limits(SMALL),
        ],
    );
}

const _: ArmModel<f64, 6> = Ur5e::MODEL;

use dynamics_core::effects::{Armature, Coulomb, Viscous, Width};
/// Velocity coordinates.
pub const N: usize = 6;
/// The joints, in the order of the coordinates.
pub const JOINTS: [&str; N] = [
    "shoulder_pan",
    "shoulder_lift",
    "elbow",
    "wrist_1",
    "wrist_2",
    "wrist_3",
];
/// The bodies that they move.
pub const BODIES: [&str; N] = [
    "shoulder",
    "upper_arm",
    "forearm",
    "wrist_1",
    "wrist_2",
    "wrist_3",
];
/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, N> = Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]);
/// Dry friction, N·m or N.
pub const COULOMB: Coulomb<f32, N> = Coulomb {
    torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2],
    width: Width::f32(0.05),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, N> = Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]);
