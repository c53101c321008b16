//! The constrained directions of a loop joint. RBDA (2008), table 4.1 and section 8.2.
//!
//! All in the successor's aligned loop frame, in which the joint's axis is z and a universal
//! joint's second one: the relative velocity of the successor along the constrained directions T is
//! Tᵀ v, the force of the joint T λ. Only the direction of a universal joint's couple depends on
//! the configuration.

use crate::model::JointKind::{self, *};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, Xform};

/// The most directions that a joint constrains.
pub(super) const MOST: usize = 6;

/// 1 + cos of the angle beyond which a rotational error has no direction: 172°.
const OPPOSITE: f64 = 0.01;
/// The error in its place, 2 tan(θ/2) of somewhat more.
const LARGE: f64 = 30.0;

/// The numbers of rotations and of translations among the constrained directions.
pub(super) const fn counts(kind: JointKind) -> [usize; 2] {
    match kind {
        Fixed => [3, 3],
        Prismatic => [3, 2],
        Revolute | Continuous | Helical => [2, 3],
        Cylindrical => [2, 2],
        Planar => [2, 1],
        Universal => [1, 3],
        Spherical => [0, 3],
        Free => [0, 0],
    }
}

/// A loop joint at one configuration.
pub(super) struct JointConstraint<R: Real> {
    pub(super) kind: JointKind,
    /// Slide per turn of a helical joint, m/rad.
    pub(super) pitch: R,
    /// From the predecessor's aligned loop frame to the successor's.
    pub(super) x: Xform<R>,
}

impl<R: Real> JointConstraint<R> {
    /// Tᵀ m.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn across(&self, m: Motion<R>) -> [R; MOST] {
        let ([p, q, r], [x, y, z], o) = (m.ang.array(), m.lin.array(), R::ZERO);
        match self.kind {
            Fixed => [p, q, r, x, y, z],
            Prismatic => [p, q, r, x, y, o],
            Revolute | Continuous => [p, q, x, y, z, o],
            Helical => [p, q, x, y, z - self.pitch * r, o],
            Cylindrical => [p, q, x, y, o, o],
            Planar => [p, q, z, o, o, o],
            Universal => [self.normal().dot(m.ang), x, y, z, o, o],
            Spherical => [x, y, z, o, o, o],
            Free => [o; MOST],
        }
    }

    /// T λ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn force(&self, lambda: [R; MOST]) -> Force<R> {
        let ([a, b, c, d, e, f], o) = (lambda, R::ZERO);
        let force = |[p, q, r]: [R; 3], [x, y, z]: [R; 3]| {
            Force::new(R::Vec3::new(p, q, r), R::Vec3::new(x, y, z))
        };
        match self.kind {
            Fixed => force([a, b, c], [d, e, f]),
            Prismatic => force([a, b, c], [d, e, o]),
            Revolute | Continuous => force([a, b, o], [c, d, e]),
            Helical => force([a, b, -(self.pitch * e)], [c, d, e]),
            Cylindrical => force([a, b, o], [c, d, o]),
            Planar => force([a, b, o], [o, o, c]),
            Universal => Force::new(self.normal() * a, R::Vec3::new(b, c, d)),
            Spherical => force([o, o, o], [a, b, c]),
            Free => Force::ZERO,
        }
    }

    /// φ: rotations as 2 tan(θ/2) about their axis, rad for small errors, and m.
    pub(super) fn position(&self) -> [R; MOST] {
        let ([x, y, z], o) = ((self.x.rot * self.x.pos).array(), R::ZERO);
        // For a joint that slides, the error across the predecessor's axis, or along it: that
        // across the successor's would change with its tilt as much as it has slid.
        let [across, away, along] = self.x.pos.array();
        let [u, w, _] = (self.x.rot * R::Vec3::new(across, away, o)).array();
        let turned = |x, y, z| {
            let [p, q, r] = self.turn();
            [p, q, r, x, y, z]
        };
        let tilted = |x, y, z| {
            let [a, b] = self.tilt();
            [a, b, x, y, z, o]
        };
        match self.kind {
            Fixed => turned(x, y, z),
            Prismatic => turned(u, w, o),
            Revolute | Continuous => tilted(x, y, z),
            Helical => tilted(u, w, self.thread(along)),
            Cylindrical => tilted(u, w, o),
            Planar => tilted(along, o, o),
            Universal => {
                let [[_, _, across], ..] = self.x.rot.cols().map(Vector::array);
                [across, x, y, z, o, o]
            }
            Spherical => [x, y, z, o, o, o],
            Free => [o; MOST],
        }
    }

    /// Ṫᵀ v of the relative velocity v: what Tᵀ a lacks of the derivative of Tᵀ v.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn apparent(&self, v: Motion<R>) -> [R; MOST] {
        let mut apparent = [R::ZERO; MOST];
        if self.kind == Universal {
            // d/dt (z × u) = z × (u × ω) for the first axis u, fixed in the predecessor.
            let ([u, ..], w) = (self.x.rot.cols(), v.ang);
            let ([_, _, u_z], [_, _, w_z]) = (u.array(), w.array());
            apparent[0] = u.dot(w) * w_z - w.dot(w) * u_z;
        }
        apparent
    }

    /// z × u, the direction of a universal joint's couple: u is the first axis, z the second.
    #[cfg_attr(optimised, inline(always))]
    fn normal(&self) -> R::Vec3 {
        let [u, ..] = self.x.rot.cols();
        let [x, y, _] = u.array();
        R::Vec3::new(-y, x, R::ZERO)
    }

    /// The rotation that takes the predecessor's z to the successor's: 2 tan(θ/2) about x and y.
    fn tilt(&self) -> [R; 2] {
        let [.., z] = self.x.rot.cols();
        let [x, y, cos] = z.array();
        let twice = R::ONE + cos;
        if twice < R::from_f64(OPPOSITE) {
            return [R::from_f64(LARGE), R::ZERO];
        }
        let scale = R::from_f64(2.0) / twice;
        [y * scale, -(x * scale)]
    }

    /// The rotation from the predecessor to the successor, 2 tan(θ/2) about each axis.
    fn turn(&self) -> [R; 3] {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.x.rot.cols().map(Vector::array);
        let twice = (R::ONE + xx + yy + zz) * R::from_f64(0.5);
        if twice < R::from_f64(OPPOSITE) {
            return [R::from_f64(LARGE), R::ZERO, R::ZERO];
        }
        let scale = R::ONE / twice;
        [zy - yz, xz - zx, yx - xy].map(|sine| sine * scale)
    }

    /// The distance of a place along the axis of a screw from the nearest thread at this turn.
    fn thread(&self, z: R) -> R {
        let [[cos, minus_sin, _], ..] = self.x.rot.cols().map(Vector::array);
        let lead = self.pitch * R::from_f64(core::f64::consts::TAU);
        let off = z - self.pitch * (-minus_sin).atan2(cos);
        if lead == R::ZERO {
            return off;
        }
        let half = R::from_f64(if off * lead > R::ZERO { 0.5 } else { -0.5 });
        off - lead * (off / lead + half).trunc_saturating()
    }
}
