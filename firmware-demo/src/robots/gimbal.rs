//! A gimbal with a camera.

use core::f64::consts::PI;

use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// A camera of 22 kg that pans on a table, which a roll and a pitch axis keep level: 40 kg of
/// moving mass.
///
/// The numbers are ours, of the size of stabilised ship-borne cameras and small antennas. The axes
/// meet in a point; the camera's centre of mass is 8 cm above it and 4 cm beside the pan axis. At q
/// = 0 the axes are x, y and z of the base: forward, to port, up.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gimbal;

/// The tilt to either side of level.
const TILT: f64 = 35.0 * PI / 180.0;

const fn limits(range: f64, torque: f64) -> JointLimits<f64> {
    JointLimits { lower: -range, upper: range, velocity: 2.0, torque }
}

impl Robot<3, 3, 3> for Gimbal {
    const MODEL: ArmModel<f64, 3> = Model::new(
        "gimbal",
        [
            Body::new("yoke", BASE, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.0, 0.0, 0.3])
                .mass(10.0)
                .com([-0.02, 0.0, 0.015])
                .inertia([0.42, 0.0, 0.01, 0.30, 0.0, 0.55])
                .limits(limits(TILT, 60.0)),
            Body::new("table", 0, Joint::revolute([0.0, 1.0, 0.0]))
                .mass(8.0)
                .com([0.0, 0.01, -0.03])
                .inertia([0.20, 0.0, 0.0, 0.16, 0.0, 0.31])
                .limits(limits(TILT, 60.0)),
            Body::new("camera", 1, Joint::revolute([0.0, 0.0, 1.0]))
                .mass(22.0)
                .com([0.035, 0.02, 0.08])
                .inertia([0.38, 0.02, 0.04, 0.62, 0.01, 0.55])
                .limits(limits(PI, 30.0)),
        ],
    );
}

const _: ArmModel<f64, 3> = Gimbal::MODEL;
