//! An arm on a satellite.

use core::f64::consts::PI;

use dynamics_core::model::{BASE, Body, Joint, JointLimits, Model, Robot};
use dynamics_core::state::State;

/// A satellite of 140 kg that floats free and carries an arm of 6 joints: 2 m of reach, 23 kg with
/// its hand.
///
/// The numbers are ours, of the size of small servicing satellites. The satellite's centre of mass
/// is the origin of its frame; the arm stands on its top, and lies along x at q = 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpaceArm;

/// Joints 1 to 3.
const LARGE: JointLimits<f64> = limits(80.0);
/// Joints 4 to 6, the wrist.
const SMALL: JointLimits<f64> = limits(16.0);

const fn limits(torque: f64) -> JointLimits<f64> {
    JointLimits { lower: -PI, upper: PI, velocity: 1.5, torque }
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

impl Robot<7, 13, 12> for SpaceArm {
    const MODEL: Model<f64, 7, 13, 12> = Model::new(
        "space_arm",
        [
            Body::new("satellite", BASE, Joint::free())
                .mass(140.0)
                .inertia([28.0, 0.6, -0.4, 26.0, 0.3, 24.0]),
            Body::new("shoulder", 0, Joint::revolute(Z))
                .xyz([0.35, 0.0, 0.6])
                .mass(3.6)
                .com([0.0, 0.01, 0.07])
                .inertia([0.014, 0.0, 0.0, 0.013, 0.0, 0.010])
                .limits(LARGE),
            Body::new("upper_arm", 1, Joint::revolute(Y))
                .xyz([0.0, 0.0, 0.14])
                .mass(6.2)
                .com([0.42, 0.015, 0.0])
                .inertia([0.018, 0.0, 0.0, 0.46, 0.0, 0.46])
                .limits(LARGE),
            Body::new("forearm", 2, Joint::revolute(Y))
                .xyz([0.9, 0.0, 0.0])
                .mass(4.6)
                .com([0.36, -0.01, 0.0])
                .inertia([0.012, 0.0, 0.0, 0.28, 0.0, 0.28])
                .limits(LARGE),
            Body::new("wrist_pitch", 3, Joint::revolute(Y))
                .xyz([0.8, 0.0, 0.0])
                .mass(2.3)
                .com([0.06, 0.0, 0.0])
                .inertia([0.004, 0.0, 0.0, 0.006, 0.0, 0.006])
                .limits(SMALL),
            Body::new("wrist_yaw", 4, Joint::revolute(Z))
                .xyz([0.14, 0.0, 0.0])
                .mass(2.1)
                .com([0.05, 0.0, 0.0])
                .inertia([0.004, 0.0, 0.0, 0.005, 0.0, 0.005])
                .limits(SMALL),
            Body::new("hand", 5, Joint::revolute(X))
                .xyz([0.12, 0.0, 0.0])
                .mass(4.2)
                .com([0.11, 0.0, 0.02])
                .inertia([0.016, 0.0, 0.002, 0.034, 0.0, 0.032])
                .limits(SMALL),
        ],
    );
}

const _: Model<f64, 7, 13, 12> = SpaceArm::MODEL;

impl SpaceArm {
    /// The configuration with the satellite at the origin, level.
    pub const fn at(joints: [f32; 6]) -> [f32; 13] {
        let [a, b, c, d, e, f] = joints;
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, a, b, c, d, e, f]
    }

    /// Something of every joint, and nothing of the satellite.
    pub const fn joints(joints: [f32; 6]) -> [f32; 12] {
        let [a, b, c, d, e, f] = joints;
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, a, b, c, d, e, f]
    }

    /// The state of these joints on a satellite at rest at the origin.
    pub const fn floating(joints: &State<f32, 6, 6>) -> State<f32, 13, 12> {
        State { q: Self::at(joints.q), qd: Self::joints(joints.qd), qdd: Self::joints(joints.qdd) }
    }
}
