//! Kinds of joints and their coordinates. RBDA (2008), table 4.1.

/// Kind of a joint: its degrees of freedom and their coordinates.
///
/// The parent side is the joint's frame, fixed in the parent; velocities are those of the body in
/// its own frame. Angles are in rad, lengths in m.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointKind {
    /// Rotation q about an axis.
    Revolute,
    /// Rotation without limits: as `Revolute`, but q and q + 2π are the same configuration.
    Continuous,
    /// Translation q along an axis.
    Prismatic,
    /// Rotation q about an axis and translation pitch·q along it.
    Helical,
    /// Rotation q₀ about an axis and translation q₁ along it.
    Cylindrical,
    /// Rotation q₀ about an axis of the parent side, then rotation q₁ about an axis of the body.
    Universal,
    /// A ball joint: q is a unit quaternion (x, y, z, w), the body's attitude on the parent side;
    /// q̇ is ω.
    Spherical,
    /// Rotation q₀ about z and position (q₁, q₂) of the body's origin on the parent side's x-y
    /// plane; q̇ is (ω_z, v_x, v_y).
    Planar,
    /// No constraint: a unit quaternion (x, y, z, w) and the position of the body's origin on the
    /// parent side; q̇ is (ω, v).
    Free,
    /// A rigid connection, without a coordinate.
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

    /// The numbers of its first coordinates that are angles and that are those of a quaternion.
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

/// The kinds of joint that a robot has; its machine code leaves out all others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct JointKinds(u16);

impl JointKinds {
    /// Every kind: a robot known only at run time.
    pub const ALL: Self = Self(u16::MAX);

    /// No kind.
    pub(super) const NONE: Self = Self(0);

    /// Rotations about one axis, with limits or without.
    pub(super) const REVOLUTE: Self =
        Self::NONE.with(JointKind::Revolute).with(JointKind::Continuous);

    /// Whether each is one of these.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) const fn are_revolute(self) -> bool {
        self.0 & !Self::REVOLUTE.0 == 0
    }

    /// Whether each is one of these or fixed: all positions are angles.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) const fn are_revolute_or_fixed(self) -> bool {
        self.0 & !Self::REVOLUTE.with(JointKind::Fixed).0 == 0
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
    #[cfg_attr(optimised, inline(always))]
    pub(crate) const fn has(self, kind: JointKind) -> bool {
        self.0 & (1 << kind as u16) != 0
    }

    /// `kind`, which is one of these, in a form from which the compiler can prove that it is.
    #[cfg_attr(optimised, inline(always))]
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

    #[cfg_attr(optimised, inline(always))]
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
