//! Franka Emika Panda.

use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Franka Emika Panda without its hand: 7 revolute joints, every inertia dense.
///
/// The parameters were identified from motion (Gaz, Cognetti, Oliva, Robuffo Giordano, De Luca, "Dynamic
/// Identification of the Franka Emika Panda Robot With Retrieval of Feasible Parameters Using
/// Penalty-Based Optimization", IEEE Robotics and Automation Letters 4(4), 2019). Such a fit fixes only
/// the combinations that the torques depend on, so a single link's numbers need not look like that link:
/// 0.70 kg m² for link 1 is not its real inertia. Link 2 satisfies the triangle inequality of its
/// principal moments by 1.7e-6 kg m², which is 5.5e-5 of the largest of them.
///
/// # Source
///
/// - Inertias: frankaemika/franka_ros at commit b2a62ff6, `franka_description/robots/common/inertial.yaml`;
///   kinematics: `robots/common/franka_arm.xacro`; limits: `robots/panda/joint_limits.yaml` of the same
///   commit. Licence: Apache-2.0.
/// - The same numbers stand in the PyPI package example-robot-data 6.0.0 and in mujoco_menagerie
///   (`franka_emika_panda/panda_nohand.xml`, commit 251ca9e8).
///
/// # Changed
///
/// Rotations are exact quarter turns. Link 0 is omitted since it does not move, link 8 since it has no
/// mass, the hand and its fingers since the flange is where a user mounts a tool.
#[derive(Clone, Copy, Debug, Default)]
pub struct Panda;

/// Joints 1, 3: ±166°.
const SHOULDER: JointLimits<f64> = JointLimits {
    lower: -2.8973,
    upper: 2.8973,
    velocity: 2.175,
    torque: 87.0,
};
/// Joints 5, 7.
const WRIST: JointLimits<f64> = JointLimits {
    lower: -2.8973,
    upper: 2.8973,
    velocity: 2.61,
    torque: 12.0,
};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

impl Robot<7, 7, 7> for Panda {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "panda",
        [
            Body::new("link1", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.333])
                .mass(4.970684)
                .com([0.003875, 0.002081, -0.04762])
                .inertia([0.70337, -0.000139, 0.006772, 0.70661, 0.019169, 0.009117])
                .limits(SHOULDER),
            Body::new("link2", 0, Joint::revolute(Z))
                .quarter_turns([-1, 0, 0])
                .mass(0.646926)
                .com([-0.003141, -0.02872, 0.003495])
                .inertia([0.007962, -0.003925, 0.010254, 0.02811, 0.000704, 0.025995])
                .limits(JointLimits {
                    lower: -1.7628,
                    upper: 1.7628,
                    velocity: 2.175,
                    torque: 87.0,
                }),
            Body::new("link3", 1, Joint::revolute(Z))
                .xyz([0.0, -0.316, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(3.228604)
                .com([0.027518, 0.039252, -0.066502])
                .inertia([0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083])
                .limits(SHOULDER),
            Body::new("link4", 2, Joint::revolute(Z))
                .xyz([0.0825, 0.0, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(3.587895)
                .com([-0.05317, 0.104419, 0.027454])
                .inertia([0.025853, 0.007796, -0.001332, 0.019552, 0.008641, 0.028323])
                .limits(JointLimits {
                    lower: -3.0718,
                    upper: -0.0698,
                    velocity: 2.175,
                    torque: 87.0,
                }),
            Body::new("link5", 3, Joint::revolute(Z))
                .xyz([-0.0825, 0.384, 0.0])
                .quarter_turns([-1, 0, 0])
                .mass(1.225946)
                .com([-0.011953, 0.041065, -0.038437])
                .inertia([0.035549, -0.002117, -0.004037, 0.029474, 0.000229, 0.008627])
                .limits(WRIST),
            Body::new("link6", 4, Joint::revolute(Z))
                .quarter_turns([1, 0, 0])
                .mass(1.666555)
                .com([0.060149, -0.014117, -0.010517])
                .inertia([0.001964, 0.000109, -0.001158, 0.004354, 0.000341, 0.005433])
                .limits(JointLimits {
                    lower: -0.0175,
                    upper: 3.7525,
                    velocity: 2.61,
                    torque: 12.0,
                }),
            Body::new("link7", 5, Joint::revolute(Z))
                .xyz([0.088, 0.0, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(0.735522)
                .com([0.010517, -0.004252, 0.061597])
                .inertia([
                    0.012516, -0.000428, -0.001196, 0.010027, -0.000741, 0.004815,
                ])
                .limits(WRIST),
        ],
    );
}

const _: ArmModel<f64, 7> = Panda::MODEL;
