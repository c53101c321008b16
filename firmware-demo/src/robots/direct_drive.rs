//! An arm of low gear ratios.

use core::f64::consts::PI;

use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Three joints: a turret about z, a shoulder about y, and the roll of a cranked forearm about the
/// upper arm; 7.2 kg, 0.5 m reach. All numbers are assumed, of the size of direct-drive and
/// quasi-direct-drive arms.
///
/// A link's mass and inertia count the rotor of the motor that it carries: the turret that of the
/// shoulder, the upper arm that of the roll.
#[derive(Clone, Copy, Debug, Default)]
pub struct DirectDrive;

const fn limits(reach: f64, velocity: f64, torque: f64) -> JointLimits<f64> {
    JointLimits { lower: -reach, upper: reach, velocity, torque }
}

impl Robot<3, 3, 3> for DirectDrive {
    const MODEL: ArmModel<f64, 3> = Model::new(
        "direct_drive",
        [
            Body::new("turret", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, 0.0, 0.2])
                .mass(4.0)
                .com([0.0, 0.01, 0.08])
                .inertia([0.016, 0.0, 0.0, 0.014, 0.0, 0.012])
                .limits(limits(2.0 * PI, 12.0, 40.0)),
            Body::new("upper_arm", 0, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.0, 0.15])
                .mass(2.4)
                .com([0.1, 0.0, 0.005])
                .inertia([0.004, 0.0, 0.0, 0.018, 0.0, 0.018])
                .limits(limits(PI, 12.0, 40.0)),
            Body::new("forearm", 1, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.3, 0.0, 0.0])
                .mass(0.8)
                .com([0.09, 0.0, -0.04])
                .inertia([0.0022, 0.0, 0.0011, 0.0034, 0.0, 0.0019])
                .limits(limits(4.0 * PI, 25.0, 12.0)),
        ],
    );
}

const _: ArmModel<f64, 3> = DirectDrive::MODEL;
