//! Six branches of five joints, of which every third slides: as many joints as a humanoid has.

use dynamics_core::effects::{Armature, Coulomb, Viscous, Width};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The robot.
#[derive(Clone, Copy, Debug, Default)]
pub struct Chain;

/// Velocity coordinates.
pub const N: usize = 30;
/// The joints, in the order of the coordinates.
pub const JOINTS: [&str; N] = [
    "j0", "j1", "j2", "j3", "j4", "j5", "j6", "j7", "j8", "j9", "j10", "j11", "j12", "j13", "j14",
    "j15", "j16", "j17", "j18", "j19", "j20", "j21", "j22", "j23", "j24", "j25", "j26", "j27",
    "j28", "j29",
];
/// The bodies.
pub const BODIES: [&str; N] = [
    "b0", "b1", "b2", "b3", "b4", "b5", "b6", "b7", "b8", "b9", "b10", "b11", "b12", "b13", "b14",
    "b15", "b16", "b17", "b18", "b19", "b20", "b21", "b22", "b23", "b24", "b25", "b26", "b27",
    "b28", "b29",
];

const fn limits(lower: f64, upper: f64, torque: f64) -> JointLimits<f64> {
    JointLimits {
        lower,
        upper,
        velocity: 4.0,
        torque,
    }
}

impl Robot<30, 30, 30> for Chain {
    const MODEL: ArmModel<f64, 30> = Model::new(
        "chain",
        [
            Body::new("b0", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.00, 0.00, -0.2])
                .mass(2.0)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0200, 0.0001, 0.0, 0.0220, 0.0, 0.002])
                .limits(limits(0.5, 2.5, 60.0)),
            Body::new("b1", 0, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.05, -0.2])
                .mass(1.7)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0170, 0.0001, 0.0, 0.0187, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b2", 1, Joint::prismatic([1.0, 0.0, 0.0]))
                .xyz([0.00, 0.10, -0.2])
                .mass(1.4)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0140, 0.0001, 0.0, 0.0154, 0.0, 0.002])
                .limits(limits(-0.6, 0.4, 60.0)),
            Body::new("b3", 2, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.15, -0.2])
                .mass(1.1)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0110, 0.0001, 0.0, 0.0121, 0.0, 0.002])
                .limits(JointLimits::NONE),
            Body::new("b4", 3, Joint::revolute([0.0, 0.6, 0.8]))
                .xyz([0.00, 0.20, -0.2])
                .mass(0.8)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0080, 0.0001, 0.0, 0.0088, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b5", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.30, 0.00, -0.2])
                .mass(2.0)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0200, 0.0001, 0.0, 0.0220, 0.0, 0.002])
                .limits(limits(0.5, 2.5, 60.0)),
            Body::new("b6", 5, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.05, -0.2])
                .mass(1.7)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0170, 0.0001, 0.0, 0.0187, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b7", 6, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.00, 0.10, -0.2])
                .mass(1.4)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0140, 0.0001, 0.0, 0.0154, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b8", 7, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.15, -0.2])
                .mass(1.1)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0110, 0.0001, 0.0, 0.0121, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b9", 8, Joint::revolute([0.0, 0.6, 0.8]))
                .xyz([0.00, 0.20, -0.2])
                .mass(0.8)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0080, 0.0001, 0.0, 0.0088, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b10", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.60, 0.00, -0.2])
                .mass(2.0)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0200, 0.0001, 0.0, 0.0220, 0.0, 0.002])
                .limits(JointLimits::NONE),
            Body::new("b11", 10, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.05, -0.2])
                .mass(1.7)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0170, 0.0001, 0.0, 0.0187, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b12", 11, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.00, 0.10, -0.2])
                .mass(1.4)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0140, 0.0001, 0.0, 0.0154, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b13", 12, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.15, -0.2])
                .mass(1.1)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0110, 0.0001, 0.0, 0.0121, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b14", 13, Joint::revolute([0.0, 0.6, 0.8]))
                .xyz([0.00, 0.20, -0.2])
                .mass(0.8)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0080, 0.0001, 0.0, 0.0088, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b15", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.90, 0.00, -0.2])
                .mass(2.0)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0200, 0.0001, 0.0, 0.0220, 0.0, 0.002])
                .limits(limits(0.5, 2.5, 60.0)),
            Body::new("b16", 15, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.05, -0.2])
                .mass(1.7)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0170, 0.0001, 0.0, 0.0187, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b17", 16, Joint::prismatic([1.0, 0.0, 0.0]))
                .xyz([0.00, 0.10, -0.2])
                .mass(1.4)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0140, 0.0001, 0.0, 0.0154, 0.0, 0.002])
                .limits(JointLimits {
                    lower: 0.0,
                    upper: 0.04,
                    velocity: 0.05,
                    torque: 60.0,
                }),
            Body::new("b18", 17, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.15, -0.2])
                .mass(1.1)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0110, 0.0001, 0.0, 0.0121, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b19", 18, Joint::revolute([0.0, 0.6, 0.8]))
                .xyz([0.00, 0.20, -0.2])
                .mass(0.8)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0080, 0.0001, 0.0, 0.0088, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b20", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([1.20, 0.00, -0.2])
                .mass(2.0)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0200, 0.0001, 0.0, 0.0220, 0.0, 0.002])
                .limits(limits(0.5, 2.5, 60.0)),
            Body::new("b21", 20, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.05, -0.2])
                .mass(1.7)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0170, 0.0001, 0.0, 0.0187, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b22", 21, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.00, 0.10, -0.2])
                .mass(1.4)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0140, 0.0001, 0.0, 0.0154, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b23", 22, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.15, -0.2])
                .mass(1.1)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0110, 0.0001, 0.0, 0.0121, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b24", 23, Joint::revolute([0.0, 0.6, 0.8]))
                .xyz([0.00, 0.20, -0.2])
                .mass(0.8)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0080, 0.0001, 0.0, 0.0088, 0.0, 0.002])
                .limits(JointLimits::NONE),
            Body::new("b25", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([1.50, 0.00, -0.2])
                .mass(2.0)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0200, 0.0001, 0.0, 0.0220, 0.0, 0.002])
                .limits(limits(0.5, 2.5, 60.0)),
            Body::new("b26", 25, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.05, -0.2])
                .mass(1.7)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0170, 0.0001, 0.0, 0.0187, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b27", 26, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.00, 0.10, -0.2])
                .mass(1.4)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0140, 0.0001, 0.0, 0.0154, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b28", 27, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.00, 0.15, -0.2])
                .mass(1.1)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0110, 0.0001, 0.0, 0.0121, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
            Body::new("b29", 28, Joint::revolute([0.0, 0.6, 0.8]))
                .xyz([0.00, 0.20, -0.2])
                .mass(0.8)
                .com([0.02, 0.01, -0.1])
                .inertia([0.0080, 0.0001, 0.0, 0.0088, 0.0, 0.002])
                .limits(limits(-1.5, 2.0, 60.0)),
        ],
    );
}

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, N> = Viscous([0.2; N]);
/// Dry friction, N·m or N.
pub const COULOMB: Coulomb<f32, N> = Coulomb {
    torque: [0.3; N],
    width: Width::f32(0.05),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, N> = Armature([0.05; N]);
