//! parallelogram.
//!
//! # Source
//!
//! `parallelogram.xml`; it states no licence. Imported on 2026-11-21 by robot-import 0.1.0.

#![allow(
    dead_code,
    reason = "not every program uses every constant of its robot"
)]
#![allow(clippy::approx_constant, reason = "numbers are those of the file")]

use ::dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use ::dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The number of bodies.
pub const B: usize = 3;
/// The number of position coordinates.
pub const Q: usize = 3;
/// The number of velocity coordinates.
pub const V: usize = 3;
/// The number of joints.
pub const N: usize = V;

/// The names of the bodies.
pub const BODIES: [&str; B] = ["crank", "coupler", "rocker"];
/// The names of their joints.
pub const JOINTS: [&str; B] = ["crank", "pin", "rocker"];

/// parallelogram: 3 bodies on 3 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parallelogram;

impl Robot<3, 3, 3> for Parallelogram {
    const MODEL: ArmModel<f64, 3> = Model::new(
        "parallelogram",
        [
            Body::new("crank", BASE, Joint::continuous([0.0, 1.0, 0.0]))
                .mass(0.06702064327658226)
                .com([0.0, 0.0, -0.1])
                .inertia([
                    0.0002562073528757597,
                    0.0,
                    0.0,
                    0.0002562073528757597,
                    0.0,
                    3.309144261781249e-6,
                ])
                .limits(JointLimits {
                    torque: 3.0,
                    ..JointLimits::NONE
                }),
            Body::new("coupler", 0, Joint::continuous([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.0, -0.2])
                .mass(0.09843656981248021)
                .com([0.15, 0.0, 0.0])
                .inertia([
                    4.879940588576146e-6,
                    0.0,
                    0.0,
                    0.000808342261744166,
                    0.0,
                    0.000808342261744166,
                ]),
            Body::new("rocker", BASE, Joint::continuous([0.0, 1.0, 0.0]))
                .xyz([0.3, 0.0, 0.0])
                .mass(0.06702064327658226)
                .com([0.0, 0.0, -0.1])
                .inertia([
                    0.0002562073528757597,
                    0.0,
                    0.0,
                    0.0002562073528757597,
                    0.0,
                    3.309144261781249e-6,
                ]),
        ],
    );
}

// A robot with an impossible joint or a negative mass does not compile.
const _: ArmModel<f64, 3> = Parallelogram::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([0.0, 0.0, 0.0]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [0.0, 0.0, 0.0],
    width: Width::f32(0.02),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, V> = Armature([0.0, 0.0, 0.0]);

/// The rigid body's forces of inertia, and those effects that the description states.
pub type Forces = (Inertia, Coriolis);
/// With their parameters.
pub const FORCES: Forces = (Inertia, Coriolis);
/// All that acts on the robot.
pub type Scene = (Gravity, Forces);
/// On Earth, checked at this line.
pub const SCENE: Scene =
    ::dynamics_core::Core::<Parallelogram>::scene_f32((Gravity::EARTH, FORCES));

use ::dynamics_core::loops::{BodyFrame, LoopJoint, LoopRobot, Loops};

impl LoopRobot<3, 3, 3, 1, 3, 1> for Parallelogram {
    /// The actuated coordinates are those of the joints with a motor.
    const LOOPS: Loops<1, 3, 1> = Loops::new(
        &Parallelogram::MODEL,
        [LoopJoint::new(
            "end",
            Joint::spherical(),
            [
                BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
                BodyFrame::new(2).xyz([0.0, 0.0, -0.2]),
            ],
        )],
        [0],
    );
}

const _: Loops<1, 3, 1> = Parallelogram::LOOPS;
