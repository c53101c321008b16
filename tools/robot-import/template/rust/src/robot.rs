//! A pendulum: a rod of 2 kg and 1 m, with friction in its bearing. Replace this file by the one of
//! your robot.

use dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The robot.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pendulum;

/// Velocity coordinates.
pub const N: usize = 1;
/// The joints, in the order of the coordinates.
pub const JOINTS: [&str; N] = ["bearing"];
/// The bodies that they move.
pub const BODIES: [&str; N] = ["rod"];

impl Robot<1, 1, 1> for Pendulum {
    const MODEL: ArmModel<f64, 1> = Model::new(
        "pendulum",
        [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0]))
            .mass(2.0)
            .com([0.0, 0.0, -0.5])
            .inertia([0.1667, 0.0, 0.0, 0.1667, 0.0, 0.0005])
            .limits(JointLimits {
                lower: -3.0,
                upper: 3.0,
                velocity: 5.0,
                torque: 20.0,
            })],
    );
}
const _: ArmModel<f64, 1> = Pendulum::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, N> = Viscous([0.1]);
/// Dry friction, N·m or N.
pub const COULOMB: Coulomb<f32, N> = Coulomb {
    torque: [0.0],
    width: Width::f32(0.05),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, N> = Armature([0.0]);

/// The rigid body's forces of inertia, and those effects that the description states.
pub type Forces = (Inertia, Coriolis, Viscous<f32, N>);
/// With their parameters.
pub const FORCES: Forces = (Inertia, Coriolis, VISCOUS);
/// All that acts on the robot.
pub type Scene = (Gravity, Forces);
/// On Earth, checked at this line.
pub const SCENE: Scene = ::dynamics_core::Core::<Pendulum>::scene_f32((Gravity::EARTH, FORCES));
