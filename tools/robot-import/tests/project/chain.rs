//! Six branches of five joints, in every third of which one slides: as many joints as a humanoid
//! has.

use dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
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
    JointLimits { lower, upper, velocity: 4.0, torque }
}

/// The masses of a branch, from its root to its tip, kg.
const MASSES: [f64; 5] = [2.0, 1.7, 1.4, 1.1, 0.8];

const fn body(i: usize) -> Body {
    let (branch, k) = (i / 5, i % 5);
    let joint = match k {
        0 => Joint::revolute([0.0, 0.0, 1.0]),
        2 if branch % 3 == 0 => Joint::prismatic([1.0, 0.0, 0.0]),
        2 => Joint::revolute([1.0, 0.0, 0.0]),
        4 => Joint::revolute([0.0, 0.6, 0.8]),
        _ => Joint::revolute([0.0, 1.0, 0.0]),
    };
    let (parent, x) = match k {
        0 => (BASE, 0.3 * branch as f64),
        _ => (i - 1, 0.0),
    };
    let across = 0.01 * MASSES[k];
    Body::new(BODIES[i], parent, joint)
        .xyz([x, 0.05 * k as f64, -0.2])
        .mass(MASSES[k])
        .com([0.02, 0.01, -0.1])
        .inertia([across, 0.0001, 0.0, 1.1 * across, 0.0, 0.002])
        .limits(match i {
            3 | 10 | 24 => JointLimits::NONE,
            2 => limits(-0.6, 0.4, 60.0),
            17 => JointLimits { velocity: 0.05, ..limits(0.0, 0.04, 60.0) },
            _ if k == 0 => limits(0.5, 2.5, 60.0),
            _ => limits(-1.5, 2.0, 60.0),
        })
}

impl Robot<30, 30, 30> for Chain {
    const MODEL: ArmModel<f64, 30> = {
        let (mut bodies, mut i) = ([body(0); N], 0);
        while i < N {
            bodies[i] = body(i);
            i += 1;
        }
        Model::new("chain", bodies)
    };
}

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, N> = Viscous([0.2; N]);
/// Dry friction, N·m or N.
pub const COULOMB: Coulomb<f32, N> = Coulomb { torque: [0.3; N], width: Width::f32(0.05) };
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, N> = Armature([0.05; N]);

/// The effects that act on it.
pub type Forces = (Inertia, Coriolis, Viscous<f32, N>, Coulomb<f32, N>, Armature<f32, N>);
pub const FORCES: Forces = (Inertia, Coriolis, VISCOUS, COULOMB, ARMATURE);
pub type Scene = (Gravity, Forces);
pub const SCENE: Scene = (Gravity::EARTH, FORCES);
