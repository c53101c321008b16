//! The tree of moving bodies as the engine computes with it: joints, inertias, and where each body of the description is.

use glam::{DMat3, DVec3};

use crate::model::BASE;

/// A joint with the inertia that is left to its body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    /// The parent joint, or [`BASE`].
    pub(crate) parent: usize,
    pub(crate) prismatic: bool,
    /// Its limits keep it within ±4π.
    pub(crate) near: bool,
    /// Coordinates of the body at q = 0 to the parent's.
    pub(crate) rot: DMat3,
    /// Origin in the parent's frame, in units of length.
    pub(crate) pos: DVec3,
    pub(crate) mass: f64,
    pub(crate) moment: DVec3,
    pub(crate) second: DMat3,
    /// Σ where the base moves: regrouping then keeps all of it.
    pub(crate) second_moment_only: DMat3,
    /// Σ in M, which [`super::rotors`] leaves to it, and the inertia of its rotor.
    pub(crate) matrix_second: DMat3,
    pub(crate) rotor: f64,
}

/// The placement of a body of the description: x_engine = rot x_user + pos on `joint`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyPlacement {
    pub(crate) joint: usize,
    pub(crate) rot: DMat3,
    /// In units of length.
    pub(crate) pos: DVec3,
}

/// The robot as the engine computes with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CompiledTree<const B: usize, const V: usize> {
    pub(crate) joints: [Joint; V],
    pub(crate) places: [BodyPlacement; B],
    /// The unit of length, m.
    pub(crate) length: f64,
}

/// Fills the constants of branches that are not compiled in, which the compiler evaluates all the same.
pub(super) const PADDING_JOINT: Joint = Joint {
    parent: BASE,
    prismatic: false,
    near: false,
    rot: DMat3::IDENTITY,
    pos: DVec3::ZERO,
    mass: 0.0,
    moment: DVec3::ZERO,
    second: DMat3::ZERO,
    second_moment_only: DMat3::ZERO,
    matrix_second: DMat3::ZERO,
    rotor: 0.0,
};

/// The base itself.
pub(super) const AT_BASE: BodyPlacement = BodyPlacement {
    joint: BASE,
    rot: DMat3::IDENTITY,
    pos: DVec3::ZERO,
};
