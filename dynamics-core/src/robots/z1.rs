//! Unitree Z1.

use core::f64::consts::PI;

use super::welded_part::Part;
use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Unitree Z1 with its gripper: 6 revolute joints of the arm and the gripper's jaw, about x, y and z;
/// 4.7 kg of moving mass.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/z1_description/urdf/z1.urdf`, which states as its
///   origin unitreerobotics/unitree_ros (`robots/z1_description`) and MPL-2.0 as the licence.
///
/// # Changed
///
/// The gripper's fixed half is welded to link 6, the base link omitted since it does not move. JointLimits are
/// the degrees that the source prints as radians, 180°/s where it has 3.1415 rad/s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Z1;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// From `lower` to `upper` degrees.
const fn limits(lower: f64, upper: f64, torque: f64) -> JointLimits<f64> {
    JointLimits {
        lower: lower * PI / 180.0,
        upper: upper * PI / 180.0,
        velocity: PI,
        torque,
    }
}

const LINK_6: Part = Part {
    mass: 0.28875807,
    com: [0.0241569, -0.00017355, -0.00143876],
    inertia: [0.00018328, 1.22e-6, 5.4e-7, 0.0001475, 8e-8, 0.0001468],
};
const GRIPPER: Part = Part {
    mass: 0.52603655,
    com: [0.04764427, -0.00035819, -0.00249162],
    inertia: [
        0.00038683, -3.59e-6, 7.662e-5, 0.00068614, 2.09e-6, 0.00066293,
    ],
};

impl Robot<7, 7, 7> for Z1 {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "z1",
        [
            Body::new("link1", BASE, Joint::revolute(Z))
                .xyz([0.0, 0.0, 0.0585])
                .mass(0.67332551)
                .com([2.47e-6, -0.00025198, 0.02317169])
                .inertia([0.00128328, -6e-8, -4e-7, 0.00071931, 5e-7, 0.00083936])
                .limits(limits(-150.0, 150.0, 30.0)),
            Body::new("link2", 0, Joint::revolute(Y))
                .xyz([0.0, 0.0, 0.045])
                .mass(1.19132258)
                .com([-0.11012601, 0.00240029, 0.00158266])
                .inertia([
                    0.00102138, 0.00062358, 5.13e-6, 0.02429457, -2.1e-6, 0.02466114,
                ])
                .limits(limits(0.0, 170.0, 60.0)),
            Body::new("link3", 1, Joint::revolute(Y))
                .xyz([-0.35, 0.0, 0.0])
                .mass(0.83940874)
                .com([0.10609208, -0.00541815, 0.03476383])
                .inertia([
                    0.00108061,
                    -8.669e-5,
                    -0.00208102,
                    0.00954238,
                    -1.332e-5,
                    0.00886621,
                ])
                .limits(limits(-165.0, 0.0, 30.0)),
            Body::new("link4", 2, Joint::revolute(Y))
                .xyz([0.218, 0.0, 0.057])
                .mass(0.56404563)
                .com([0.04366681, 0.00364738, -0.00170192])
                .inertia([
                    0.00031576, 8.13e-5, 4.091e-5, 0.00092996, -5.96e-6, 0.00097912,
                ])
                .limits(limits(-87.0, 87.0, 30.0)),
            Body::new("link5", 3, Joint::revolute(Z))
                .xyz([0.07, 0.0, 0.0])
                .mass(0.38938492)
                .com([0.03121533, 0.0, 0.00646316])
                .inertia([0.00017605, 4e-7, 5.689e-5, 0.00055896, -1.3e-7, 0.0005386])
                .limits(limits(-77.0, 77.0, 30.0)),
            LINK_6
                .with(GRIPPER.at([0.051, 0.0, 0.0]))
                .of(Body::new("link6", 4, Joint::revolute(X)))
                .xyz([0.0492, 0.0, 0.0])
                .limits(limits(-160.0, 160.0, 30.0)),
            Body::new("jaw", 5, Joint::revolute(Y))
                .xyz([0.1, 0.0, 0.0])
                .mass(0.27621302)
                .com([0.01320633, 0.00476708, 0.00380534])
                .inertia([
                    0.00017716, 1.683e-5, -1.786e-5, 0.00026787, 2.62e-6, 0.00035728,
                ])
                .limits(limits(-90.0, 0.0, 30.0)),
        ],
    );
}

const _: ArmModel<f64, 7> = Z1::MODEL;
