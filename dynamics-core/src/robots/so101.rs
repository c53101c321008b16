//! The Robot Studio's SO-101.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// SO-101 follower arm with its gripper's jaw: 6 revolute joints, 0.49 kg of moving mass, 0.4 m reach.
///
/// The joints are shoulder pan, shoulder lift, elbow flex, wrist flex, wrist roll and the jaw, each moved by a servo of the
/// type STS3215 that stands on the joint's parent link.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/so_arm_description/urdf/so101.urdf` ("new calibration"), whose
///   README states as its origin github.com/TheRobotStudio/SO-ARM100 and Apache-2.0 as the licence.
///
/// # Changed
///
/// - Rotations are exact quarter turns where the source rounds (1.5708, 3.14159, or a remainder below 1e-7 rad), and offsets
///   below 1e-8 m are zero. Left as they are, they make no entry of a rotation zero. The 0.0486795 rad of the wrist's roll
///   are no rounding and are kept.
/// - The base link is omitted, since it does not move, and so is the gripper's tool frame with its placeholder of 1e-9 kg.
/// - The limits of 10 N·m and 10 rad/s are the source's placeholders: at 7.4 V the servo reaches 3.4 N·m and 6.1 rad/s.
#[derive(Clone, Copy, Debug, Default)]
pub struct So101;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn limits(lower: f64, upper: f64) -> JointLimits<f64> {
    JointLimits {
        lower,
        upper,
        velocity: 10.0,
        torque: 10.0,
    }
}

impl Robot<6, 6, 6> for So101 {
    const MODEL: ArmModel<f64, 6> = Model::new(
        "so101",
        [
            Body::new("shoulder", BASE, Joint::revolute(Z))
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
                .limits(limits(-1.91986, 1.91986)),
            Body::new("upper_arm", 0, Joint::revolute(Z))
                .xyz([-0.0303992, -0.0182778, -0.0542])
                .quarter_turns([-1, -1, 0])
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
                .limits(limits(-1.74533, 1.74533)),
            Body::new("lower_arm", 1, Joint::revolute(Z))
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
                .limits(limits(-1.69, 1.69)),
            Body::new("wrist", 2, Joint::revolute(Z))
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
                .limits(limits(-1.65806, 1.65806)),
            Body::new("gripper", 3, Joint::revolute(Z))
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
                .limits(limits(-2.74385, 2.84121)),
            Body::new("jaw", 4, Joint::revolute(Z))
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
                .limits(limits(-0.174533, 1.74533)),
        ],
    );
}

const _: ArmModel<f64, 6> = So101::MODEL;
