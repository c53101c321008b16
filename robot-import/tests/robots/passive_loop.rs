//! passive_loop.
//!
//! # Source
//!
//! `passive_loop.xml`; it states no licence. Imported on 2026-11-23 by robot-import 0.1.0.
//!
//! # Changed
//!
//! - The file has no motor on a joint of its machine with loops, and at least 1 move freely: every joint is taken as driven. `--motors A,B` names those with a motor, or `<motor joint=…/>` in the file.

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

/// passive_loop: 4 bodies on 4 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct PassiveLoop;

impl Robot<4, 4, 4> for PassiveLoop {
    const MODEL: ArmModel<f64, 4> = Model::new(
        "passive_loop",
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
const _: ArmModel<f64, 4> = PassiveLoop::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([0.0, 0.0, 0.0, 0.0]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [0.0, 0.0, 0.0, 0.0],
    width: Width::f32(0.02),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, V> = Armature([0.0, 0.0, 0.0, 0.0]);

/// The rigid body, and the effects that the description states.
pub const SCENE: (Gravity, Inertia, Coriolis) =
    ::dynamics_core::Core::<PassiveLoop>::scene_f32((Gravity::EARTH, Inertia, Coriolis));

use ::dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};

impl LoopRobot<4, 4, 4, 1, 3, 4> for PassiveLoop {
    /// The file has too few motors: every coordinate is taken as actuated.
    const LOOPS: Loops<1, 3, 4> = Loops::new(
        &PassiveLoop::MODEL,
        [LoopJoint::new(
            "loop_0",
            Joint::spherical(),
            [
                BodyFrame::new(2).xyz([0.1, 0.0, 0.0]),
                BodyFrame::new(3).xyz([2.7755575615628914e-17, 0.0, 0.0]),
            ],
        )],
        [0, 1, 2, 3],
    );
}

const _: Loops<1, 3, 4> = PassiveLoop::LOOPS;
