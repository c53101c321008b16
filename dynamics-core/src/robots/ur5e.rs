//! Universal Robots UR5e.

use core::f64::consts::{PI, TAU};

use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Universal Robots UR5e: 6 revolute joints, 17.7 kg of moving mass, 0.85 m reach, no tool.
///
/// The base frame is the controller's base: z up, and the one that `base_link` of the ROS
/// description becomes when turned half a turn about z.
///
/// # Source
///
/// - Kinematics, masses, centres of mass, inertias: the ROS package `ur_description`, files
///   `config/ur5e/default_kinematics.yaml` and `config/ur5e/physical_parameters.yaml`
///   (UniversalRobots/Universal_Robots_ROS2_Description since version 3.1.0, where the inertia
///   matrices were "updated from measurements"; the file of commit 3426d674 and the one of
///   ros-industrial/universal_robot at 82632f5e hold the same numbers). Licence: BSD-3-Clause.
/// - Masses, centres of mass and link lengths agree with the table of Denavit-Hartenberg parameters
///   that Universal Robots publishes. For the inertia matrices no second, independent source was
///   found.
/// - JointLimits: `config/ur5e/joint_limits.yaml` of the same package (user manual 5.8 and the
///   maker's page on joint torques).
///
/// # Changed
///
/// - Rotations are exact quarter turns where the source rounds (1.570796327), and the 2e-11 m
///   offsets that this rounding had left in the wrist are zero.
/// - The source gives the inertias of shoulder, wrist 1 and wrist 2 in axes a quarter turn from the
///   link's; they are turned into link axes here, which only swaps and negates entries.
/// - The base link, flange and tool frames are omitted: they do not move, or have no mass.
/// - The elbow turns ±360° by the manual; ±180° is the source's limit, kept because the upper arm
///   is in the way beyond it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ur5e;

/// Joints 1 to 3, the large ones; the elbow turns half as far.
const LARGE: JointLimits<f64> =
    JointLimits { lower: -TAU, upper: TAU, velocity: PI, torque: 150.0 };
const ELBOW: JointLimits<f64> = JointLimits { lower: -PI, upper: PI, velocity: PI, torque: 150.0 };
/// Joints 4 to 6, the wrist.
const SMALL: JointLimits<f64> = JointLimits { lower: -TAU, upper: TAU, velocity: PI, torque: 28.0 };

const Z: [f64; 3] = [0.0, 0.0, 1.0];

impl Robot<6, 6, 6> for Ur5e {
    const MODEL: ArmModel<f64, 6> = Model::new(
        "ur5e",
        [
            Body::new("shoulder", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.1625])
                .mass(3.761)
                .com([0.0, -0.00193, -0.02561])
                .inertia([0.0070021, 1.053e-5, 7.3e-7, 0.00657286, -4.9994e-4, 0.00648091])
                .limits(LARGE),
            Body::new("upper_arm", 0, Joint::revolute(Z))
                .quarter_turns([1, 0, 0])
                .mass(8.058)
                .com([-0.2125, 0.0, 0.11336])
                .inertia([0.01505885, -5.4e-5, 5.63e-6, 0.33388086, -1.81e-6, 0.33247207])
                .limits(LARGE),
            Body::new("forearm", 1, Joint::revolute(Z))
                .xyz([-0.425, 0.0, 0.0])
                .mass(2.846)
                .com([-0.2422, 0.0, 0.0265])
                .inertia([0.00399632, -1.365e-5, 0.00137272, 0.07879254, -6.6e-6, 0.0784851])
                .limits(ELBOW),
            Body::new("wrist_1", 2, Joint::revolute(Z))
                .xyz([-0.3922, 0.0, 0.1333])
                .mass(1.37)
                .com([0.0, -0.01634, -0.0018])
                .inertia([0.00165491, 4.38e-6, -2.82e-6, 0.00126279, -1.0157e-4, 0.00135962])
                .limits(SMALL),
            Body::new("wrist_2", 3, Joint::revolute(Z))
                .xyz([0.0, -0.0997, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.3)
                .com([0.0, 0.01634, -0.0018])
                .inertia([0.00135617, 4.44e-6, 2.74e-6, 9.6614e-4, 5.048e-5, 0.00127827])
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
