//! What a joint lets its body do: kinds, axes, coordinates. RBDA (2008), table 4.1.

use super::error::Problem;
use crate::math::const_eval as m;
use crate::scalar::Real;
use glam::{DMat3, DVec3};

/// What a joint lets its body do, and the coordinates that say it.
///
/// "Parent side" is the joint's frame, fixed in the parent; velocities are those of the body in its own
/// frame. Turns are in rad, lengths in m.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointKind {
    /// A turn q about an axis.
    Revolute,
    /// A turn without end: as `Revolute`, but q and q + 2π are the same place.
    Continuous,
    /// A slide q along an axis.
    Prismatic,
    /// A turn q about an axis and a slide pitch·q along it.
    Helical,
    /// A turn q₀ about an axis and a slide q₁ along it.
    Cylindrical,
    /// A turn q₀ about an axis of the parent side, then a turn q₁ about an axis of the body.
    Universal,
    /// A ball joint: q is a unit quaternion (x, y, z, w), the body's attitude on the parent side; q̇
    /// stands for ω.
    Spherical,
    /// A turn q₀ about z and the place (q₁, q₂) of the body's origin on the parent side's x-y plane;
    /// q̇ stands for (ω_z, v_x, v_y).
    Planar,
    /// No constraint: a unit quaternion (x, y, z, w) and the place of the body's origin on the parent
    /// side; q̇ stands for (ω, v).
    Free,
    /// Nothing: no coordinate.
    Fixed,
}

impl JointKind {
    /// Every kind.
    pub const ALL: [Self; 10] = [
        Self::Revolute,
        Self::Continuous,
        Self::Prismatic,
        Self::Helical,
        Self::Cylindrical,
        Self::Universal,
        Self::Spherical,
        Self::Planar,
        Self::Free,
        Self::Fixed,
    ];

    /// The numbers of position and velocity coordinates.
    ///
    /// ```
    /// use dynamics_core::model::JointKind;
    /// assert_eq!(JointKind::Free.coordinates(), (7, 6));
    /// ```
    pub const fn coordinates(self) -> (usize, usize) {
        match self {
            Self::Revolute | Self::Continuous | Self::Prismatic | Self::Helical => (1, 1),
            Self::Cylindrical | Self::Universal => (2, 2),
            Self::Planar => (3, 3),
            Self::Spherical => (4, 3),
            Self::Free => (7, 6),
            Self::Fixed => (0, 0),
        }
    }

    /// How many of its first coordinates are angles, and how many a quaternion's.
    pub(crate) const fn angles(self) -> (usize, usize) {
        match self {
            Self::Revolute | Self::Continuous | Self::Helical => (1, 0),
            Self::Cylindrical | Self::Planar => (1, 0),
            Self::Universal => (2, 0),
            Self::Spherical | Self::Free => (0, 4),
            Self::Prismatic | Self::Fixed => (0, 0),
        }
    }
}

/// The kinds of joint that a robot has: what others would do is not in its machine code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointKinds(u16);

impl JointKinds {
    /// Every kind: a robot known only at run time.
    pub const ALL: Self = Self(u16::MAX);

    /// No kind.
    pub(super) const NONE: Self = Self(0);

    /// Turns about one axis only, with an end or without.
    pub(super) const REVOLUTE: Self = Self::NONE
        .with(JointKind::Revolute)
        .with(JointKind::Continuous);

    /// Whether each is such a turn.
    #[inline(always)]
    pub(super) const fn are_revolute(self) -> bool {
        self.0 & !Self::REVOLUTE.0 == 0
    }

    /// These and one more.
    pub(super) const fn with(self, kind: JointKind) -> Self {
        Self(self.0 | 1 << kind as u16)
    }

    /// Whether each has one coordinate.
    pub(super) const fn are_single(self) -> bool {
        use JointKind::*;
        let single = Self::NONE.with(Revolute).with(Continuous).with(Prismatic);
        self.0 & !single.with(Helical).0 == 0
    }

    /// Whether this kind is one of them.
    #[inline(always)]
    pub(crate) const fn has(self, kind: JointKind) -> bool {
        self.0 & (1 << kind as u16) != 0
    }

    /// `kind`, which is one of these; written so that the compiler sees that it is.
    #[inline(always)]
    pub(super) fn of(self, kind: JointKind) -> JointKind {
        use JointKind::*;
        match kind {
            Revolute if self.has(Revolute) => Revolute,
            Continuous if self.has(Continuous) => Continuous,
            Prismatic if self.has(Prismatic) => Prismatic,
            Helical if self.has(Helical) => Helical,
            Cylindrical if self.has(Cylindrical) => Cylindrical,
            Universal if self.has(Universal) => Universal,
            Spherical if self.has(Spherical) => Spherical,
            Planar if self.has(Planar) => Planar,
            Free if self.has(Free) => Free,
            Fixed if self.has(Fixed) => Fixed,
            _ => self.first(),
        }
    }

    #[inline(always)]
    const fn first(self) -> JointKind {
        let kinds = JointKind::ALL;
        let mut i = 0;
        while i < kinds.len() {
            if self.has(kinds[i]) {
                return kinds[i];
            }
            i += 1;
        }
        JointKind::Fixed
    }
}

/// A joint: its kind and axes, in the body's frame.
///
/// ```
/// use dynamics_core::model::Joint;
/// let screw = Joint::helical([0.0, 0.0, 2.0], 0.01); // 10 mm per rad
/// assert_eq!(screw.pitch, 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<R: Real> {
    /// What the joint lets its body do.
    pub kind: JointKind,
    /// Unit axis (the second of a universal joint) in the body's frame; zero if it has none.
    pub axis: R::Vec3,
    /// Unit axis of a universal joint's first turn, at q = 0 in the body's frame; else zero.
    pub first_axis: R::Vec3,
    /// Slide per turn of a helical joint, m/rad; else zero.
    pub pitch: R,
}

impl Joint<f64> {
    const fn new(kind: JointKind, axis: [f64; 3]) -> Self {
        Self {
            kind,
            axis: m::vec3(axis),
            first_axis: DVec3::ZERO,
            pitch: 0.0,
        }
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

    /// A rotation about `first`, which stands still on the parent side, then one about `second`, which
    /// moves with the body; perpendicular within 10⁻⁹ rad (the model makes them so exactly), both given in
    /// the body's frame at q = 0.
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

    /// What it lacks of the axes that its kind needs, at right angles within 10⁻⁹ rad if there are two, and
    /// of a finite pitch.
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
                if skew.abs() <= 1e-9 {
                    None
                } else {
                    Some(Problem::RightAngles)
                }
            }
            _ if !is_axis(self.axis) => Some(Problem::Axis),
            _ if !self.pitch.is_finite() => Some(Problem::Pitch),
            _ => None,
        }
    }

    pub(crate) const fn normalised(self) -> Self {
        let (axis, mut first_axis) = (unit(self.axis), unit(self.first_axis));
        // At right angles but for rounding: what its description leaves is taken off the first axis.
        let skew = m::dot(first_axis, axis);
        if skew.abs() > 4.0 * f64::EPSILON {
            first_axis = unit(m::add(first_axis, m::scale(axis, -skew)));
        }
        Self {
            kind: self.kind,
            axis,
            first_axis,
            pitch: self.pitch,
        }
    }

    /// The rotation of coordinates from the body's frame to one whose z is the axis, and whose x is a
    /// universal joint's first axis; a signed permutation where the axes are coordinate axes.
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
    if squared == 1.0 || squared == 0.0 {
        v
    } else {
        m::scale(v, 1.0 / m::sqrt(squared))
    }
}
