//! A SCARA with 600 mm of reach.

use core::f64::consts::{PI, TAU};

use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// A SCARA that serves a table: three vertical revolute axes, 325 mm + 275 mm, its quill locked at
/// half its stroke with 2 kg of hand and part, held off the axis.
///
/// Our own numbers, of the size of common 600 mm machines: reach, ranges and speeds as in their
/// data sheets, masses and torques as their weight and motors suggest. The motors of quill and
/// elbow sit on the forearm.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scara;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// ± `position`, rad.
const fn limits(position: f64, velocity: f64, torque: f64) -> JointLimits<f64> {
    JointLimits { lower: -position, upper: position, velocity, torque }
}

impl Robot<3, 3, 3> for Scara {
    const MODEL: ArmModel<f64, 3> = Model::new(
        "scara",
        [
            Body::new("arm", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.21])
                .mass(5.0)
                .com([0.15, 0.0, 0.02])
                .inertia([0.012, 0.0, 0.0, 0.06, 0.0, 0.06])
                .limits(limits(105.0 * PI / 180.0, 6.7, 220.0)),
            Body::new("forearm", 0, Joint::revolute(Z))
                .xyz([0.325, 0.0, 0.06])
                .mass(6.0)
                .com([0.11, 0.0, 0.08])
                .inertia([0.03, 0.0, -0.005, 0.08, 0.0, 0.07])
                .limits(limits(150.0 * PI / 180.0, 12.5, 90.0)),
            Body::new("quill", 1, Joint::revolute(Z))
                .xyz([0.275, 0.0, 0.0])
                .mass(2.5)
                .com([0.015, 0.01, -0.16])
                .inertia([0.02, 0.0, 0.001, 0.02, 0.0, 0.006])
                .limits(limits(TAU, 21.0, 12.0)),
        ],
    );
}

const _: ArmModel<f64, 3> = Scara::MODEL;
