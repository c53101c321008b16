//! Joints of one degree of freedom, and none.

use crate::const_math as m;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, Xform};

/// What a joint lets its body do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointKind {
    /// Rotation about an axis, q in rad.
    Revolute,
    /// Translation along an axis, q in m.
    Prismatic,
    /// Nothing: no coordinate.
    Fixed,
}

impl JointKind {
    /// The numbers of position and velocity coordinates.
    pub const fn coordinates(self) -> (usize, usize) {
        match self {
            Self::Revolute | Self::Prismatic => (1, 1),
            Self::Fixed => (0, 0),
        }
    }
}

/// A joint: its kind and the axis it acts along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<R: Real> {
    /// What the joint lets its body do.
    pub kind: JointKind,
    /// Unit axis in the body's frame (the same in the joint's frame); zero if fixed.
    pub axis: R::Vec3,
}

impl Joint<f64> {
    /// A rotation about `axis`, given in the body's frame; any length but zero.
    pub const fn revolute(axis: [f64; 3]) -> Self {
        Self {
            kind: JointKind::Revolute,
            axis: m::vec3(axis),
        }
    }

    /// A translation along `axis`, given in the body's frame; any length but zero.
    pub const fn prismatic(axis: [f64; 3]) -> Self {
        Self {
            kind: JointKind::Prismatic,
            axis: m::vec3(axis),
        }
    }

    /// No motion.
    pub const fn fixed() -> Self {
        Self {
            kind: JointKind::Fixed,
            axis: m::vec3([0.0; 3]),
        }
    }

    pub(super) const fn has_axis(&self) -> bool {
        let squared = m::dot(self.axis, self.axis);
        matches!(self.kind, JointKind::Fixed) || (squared > 0.0 && squared.is_finite())
    }

    pub(super) const fn normalised(self) -> Self {
        let squared = m::dot(self.axis, self.axis);
        // An exact unit vector keeps its bits.
        let axis = if squared == 1.0 || matches!(self.kind, JointKind::Fixed) {
            self.axis
        } else {
            m::scale(self.axis, 1.0 / m::sqrt(squared))
        };
        Self {
            kind: self.kind,
            axis,
        }
    }
}

/// The position of a joint as the algorithms use it: q itself with its sine and cosine.
///
/// ```
/// use dynamics_core::model::Turn;
/// assert_eq!(Turn::new(0.0_f32), Turn { q: 0.0, sin: 0.0, cos: 1.0 });
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn<R> {
    /// Position, rad or m.
    pub q: R,
    /// sin q.
    pub sin: R,
    /// cos q.
    pub cos: R,
}

impl<R: Real> Turn<R> {
    /// The turn by q rad.
    #[inline(always)]
    pub fn new(q: R) -> Self {
        let (sin, cos) = q.sin_cos();
        Self { q, sin, cos }
    }

    /// A vector's coordinates in a frame turned by q about z.
    #[inline(always)]
    fn about_z(self, [x, y, z]: [R; 3]) -> R::Vec3 {
        R::Vec3::new(self.cos * x + self.sin * y, self.cos * y - self.sin * x, z)
    }

    /// The turn by q rad, |q| ≤ 100.
    #[inline(always)]
    pub fn near(q: R) -> Self {
        let (sin, cos) = q.sin_cos_near();
        Self { q, sin, cos }
    }
}

impl<R: Real> Joint<R> {
    /// ⁱX_λ(i) = X_J ᵀX: from the parent's frame to the body's, RBDA (4.5) and table 4.1.
    #[inline(always)]
    pub fn xform(&self, turn: Turn<R>, placement: &Xform<R>) -> Xform<R> {
        match self.kind {
            JointKind::Revolute => Xform {
                rot: if self.is_along_z() {
                    turned_about_z(&placement.rot, turn)
                } else {
                    rotation(self.axis, turn) * placement.rot
                },
                pos: placement.pos,
            },
            JointKind::Prismatic => Xform {
                rot: placement.rot,
                pos: placement.pos + placement.rot.transpose_mul(self.axis * turn.q),
            },
            JointKind::Fixed => *placement,
        }
    }

    /// Whether the axis is exactly z, as most robots have it: its rotation is cheaper.
    #[inline(always)]
    fn is_along_z(&self) -> bool {
        let [x, y, z] = self.axis.array();
        (x == R::ZERO) & (y == R::ZERO) & (z == R::ONE)
    }

    /// S q̇: the velocity across the joint in the body's frame. Zero if fixed.
    #[inline(always)]
    pub fn motion(&self, rate: R) -> Motion<R> {
        match self.kind {
            JointKind::Revolute => Motion::new(self.axis * rate, R::Vec3::ZERO),
            JointKind::Prismatic => Motion::new(R::Vec3::ZERO, self.axis * rate),
            JointKind::Fixed => Motion::ZERO,
        }
    }

    /// v × S q̇: the acceleration of a body that moves with v as its joint turns at `rate`.
    #[inline(always)]
    pub fn velocity_product(&self, v: Motion<R>, rate: R) -> Motion<R> {
        let along = self.axis * rate;
        match self.kind {
            JointKind::Revolute => Motion::new(v.ang.cross(along), v.lin.cross(along)),
            JointKind::Prismatic => Motion::new(R::Vec3::ZERO, v.ang.cross(along)),
            JointKind::Fixed => Motion::ZERO,
        }
    }

    /// Sᵀ f: the part of a force that the joint's motor carries.
    #[inline(always)]
    pub fn project(&self, f: Force<R>) -> R {
        match self.kind {
            JointKind::Revolute => self.axis.dot(f.ang),
            JointKind::Prismatic => self.axis.dot(f.lin),
            JointKind::Fixed => R::ZERO,
        }
    }
}

/// The same about z, applied to E: two rows are mixed. 18 flops instead of 69.
#[inline(always)]
fn turned_about_z<R: Real>(e: &R::Mat3, turn: Turn<R>) -> R::Mat3 {
    let [x, y, z] = e.cols();
    R::Mat3::from_cols(
        turn.about_z(x.array()),
        turn.about_z(y.array()),
        turn.about_z(z.array()),
    )
}

/// The rotation of coordinates for a turn about the unit axis u, Rodrigues' formula:
/// E = c 1 + (1 − c) u uᵀ − s u×.
#[inline(always)]
fn rotation<R: Real>(axis: R::Vec3, turn: Turn<R>) -> R::Mat3 {
    let [x, y, z] = axis.array();
    let (s, c) = (turn.sin, turn.cos);
    let k = R::ONE - c;
    let (sx, sy, sz) = (s * x, s * y, s * z);
    let (kx, ky, kz) = (k * x, k * y, k * z);
    R::Mat3::from_cols(
        R::Vec3::new(kx * x + c, kx * y - sz, kx * z + sy),
        R::Vec3::new(kx * y + sz, ky * y + c, ky * z - sx),
        R::Vec3::new(kx * z - sy, ky * z + sx, kz * z + c),
    )
}
