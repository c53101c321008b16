//! Kinova Gen3.

use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Kinova Gen3 with 7 joints and vision module, no gripper: joints 1, 3, 5 and 7 are continuous;
/// 6.5 kg of moving mass.
///
/// # Source
///
/// - Kinovarobotics/ros_kortex at commit 5fce8b7a,
///   `kortex_description/arms/gen3/7dof/urdf/gen3_macro.xacro` (`vision` true): kinematics,
///   inertias, limits. Licence: BSD-3-Clause.
/// - The same masses, centres of mass and placements stand in mujoco_menagerie
///   (`kinova_gen3/gen3.xml`, commit 39664247), the inertias there by principal moments. It limits
///   joints 2, 4, 6 to 2.24, 2.57 and 2.09 rad.
///
/// # Changed
///
/// Rotations are exact quarter turns where the source rounds (1.5708). The base link is omitted
/// since it does not move, the end effector's frame since it has no mass.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gen3;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn limits(position: f64, velocity: f64, torque: f64) -> JointLimits<f64> {
    JointLimits { lower: -position, upper: position, velocity, torque }
}

/// A large joint's limits.
const fn large(position: f64) -> JointLimits<f64> {
    limits(position, 1.3963, 39.0)
}

/// A wrist joint's limits.
const fn small(position: f64) -> JointLimits<f64> {
    limits(position, 1.2218, 9.0)
}

const ENDLESS: f64 = f64::INFINITY;

impl Robot<7, 7, 7> for Gen3 {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "gen3",
        [
            Body::new("shoulder", BASE, Joint::continuous(Z))
                .xyz([0.0, 0.0, 0.15643])
                .quarter_turns([2, 0, 0])
                .mass(1.3773)
                .com([-2.3e-5, -0.010364, -0.07336])
                .inertia([0.00457, 1e-6, 2e-6, 0.004831, 0.000448, 0.001409])
                .limits(large(ENDLESS)),
            Body::new("half_arm_1", 0, Joint::revolute(Z))
                .xyz([0.0, 0.005375, -0.12838])
                .quarter_turns([1, 0, 0])
                .mass(1.1636)
                .com([-4.4e-5, -0.09958, -0.013278])
                .inertia([0.011088, 5e-6, 0.0, 0.001072, -0.000691, 0.011255])
                .limits(large(2.41)),
            Body::new("half_arm_2", 1, Joint::continuous(Z))
                .xyz([0.0, -0.21038, -0.006375])
                .quarter_turns([-1, 0, 0])
                .mass(1.1636)
                .com([-4.4e-5, -0.006641, -0.117892])
                .inertia([0.010932, 0.0, -7e-6, 0.011127, 0.000606, 0.001043])
                .limits(large(ENDLESS)),
            Body::new("forearm", 2, Joint::revolute(Z))
                .xyz([0.0, 0.006375, -0.21038])
                .quarter_turns([1, 0, 0])
                .mass(0.9302)
                .com([-1.8e-5, -0.075478, -0.015006])
                .inertia([0.008147, -1e-6, 0.0, 0.000631, -0.0005, 0.008316])
                .limits(large(2.66)),
            Body::new("wrist_1", 3, Joint::continuous(Z))
                .xyz([0.0, -0.20843, -0.006375])
                .quarter_turns([-1, 0, 0])
                .mass(0.6781)
                .com([1e-6, -0.009432, -0.063883])
                .inertia([0.001596, 0.0, 0.0, 0.001607, 0.000256, 0.000399])
                .limits(small(ENDLESS)),
            Body::new("wrist_2", 4, Joint::revolute(Z))
                .xyz([0.0, 0.00017505, -0.10593])
                .quarter_turns([1, 0, 0])
                .mass(0.6781)
                .com([1e-6, -0.045483, -0.00965])
                .inertia([0.001641, 0.0, 0.0, 0.00041, -0.000278, 0.001641])
                .limits(small(2.23)),
            Body::new("bracelet", 5, Joint::continuous(Z))
                .xyz([0.0, -0.10593, -0.00017505])
                .quarter_turns([-1, 0, 0])
                .mass(0.5)
                .com([0.000281, 0.011402, -0.029798])
                .inertia([0.000587, 3e-6, 3e-6, 0.000369, -0.000118, 0.000609])
                .limits(small(ENDLESS)),
        ],
    );
}

const _: ArmModel<f64, 7> = Gen3::MODEL;
