//! panda.
//!
//! # Source
//!
//! `panda.urdf`; it states no licence. Imported on 2026-11-21 by robot-import 0.1.0.
//!
//! # Changed
//!
//! - Part of body `panda_link7`: `panda_link8`.
//! - Link `panda_hand` and all that it carries are left out: 0.76 kg.
//! - The soft limits -2.8973 to 2.8973 of joint `panda_joint1` are left out; its limits are those of its \<limit>.
//! - The soft limits -1.7628 to 1.7628 of joint `panda_joint2` are left out; its limits are those of its \<limit>.
//! - The soft limits -2.8973 to 2.8973 of joint `panda_joint3` are left out; its limits are those of its \<limit>.
//! - The soft limits -3.0718 to -0.0698 of joint `panda_joint4` are left out; its limits are those of its \<limit>.
//! - The soft limits -2.8973 to 2.8973 of joint `panda_joint5` are left out; its limits are those of its \<limit>.
//! - The soft limits -0.0175 to 3.7525 of joint `panda_joint6` are left out; its limits are those of its \<limit>.
//! - The soft limits -2.8973 to 2.8973 of joint `panda_joint7` are left out; its limits are those of its \<limit>.
//! - Left out, as no part of URDF whose meaning is known here: `dynamics D`, `dynamics K`, `dynamics mu_coulomb`, `dynamics mu_viscous` of joint `panda_joint1`, joint `panda_joint2`, joint `panda_joint3`, joint `panda_joint4`, joint `panda_joint5`, joint `panda_joint6`, joint `panda_joint7`.

#![allow(
    dead_code,
    reason = "not every program uses every constant of its robot"
)]
#![allow(clippy::approx_constant, reason = "numbers are those of the file")]

use ::dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use ::dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The number of bodies.
pub const B: usize = 7;
/// The number of position coordinates.
pub const Q: usize = 7;
/// The number of velocity coordinates.
pub const V: usize = 7;
/// The number of joints.
pub const N: usize = V;

/// The names of the bodies.
pub const BODIES: [&str; B] = [
    "panda_link1",
    "panda_link2",
    "panda_link3",
    "panda_link4",
    "panda_link5",
    "panda_link6",
    "panda_link7",
];
/// The names of their joints.
pub const JOINTS: [&str; B] = [
    "panda_joint1",
    "panda_joint2",
    "panda_joint3",
    "panda_joint4",
    "panda_joint5",
    "panda_joint6",
    "panda_joint7",
];

/// panda: 7 bodies on 7 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct Panda;

impl Robot<7, 7, 7> for Panda {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "panda",
        [
            Body::new("panda_link1", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, 0.0, 0.333])
                .mass(4.970684)
                .com([0.003875, 0.002081, -0.04762])
                .inertia([0.70337, -0.000139, 0.006772, 0.70661, 0.019169, 0.009117])
                .limits(JointLimits {
                    lower: -2.8973,
                    upper: 2.8973,
                    velocity: 2.175,
                    torque: 87.0,
                }),
            Body::new("panda_link2", 0, Joint::revolute([0.0, 0.0, 1.0]))
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
            Body::new("panda_link3", 1, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, -0.316, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(3.228604)
                .com([0.027518, 0.039252, -0.066502])
                .inertia([0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083])
                .limits(JointLimits {
                    lower: -2.8973,
                    upper: 2.8973,
                    velocity: 2.175,
                    torque: 87.0,
                }),
            Body::new("panda_link4", 2, Joint::revolute([0.0, 0.0, 1.0]))
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
            Body::new("panda_link5", 3, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([-0.0825, 0.384, 0.0])
                .quarter_turns([-1, 0, 0])
                .mass(1.225946)
                .com([-0.011953, 0.041065, -0.038437])
                .inertia([0.035549, -0.002117, -0.004037, 0.029474, 0.000229, 0.008627])
                .limits(JointLimits {
                    lower: -2.8973,
                    upper: 2.8973,
                    velocity: 2.61,
                    torque: 12.0,
                }),
            Body::new("panda_link6", 4, Joint::revolute([0.0, 0.0, 1.0]))
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
            Body::new("panda_link7", 5, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.088, 0.0, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(0.735522)
                .com([0.010517, -0.004252, 0.061597])
                .inertia([
                    0.012516, -0.000428, -0.001196, 0.010027, -0.000741, 0.004815,
                ])
                .limits(JointLimits {
                    lower: -2.8973,
                    upper: 2.8973,
                    velocity: 2.61,
                    torque: 12.0,
                }),
        ],
    );
}

// A robot with an impossible joint or a negative mass does not compile.
const _: ArmModel<f64, 7> = Panda::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([0.003, 0.003, 0.003, 0.003, 0.003, 0.003, 0.003]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    width: Width::f32(0.02),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, V> = Armature([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);

/// The rigid body's forces of inertia, and those effects that the description states.
pub type Forces = (Inertia, Coriolis, Viscous<f32, V>);
/// With their parameters.
pub const FORCES: Forces = (Inertia, Coriolis, VISCOUS);
/// All that acts on the robot.
pub type Scene = (Gravity, Forces);
/// On Earth, checked at this line.
pub const SCENE: Scene = ::dynamics_core::Core::<Panda>::scene_f32((Gravity::EARTH, FORCES));
