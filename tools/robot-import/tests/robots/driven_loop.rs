//! driven_loop.
//!
//! # Source
//!
//! `driven_loop_no_ctrlrange.xml`; it states no licence. Imported on 2026-11-23 by robot-import 0.1.0.
//!
//! # Changed
//!
//! - Actuators of type position, that of joint `s`: their gains are controllers of the simulation and are left out.

#![allow(
    dead_code,
    reason = "not every program uses every constant of its robot"
)]
#![allow(clippy::approx_constant, reason = "numbers are those of the file")]

use ::dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use ::dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};

/// The number of bodies.
pub const B: usize = 4;
/// The number of position coordinates.
pub const Q: usize = 4;
/// The number of velocity coordinates.
pub const V: usize = 4;
/// The number of joints.
pub const N: usize = V;

/// The names of the bodies.
pub const BODIES: [&str; B] = ["a", "b", "c", "d"];
/// The names of their joints.
pub const JOINTS: [&str; B] = ["p", "q", "r", "s"];

/// driven_loop: 4 bodies on 4 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct DrivenLoop;

impl Robot<4, 4, 4> for DrivenLoop {
    const MODEL: ArmModel<f64, 4> = Model::new(
        "driven_loop",
        [
            Body::new("a", BASE, Joint::continuous([0.0, 1.0, 0.0]))
                .mass(1.0)
                .com([0.1, 0.05, 0.02])
                .inertia([0.01, 0.0, 0.0, 0.012, 0.0, 0.009]),
            Body::new("b", 0, Joint::continuous([0.0, 1.0, 0.0]))
                .xyz([0.2, 0.0, 0.0])
                .mass(1.0)
                .com([0.1, 0.05, 0.02])
                .inertia([0.01, 0.0, 0.0, 0.012, 0.0, 0.009]),
            Body::new("c", 1, Joint::continuous([0.0, 1.0, 0.0]))
                .xyz([0.2, 0.0, 0.0])
                .mass(1.0)
                .com([0.1, 0.05, 0.02])
                .inertia([0.01, 0.0, 0.0, 0.012, 0.0, 0.009]),
            Body::new("d", BASE, Joint::continuous([0.0, 1.0, 0.0]))
                .xyz([0.5, 0.0, 0.0])
                .mass(1.0)
                .com([0.1, 0.05, 0.02])
                .inertia([0.01, 0.0, 0.0, 0.012, 0.0, 0.009]),
        ],
    );
}

// A robot with an impossible joint or a negative mass does not compile.
const _: ArmModel<f64, 4> = DrivenLoop::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([0.0, 0.0, 0.0, 0.0]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [0.0, 0.0, 0.0, 0.0],
    width: Width::f32(0.02),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, V> = Armature([0.0, 0.0, 0.0, 0.0]);

/// The rigid body's forces of inertia, and those effects that the description states.
pub type Forces = (Inertia, Coriolis);
/// With their parameters.
pub const FORCES: Forces = (Inertia, Coriolis);
/// All that acts on the robot.
pub type Scene = (Gravity, Forces);
/// On Earth, checked at this line.
pub const SCENE: Scene = ::dynamics_core::Core::<DrivenLoop>::scene_f32((Gravity::EARTH, FORCES));

use ::dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};

impl LoopRobot<4, 4, 4, 1, 3, 2> for DrivenLoop {
    /// The actuated coordinates are those of the joints with a motor.
    const LOOPS: Loops<1, 3, 2> = Loops::new(
        &DrivenLoop::MODEL,
        [LoopJoint::new(
            "loop_0",
            Joint::spherical(),
            [
                BodyFrame::new(2).xyz([0.1, 0.0, 0.0]),
                BodyFrame::new(3).xyz([2.7755575615628914e-17, 0.0, 0.0]),
            ],
        )],
        [0, 3],
    );
}

const _: Loops<1, 3, 2> = DrivenLoop::LOOPS;
