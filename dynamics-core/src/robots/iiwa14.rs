//! KUKA LBR iiwa 14.

use core::f64::consts::PI;

use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// KUKA LBR iiwa 14 R820: 7 revolute joints, 25.6 kg of moving mass, diagonal inertias.
///
/// # Source
///
/// - Kinematics, inertias, limits: Drake (RobotLocomotion/drake at commit 0b6a9c38,
///   `manipulation/models/iiwa_description/urdf/iiwa14_no_collision.urdf`), which took the
///   kinematics and centres of mass from iiwa_stack and adjusted masses and inertias. Licence:
///   BSD-3-Clause for both Drake and its derivative in mujoco_menagerie (`kuka_iiwa_14/iiwa14.xml`,
///   commit 28ffb48b), which has the same numbers except that it swaps the first two moments of
///   link 1 (0.0330, 0.0333).
/// - iiwa_stack's own masses (4, 4, 3, 2.7, 1.7, 1.8, 0.3 kg) are lower. The maker publishes no
///   inertias; its brochure is where Drake's speed and torque limits come from.
///
/// # Changed
///
/// Rotations are exact quarter turns; position limits are the degrees that the source had rounded
/// (170, 120, 175). Link 0 is omitted since it does not move, the flange frames since they have no
/// mass.
#[derive(Clone, Copy, Debug, Default)]
pub struct Iiwa14;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// ± `position` degrees, `speed` in degrees per second, N m.
const fn limits(position: f64, speed: f64, torque: f64) -> JointLimits<f64> {
    JointLimits {
        lower: -position * PI / 180.0,
        upper: position * PI / 180.0,
        velocity: speed * PI / 180.0,
        torque,
    }
}

impl Robot<7, 7, 7> for Iiwa14 {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "iiwa14",
        [
            Body::new("link_1", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.1575])
                .mass(5.76)
                .com([0.0, -0.03, 0.12])
                .inertia([0.033, 0.0, 0.0, 0.0333, 0.0, 0.0123])
                .limits(limits(170.0, 85.0, 320.0)),
            Body::new("link_2", 0, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.2025])
                .quarter_turns([1, 0, 2])
                .mass(6.35)
                .com([0.0003, 0.059, 0.042])
                .inertia([0.0305, 0.0, 0.0, 0.0304, 0.0, 0.011])
                .limits(limits(120.0, 85.0, 320.0)),
            Body::new("link_3", 1, Joint::revolute(Z))
                .xyz([0.0, 0.2045, 0.0])
                .quarter_turns([1, 0, 2])
                .mass(3.5)
                .com([0.0, 0.03, 0.13])
                .inertia([0.025, 0.0, 0.0, 0.0238, 0.0, 0.0076])
                .limits(limits(170.0, 100.0, 176.0)),
            Body::new("link_4", 2, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.2155])
                .quarter_turns([1, 0, 0])
                .mass(3.5)
                .com([0.0, 0.067, 0.034])
                .inertia([0.017, 0.0, 0.0, 0.0164, 0.0, 0.006])
                .limits(limits(120.0, 75.0, 176.0)),
            Body::new("link_5", 3, Joint::revolute(Z))
                .xyz([0.0, 0.1845, 0.0])
                .quarter_turns([-1, 2, 0])
                .mass(3.5)
                .com([0.0001, 0.021, 0.076])
                .inertia([0.01, 0.0, 0.0, 0.0087, 0.0, 0.00449])
                .limits(limits(170.0, 130.0, 110.0)),
            Body::new("link_6", 4, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.2155])
                .quarter_turns([1, 0, 0])
                .mass(1.8)
                .com([0.0, 0.0006, 0.0004])
                .inertia([0.0049, 0.0, 0.0, 0.0047, 0.0, 0.0036])
                .limits(limits(120.0, 135.0, 40.0)),
            Body::new("link_7", 5, Joint::revolute(Z))
                .xyz([0.0, 0.081, 0.0])
                .quarter_turns([-1, 2, 0])
                .mass(1.2)
                .com([0.0, 0.0, 0.02])
                .inertia([0.001, 0.0, 0.0, 0.001, 0.0, 0.001])
                .limits(limits(175.0, 135.0, 40.0)),
        ],
    );
}

const _: ArmModel<f64, 7> = Iiwa14::MODEL;
