//! UFACTORY xArm7.

use core::f64::consts::{PI, TAU};

use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// UFACTORY xArm7: 7 revolute joints, 10.4 kg of moving mass, every inertia dense but the last.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/xarm_description/urdf/xarm7.urdf`, which states as
///   its origin xArm-Developer/xarm_ros2 and BSD-3-Clause as the licence.
///
/// # Changed
///
/// Rotations are exact quarter turns where the source rounds (1.5708), speeds 180°/s where it has 3.14 rad/s. The base link is omitted since it
/// does not move, the end effector's frame since it has no mass.
#[derive(Clone, Copy, Debug, Default)]
pub struct XArm7;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn limits(lower: f64, upper: f64, torque: f64) -> JointLimits<f64> {
    JointLimits {
        lower,
        upper,
        velocity: PI,
        torque,
    }
}

impl Robot<7, 7, 7> for XArm7 {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "xarm7",
        [
            Body::new("link1", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.267])
                .mass(2.382)
                .com([-0.0002, 0.02905, -0.01233])
                .inertia([
                    0.0056905,
                    -1.579e-5,
                    5.125e-6,
                    0.0049566,
                    -0.000873378,
                    0.003316654,
                ])
                .limits(limits(-TAU, TAU, 50.0)),
            Body::new("link2", 0, Joint::revolute(Z))
                .quarter_turns([-1, 0, 0])
                .mass(1.869)
                .com([0.00022, -0.12856, 0.01735])
                .inertia([
                    0.0095989,
                    1.541e-6,
                    5.56e-6,
                    0.00382472,
                    -0.00317156,
                    0.007565669,
                ])
                .limits(limits(-2.059, 2.0944, 50.0)),
            Body::new("link3", 1, Joint::revolute(Z))
                .xyz([0.0, -0.293, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.6383)
                .com([0.0466, -0.02463, -0.00768])
                .inertia([
                    0.00310955,
                    0.00030837,
                    -0.00058453,
                    0.00264483,
                    0.000338893,
                    0.0026624,
                ])
                .limits(limits(-TAU, TAU, 30.0)),
            Body::new("link4", 2, Joint::revolute(Z))
                .xyz([0.0525, 0.0, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.7269)
                .com([0.07047, -0.11575, 0.012])
                .inertia([
                    0.005889,
                    0.00137112,
                    0.00088143,
                    0.00359703,
                    -0.001762155,
                    0.00543244,
                ])
                .limits(limits(-0.19198, 3.927, 30.0)),
            Body::new("link5", 3, Joint::revolute(Z))
                .xyz([0.0775, -0.3425, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.3203)
                .com([-0.00032, 0.01604, -0.026])
                .inertia([
                    0.00534665,
                    1.5117e-5,
                    -3.69e-7,
                    0.0049779,
                    -0.00022132,
                    0.0013624,
                ])
                .limits(limits(-TAU, TAU, 30.0)),
            Body::new("link6", 4, Joint::revolute(Z))
                .quarter_turns([1, 0, 0])
                .mass(1.325)
                .com([0.06469, 0.03278, 0.02141])
                .inertia([
                    0.0014745, -0.000488, 0.0002953, 0.0019037, 0.00014749, 0.0023652,
                ])
                .limits(limits(-1.69297, PI, 20.0)),
            Body::new("link7", 5, Joint::revolute(Z))
                .xyz([0.076, 0.097, 0.0])
                .quarter_turns([-1, 0, 0])
                .mass(0.17)
                .com([0.0, -0.00677, -0.01098])
                .inertia([9.3e-5, 0.0, 0.0, 5.87e-5, -3.6e-6, 0.000132])
                .limits(limits(-TAU, TAU, 20.0)),
        ],
    );
}

const _: ArmModel<f64, 7> = XArm7::MODEL;
