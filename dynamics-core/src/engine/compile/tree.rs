//! The tree of moving bodies as the engine computes with it: joints, inertias, and where each body
//! of the description is.

use glam::{DMat3, DVec3};

use crate::model::BASE;

/// The motion that a joint gives its body relative to the parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum JointMotion {
    /// A rotation about z.
    Turn,
    /// A translation along z.
    Slide,
    /// A rotation about z with a translation along it.
    Screw,
    /// A rotation about z and a translation in the x-y plane; velocities in the body's frame.
    Planar,
    /// Any rotation, a unit quaternion; velocities in the body's frame.
    Spherical,
    /// Any motion, a unit quaternion and a translation; velocities in the body's frame.
    Free,
    /// None: a coordinate of a planar, spherical or free joint but the first, whose frame is the
    /// body's already.
    Still,
}

/// One velocity coordinate of a joint, with the inertia that is left to the body behind it.
///
/// A joint of several coordinates is a chain of them, whose bodies between are massless. Those of a
/// universal and of a cylindrical joint are joints of their own, since their rates are derivatives
/// of their positions. Those of a planar, spherical and free joint are not: the first moves the
/// body by all of its positions at once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    /// The parent coordinate, or [`BASE`].
    pub(crate) parent: usize,
    pub(crate) motion: JointMotion,
    /// The coordinates that move the body at once: the first, and how many there are.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// Whether the velocity is that of a translation.
    pub(crate) prismatic: bool,
    /// The axis of the velocity in the body's frame: 0 for x, 1 for y, 2 for z.
    pub(crate) axis: usize,
    /// The index of the first position of these coordinates.
    pub(crate) q: usize,
    /// The position that belongs to the velocity; nothing for ω beside a quaternion.
    pub(crate) position: Option<usize>,
    /// Translation per rotation of a screw, in units of length per rad; else zero.
    pub(crate) pitch: f64,
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
    /// Σ in M, which [`super::matrix_parameters`] leaves to it, and the inertia that only its own
    /// joint's rotation feels.
    pub(crate) matrix_second: DMat3,
    pub(crate) spin: f64,
    /// The inertia of the body alone along this coordinate, kg·m² or kg: its pivot is no smaller.
    /// Zero if that is not known.
    pub(crate) alone: f64,
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

/// The same of a robot whose links bend.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BendingTree<const B: usize, const V: usize> {
    pub(crate) tree: CompiledTree<B, V>,
    /// The inertia on the end of the body of each joint.
    pub(crate) on_ends: [OnEnd; V],
    /// Whether a body of the description is fixed on an end: its place is that from there.
    pub(crate) is_on_end: [bool; B],
}

/// The inertia on the end of a link that bends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnEnd {
    /// The mass of what is fixed there, and that which joints leave at the very end: a point, which
    /// is in the parameters of the link, too.
    pub(crate) mass: f64,
    /// The first moment, and below it the second moment, of what is fixed there, about the end.
    pub(crate) moment: DVec3,
    pub(crate) second: DMat3,
}

impl OnEnd {
    pub(super) const NOTHING: Self = Self { mass: 0.0, moment: DVec3::ZERO, second: DMat3::ZERO };
}

/// Fills the constants of branches that are not compiled in, which the compiler evaluates all the
/// same.
pub(super) const PADDING_JOINT: Joint = Joint {
    parent: BASE,
    motion: JointMotion::Turn,
    first: 0,
    count: 1,
    prismatic: false,
    axis: 2,
    q: 0,
    position: Some(0),
    pitch: 0.0,
    near: false,
    rot: DMat3::IDENTITY,
    pos: DVec3::ZERO,
    mass: 0.0,
    moment: DVec3::ZERO,
    second: DMat3::ZERO,
    second_moment_only: DMat3::ZERO,
    matrix_second: DMat3::ZERO,
    spin: 0.0,
    alone: 0.0,
};

/// The base itself.
pub(super) const AT_BASE: BodyPlacement =
    BodyPlacement { joint: BASE, rot: DMat3::IDENTITY, pos: DVec3::ZERO };
