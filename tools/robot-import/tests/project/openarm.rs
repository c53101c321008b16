//! The library's OpenArm as a file that was imported.

pub use dynamics_core::robots::OpenArm;

use dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous};

/// The number of joints.
pub const N: usize = 7;
/// The names of the joints.
pub const JOINTS: [&str; N] = ["1", "2", "3", "4", "5", "6", "7"];

pub const VISCOUS: Viscous<f32, N> = OpenArm::FRICTION.1;
pub const COULOMB: Coulomb<f32, N> = OpenArm::FRICTION.0;
pub const ARMATURE: Armature<f32, N> = OpenArm::ARMATURE;

/// The effects that act on it.
pub type Forces = (Inertia, Coriolis, Viscous<f32, N>, Coulomb<f32, N>, Armature<f32, N>);
pub const FORCES: Forces = (Inertia, Coriolis, VISCOUS, COULOMB, ARMATURE);
pub type Scene = (Gravity, Forces);
pub const SCENE: Scene = (Gravity::EARTH, FORCES);
