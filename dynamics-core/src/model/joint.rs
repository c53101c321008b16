//! A joint as a model describes it: its kind and its axes.

use super::error::Problem;
use super::joint_kind::JointKind;
use crate::math::const_eval as m;
use crate::scalar::Real;
use glam::{DMat3, DVec3};

/// A joint: its kind and axes, in the body's frame.
///
/// ```
/// use dynamics_core::model::Joint;
/// let screw = Joint::helical([0.0, 0.0, 2.0], 0.01); // 10 mm per rad
/// assert_eq!(screw.pitch, 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<R: Real> {
    /// The kind.
    pub kind: JointKind,
    /// Unit axis (the second of a universal joint) in the body's frame; zero if it has none.
    pub axis: R::Vec3,
    /// Unit axis of a universal joint's first rotation, at q = 0 in the body's frame; else zero.
    pub first_axis: R::Vec3,
    /// Translation per rotation of a helical joint, m/rad; else zero.
    pub pitch: R,
}

impl Joint<f64> {
    const fn new(kind: JointKind, axis: [f64; 3]) -> Self {
        Self { kind, axis: m::vec3(axis), first_axis: DVec3::ZERO, pitch: 0.0 }
    }

    /// A rotation about `axis`, given in the body's frame; any length but zero.
    pub const fn revolute(axis: [f64; 3]) -> Self {
        Self::new(JointKind::Revolute, axis)
    }

    /// A rotation without end about `axis`, given in the body's frame; any length but zero.
    pub const fn continuous(axis: [f64; 3]) -> Self {
        Self::new(JointKind::Continuous, axis)
    }

    /// A translation along `axis`, given in the body's frame; any length but zero.
    pub const fn prismatic(axis: [f64; 3]) -> Self {
        Self::new(JointKind::Prismatic, axis)
    }

    /// A screw along `axis`, given in the body's frame, of `pitch` m/rad.
    pub const fn helical(axis: [f64; 3], pitch: f64) -> Self {
        let mut joint = Self::new(JointKind::Helical, axis);
        joint.pitch = pitch;
        joint
    }

    /// A rotation about and a translation along `axis`, given in the body's frame.
    pub const fn cylindrical(axis: [f64; 3]) -> Self {
        Self::new(JointKind::Cylindrical, axis)
    }

    /// A rotation about `first`, which stands still on the parent side, then one about `second`,
    /// which moves with the body; perpendicular within 10⁻⁹ rad (the model makes them so exactly),
    /// both given in the body's frame at q = 0.
    pub const fn universal(first: [f64; 3], second: [f64; 3]) -> Self {
        let mut joint = Self::new(JointKind::Universal, second);
        joint.first_axis = m::vec3(first);
        joint
    }

    /// A ball joint.
    pub const fn spherical() -> Self {
        Self::new(JointKind::Spherical, [0.0; 3])
    }

    /// Motion on the x-y plane of the joint's frame.
    pub const fn planar() -> Self {
        Self::new(JointKind::Planar, [0.0; 3])
    }

    /// Any motion: the joint of a floating base.
    pub const fn free() -> Self {
        Self::new(JointKind::Free, [0.0; 3])
    }

    /// No motion.
    pub const fn fixed() -> Self {
        Self::new(JointKind::Fixed, [0.0; 3])
    }

    /// The problem of its axes: those that its kind needs, at right angles within 10⁻⁹ rad if there
    /// are two, and of a finite pitch.
    pub(crate) const fn problem(&self) -> Option<Problem> {
        use JointKind::*;
        match self.kind {
            Spherical | Planar | Free | Fixed => None,
            Universal => {
                let (a, b) = (self.first_axis, self.axis);
                if !(is_axis(a) && is_axis(b)) {
                    return Some(Problem::Axis);
                }
                let skew = m::dot(unit(a), unit(b));
                if skew.abs() <= 1e-9 { None } else { Some(Problem::RightAngles) }
            }
            _ if !is_axis(self.axis) => Some(Problem::Axis),
            _ if !self.pitch.is_finite() => Some(Problem::Pitch),
            _ => None,
        }
    }

    pub(crate) const fn normalised(self) -> Self {
        let (axis, mut first_axis) = (unit(self.axis), unit(self.first_axis));
        // At right angles but for rounding: what its description leaves is taken off the first
        // axis.
        let skew = m::dot(first_axis, axis);
        if skew.abs() > 4.0 * f64::EPSILON {
            first_axis = unit(m::add(first_axis, m::scale(axis, -skew)));
        }
        Self { kind: self.kind, axis, first_axis, pitch: self.pitch }
    }

    /// The rotation of coordinates from the body's frame to one whose z is the axis, and whose x is
    /// a universal joint's first axis; a signed permutation where the axes are coordinate axes.
    pub(crate) const fn frame(&self) -> DMat3 {
        use JointKind::*;
        match self.kind {
            Spherical | Planar | Free | Fixed => DMat3::IDENTITY,
            Universal => m::frame(self.first_axis, self.axis),
            _ => m::frame(m::perpendicular(self.axis), self.axis),
        }
    }
}

const fn is_axis(v: DVec3) -> bool {
    let squared = m::dot(v, v);
    squared > 0.0 && squared.is_finite()
}

/// v at length one; an exact unit vector, and zero, keep their bits.
const fn unit(v: DVec3) -> DVec3 {
    let squared = m::dot(v, v);
    if squared == 1.0 || squared == 0.0 { v } else { m::scale(v, 1.0 / m::sqrt(squared)) }
}
