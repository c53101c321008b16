//! so101.
//!
//! # Source
//!
//! `so101.urdf`; it states no licence. Imported on 2026-11-21 by robot-import 0.1.0.
//!
//! # Changed
//!
//! - Joint `shoulder_pan`: y `-8.97657e-9` is 0.
//! - Joint `shoulder_pan`: roll `3.14159` is π.
//! - Joint `shoulder_pan`: pitch `4.18253e-17` is 0.
//! - Joint `shoulder_pan`: yaw `-3.14159` is -π.
//! - Joint `shoulder_lift`: roll `-1.5708` is -π/2.
//! - Joint `shoulder_lift`: pitch `-1.5708` is -π/2.
//! - Joint `elbow_flex`: z `1.73763e-16` is 0.
//! - Joint `elbow_flex`: roll `-3.63608e-16` is 0.
//! - Joint `elbow_flex`: pitch `8.74301e-16` is 0.
//! - Joint `elbow_flex`: yaw `1.5708` is π/2.
//! - Joint `wrist_flex`: z `3.62355e-17` is 0.
//! - Joint `wrist_flex`: roll `4.02456e-15` is 0.
//! - Joint `wrist_flex`: pitch `8.67362e-16` is 0.
//! - Joint `wrist_flex`: yaw `-1.5708` is -π/2.
//! - Joint `wrist_roll`: x `5.55112e-17` is 0.
//! - Joint `wrist_roll`: roll `1.5708` is π/2.
//! - Joint `wrist_roll`: yaw `3.14159` is π.
//! - Joint `gripper`: roll `1.5708` is π/2.
//! - Joint `gripper`: pitch `-5.24284e-08` is 0.
//! - Joint `gripper`: yaw `-1.41553e-15` is 0.
//! - Link `gripper_frame_link` and all that it carries are left out: 1e-9 kg.

#![allow(
    dead_code,
    reason = "not every program uses every constant of its robot"
)]
#![allow(clippy::approx_constant, reason = "numbers are those of the file")]

use ::core::f64::consts::{FRAC_PI_2, PI};

use ::dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use ::dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The number of bodies.
pub const B: usize = 6;
/// The number of position coordinates.
pub const Q: usize = 6;
/// The number of velocity coordinates.
pub const V: usize = 6;
/// The number of joints.
pub const N: usize = V;

/// The names of the bodies.
pub const BODIES: [&str; B] = [
    "shoulder_link",
    "upper_arm_link",
    "lower_arm_link",
    "wrist_link",
    "gripper_link",
    "moving_jaw_so101_v1_link",
];
/// The names of their joints.
pub const JOINTS: [&str; B] = [
    "shoulder_pan",
    "shoulder_lift",
    "elbow_flex",
    "wrist_flex",
    "wrist_roll",
    "gripper",
];

/// so101: 6 bodies on 6 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct So101;

impl Robot<6, 6, 6> for So101 {
    const MODEL: ArmModel<f64, 6> = Model::new(
        "so101",
        [
            Body::new("shoulder_link", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0388353, 0.0, 0.0624])
                .quarter_turns([2, 0, 2])
                .mass(0.100006)
                .com([-0.0307604, -1.66727e-5, -0.0252713])
                .inertia([
                    8.3759e-5,
                    7.55525e-8,
                    -1.16342e-6,
                    8.10403e-5,
                    1.54663e-7,
                    2.39783e-5,
                ])
                .limits(JointLimits {
                    lower: -1.91986,
                    upper: 1.91986,
                    velocity: 10.0,
                    torque: 10.0,
                }),
            Body::new("upper_arm_link", 0, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([-0.0303992, -0.0182778, -0.0542])
                .quarter_turns([0, -1, -1])
                .mass(0.103)
                .com([-0.0898471, -0.00838224, 0.0184089])
                .inertia([
                    4.08002e-5,
                    -1.97819e-5,
                    -4.03016e-8,
                    0.000147318,
                    8.97326e-9,
                    0.000142487,
                ])
                .limits(JointLimits {
                    lower: -1.74533,
                    upper: 1.74533,
                    velocity: 10.0,
                    torque: 10.0,
                }),
            Body::new("lower_arm_link", 1, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([-0.11257, -0.028, 0.0])
                .quarter_turns([0, 0, 1])
                .mass(0.104)
                .com([-0.0980701, 0.00324376, 0.0182831])
                .inertia([
                    2.87438e-5,
                    7.41152e-6,
                    1.26409e-6,
                    0.000159844,
                    -4.90188e-8,
                    0.00014529,
                ])
                .limits(JointLimits {
                    lower: -1.69,
                    upper: 1.69,
                    velocity: 10.0,
                    torque: 10.0,
                }),
            Body::new("wrist_link", 2, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([-0.1349, 0.0052, 0.0])
                .quarter_turns([0, 0, -1])
                .mass(0.079)
                .com([-0.000103312, -0.0386143, 0.0281156])
                .inertia([
                    3.68263e-5,
                    1.7893e-8,
                    -5.28128e-8,
                    2.5391e-5,
                    3.6412e-6,
                    2.1e-5,
                ])
                .limits(JointLimits {
                    lower: -1.65806,
                    upper: 1.65806,
                    velocity: 10.0,
                    torque: 10.0,
                }),
            Body::new("gripper_link", 3, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, -0.0611, 0.0181])
                .rpy([FRAC_PI_2, 0.0486795, PI])
                .mass(0.087)
                .com([0.000213627, 0.000245138, -0.025187])
                .inertia([
                    2.75087e-5,
                    -3.35241e-7,
                    -5.7352e-6,
                    4.33657e-5,
                    -5.17847e-8,
                    3.45059e-5,
                ])
                .limits(JointLimits {
                    lower: -2.74385,
                    upper: 2.84121,
                    velocity: 10.0,
                    torque: 10.0,
                }),
            Body::new(
                "moving_jaw_so101_v1_link",
                4,
                Joint::revolute([0.0, 0.0, 1.0]),
            )
            .xyz([0.0202, 0.0188, -0.0234])
            .quarter_turns([1, 0, 0])
            .mass(0.012)
            .com([-0.00157495, -0.0300244, 0.0192755])
            .inertia([
                6.61427e-6,
                -3.19807e-7,
                -5.90717e-9,
                1.89032e-6,
                -1.09945e-7,
                5.28738e-6,
            ])
            .limits(JointLimits {
                lower: -0.174533,
                upper: 1.74533,
                velocity: 10.0,
                torque: 10.0,
            }),
        ],
    );
}

// A robot with an impossible joint or a negative mass does not compile.
const _: ArmModel<f64, 6> = So101::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    width: Width::f32(0.02),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, V> = Armature([0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);

/// The rigid body's forces of inertia, and those effects that the description states.
pub type Forces = (Inertia, Coriolis);
/// With their parameters.
pub const FORCES: Forces = (Inertia, Coriolis);
/// All that acts on the robot.
pub type Scene = (Gravity, Forces);
/// On Earth, checked at this line.
pub const SCENE: Scene = ::dynamics_core::Core::<So101>::scene_f32((Gravity::EARTH, FORCES));
