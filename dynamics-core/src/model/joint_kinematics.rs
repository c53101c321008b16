//! The kinematics of one joint: ⁱX_λ(i), S q̇, S̊ q̇, Sᵀ f. RBDA (2008), table 4.1.
//!
//! In a link's aligned frame every axis is z, so that S is made of unit vectors, and only a
//! universal joint's first column depends on q.

use super::LinkView;
use super::joint_coordinate::{JointCoordinate, near_unit, rotation};
use super::joint_kind::JointKind;
use crate::math::entry;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{AxialScrews, Force, Motion, MotionSubspace, Screw, Xform, raised};
use crate::trig::Kernel;

use JointKind::*;

impl<R: Real> LinkView<'_, R> {
    /// Its entries of the joints' sines and cosines: those of its angles, its quaternion at unit
    /// length.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn pose<K: Kernel<R>>(&self, q: &[R], turns: &mut [JointCoordinate<R>]) {
        let (count, _) = self.kind.coordinates();
        let (angles, quaternion) = self.kind.angles();
        let unit = if quaternion > 0 {
            near_unit([0, 1, 2, 3].map(|k| entry(q, self.idx_q + k)))
        } else {
            [R::ZERO; 4]
        };
        for k in 0..count {
            let q = entry(q, self.idx_q + k);
            if let Some(turn) = turns.get_mut(self.idx_q + k) {
                *turn = if k < angles {
                    JointCoordinate::with_kernel::<K>(q)
                } else if k < quaternion {
                    JointCoordinate::linear(entry(&unit, k))
                } else {
                    JointCoordinate::linear(q)
                };
            }
        }
    }

    /// ⁱX_λ(i) = X_J ᵀX: from the parent's aligned frame to the body's, at the configuration
    /// `turns`.
    #[cfg_attr(optimised, inline(always))]
    pub fn xform(&self, turns: &[JointCoordinate<R>]) -> Xform<R> {
        let e = &self.placement.rot;
        let q = |k| entry(turns, self.idx_q + k);
        let rot = match self.kind {
            Revolute | Continuous | Helical | Cylindrical | Planar => q(0).about_z(e),
            Universal => q(1).about_z(&q(0).about_x(e)),
            Spherical | Free => rotation([q(0).q, q(1).q, q(2).q, q(3).q]) * *e,
            Prismatic | Fixed => *e,
        };
        let pos = self.origin(turns);
        Xform { rot, pos }
    }

    /// The same, of which the rotation is given: the origin is a constant of most joints, so that
    /// storing it costs more than computing it.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn xform_of(&self, rot: R::Mat3, turns: &[JointCoordinate<R>]) -> Xform<R> {
        let pos = self.origin(turns);
        Xform { rot, pos }
    }

    /// Whether the link is turned from its parent about x, and shifted along x and along its own
    /// axis, exactly.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn is_placed_by_screws(&self) -> bool {
        let ([x, y, z], [_, r_y, r_z]) =
            (self.placement.rot.cols().map(Vector::array), self.placement.pos.array());
        let across = (y[1] * r_y).abs() + (z[1] * r_z).abs();
        x[0] > R::ZERO && x[1].abs() + x[2].abs() + across == R::ZERO
    }

    /// The same transform of a link that [is placed by screws](Self::is_placed_by_screws).
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn screws(&self, turns: &[JointCoordinate<R>]) -> AxialScrews<R> {
        let [[_, cos, _], [_, sin, _]] = [1, 2].map(|k| self.placement.rot.cols()[k].array());
        let [_, y, z] = self.placement.pos.array();
        self.screws_of(cos * z - sin * y, turns)
    }

    /// The same, of which the shift along z is given.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn screws_of(&self, along_z: R, turns: &[JointCoordinate<R>]) -> AxialScrews<R> {
        let [_, y, z] = self.placement.rot.cols().map(Vector::array);
        let [along_x, _, _] = self.placement.pos.array();
        let turn = entry(turns, self.idx_q);
        AxialScrews {
            about_x: Screw { sin: z[1], cos: y[1], shift: along_x },
            about_z: Screw { sin: turn.sin, cos: turn.cos, shift: along_z },
        }
    }

    /// The origin of the body in its parent's aligned frame, m.
    #[cfg_attr(optimised, inline(always))]
    pub fn origin(&self, turns: &[JointCoordinate<R>]) -> R::Vec3 {
        let (e, r) = (&self.placement.rot, self.placement.pos);
        let q = |k| entry(turns, self.idx_q + k).q;
        match self.kind {
            Revolute | Continuous | Universal | Spherical | Fixed => r,
            Prismatic => r + row_z::<R>(e) * q(0),
            Helical => r + row_z::<R>(e) * (self.joint.pitch * q(0)),
            Cylindrical => r + row_z::<R>(e) * q(1),
            Planar => r + e.transpose_mul(R::Vec3::new(q(1), q(2), R::ZERO)),
            Free => r + e.transpose_mul(R::Vec3::new(q(4), q(5), q(6))),
        }
    }

    /// S q̇: the velocity of the joint, where `rates` is all of q̇ (or S q̈ of all of q̈).
    #[cfg_attr(optimised, inline(always))]
    pub fn motion(&self, turns: &[JointCoordinate<R>], rates: &[R]) -> Motion<R> {
        let zero = R::Vec3::ZERO;
        let rate = |k| entry(rates, self.idx_v + k);
        let three = |k| R::Vec3::new(rate(k), rate(k + 1), rate(k + 2));
        match self.kind {
            Revolute | Continuous => Motion::new(z(rate(0)), zero),
            Prismatic => Motion::new(zero, z(rate(0))),
            Helical => Motion::new(z(rate(0)), z(self.joint.pitch * rate(0))),
            Cylindrical => Motion::new(z(rate(0)), z(rate(1))),
            Universal => {
                let turn = entry(turns, self.idx_q + 1);
                let x_y = [turn.cos * rate(0), -(turn.sin * rate(0))];
                Motion::new(R::Vec3::new(x_y[0], x_y[1], rate(1)), zero)
            }
            Spherical => Motion::new(three(0), zero),
            Planar => Motion::new(z(rate(0)), R::Vec3::new(rate(1), rate(2), R::ZERO)),
            Free => Motion::new(three(0), three(3)),
            Fixed => Motion::ZERO,
        }
    }

    /// m + S q̇, without additions of the zeros of S.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn plus_motion(
        &self,
        m: Motion<R>,
        turns: &[JointCoordinate<R>],
        rates: &[R],
    ) -> Motion<R> {
        let rate = entry(rates, self.idx_v);
        match self.kind {
            Revolute | Continuous => Motion::new(raised(m.ang, rate), m.lin),
            Prismatic => Motion::new(m.ang, raised(m.lin, rate)),
            Fixed => m,
            _ => m + self.motion(turns, rates),
        }
    }

    /// a + S̊ q̇ + v × S q̇: an acceleration with the velocity products of the body and its joint.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn plus_velocity_product(
        &self,
        a: Motion<R>,
        turns: &[JointCoordinate<R>],
        rates: &[R],
        v: Motion<R>,
    ) -> Motion<R> {
        self.plus_subspace_rate(a, turns, rates, v, rates)
    }

    /// a + (S̊ + v × S) y, where S changes by the joint's velocity in all of q̇, `rates`, and `y`
    /// is another velocity.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn plus_subspace_rate(
        &self,
        a: Motion<R>,
        turns: &[JointCoordinate<R>],
        rates: &[R],
        v: Motion<R>,
        y: &[R],
    ) -> Motion<R> {
        let rate = entry(y, self.idx_v);
        match self.kind {
            Revolute | Continuous => {
                Motion::new(plus_cross_z(a.ang, v.ang, rate), plus_cross_z(a.lin, v.lin, rate))
            }
            Prismatic => Motion::new(a.ang, plus_cross_z(a.lin, v.ang, rate)),
            Fixed => a,
            Universal => {
                let (turn, second) = (entry(turns, self.idx_q + 1), entry(rates, self.idx_v + 1));
                let k = -(rate * second);
                let apparent = R::Vec3::new(k * turn.sin, k * turn.cos, R::ZERO);
                a + v.cross(self.motion(turns, y)) + Motion::new(apparent, R::Vec3::ZERO)
            }
            _ => a + v.cross(self.motion(turns, y)),
        }
    }

    /// a + ω × S q̇ of a joint that turns: α and the acceleration of the origin, which lies on the
    /// axis; w is the body's angular velocity.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn plus_turning_product(&self, a: Motion<R>, rates: &[R], w: R::Vec3) -> Motion<R> {
        Motion::new(plus_cross_z(a.ang, w, entry(rates, self.idx_v)), a.lin)
    }

    /// Column k of S̊ + v × S, the rate of S in a body of velocity v.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn column_rate(
        &self,
        turns: &[JointCoordinate<R>],
        rates: &[R],
        v: Motion<R>,
        k: usize,
    ) -> Motion<R> {
        let zero = R::Vec3::ZERO;
        let cross_z = |v: R::Vec3| {
            let [x, y, _] = v.array();
            R::Vec3::new(y, -x, R::ZERO)
        };
        match self.kind {
            Revolute | Continuous => Motion::new(cross_z(v.ang), cross_z(v.lin)),
            Prismatic => Motion::new(zero, cross_z(v.ang)),
            Universal if k == 0 => {
                let (turn, second) = (entry(turns, self.idx_q + 1), entry(rates, self.idx_v + 1));
                let apparent = R::Vec3::new(turn.sin * second, turn.cos * second, R::ZERO);
                v.cross(self.column(turns, k)) + Motion::new(-apparent, zero)
            }
            _ => v.cross(self.column(turns, k)),
        }
    }

    /// The derivative of the [position](Self::position) that belongs to k along the coordinate j of
    /// q ⊕ δ, which at planar and free joints moves the body along its own axes.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn position_slope(&self, turns: &[JointCoordinate<R>], k: usize, j: usize) -> R {
        let q = |k| entry(turns, self.idx_q + k);
        let (first, e) = match self.kind {
            Spherical => return R::ZERO,
            Planar => (self.idx_v + 1, q(0).about_z(&R::Mat3::IDENTITY)),
            Free => (self.idx_v + 3, rotation([q(0).q, q(1).q, q(2).q, q(3).q])),
            _ => return if k == j { R::ONE } else { R::ZERO },
        };
        match (k.checked_sub(first), j.checked_sub(first)) {
            (Some(k), Some(j)) => entry(&entry(&e.cols(), k).array(), j),
            (None, None) if self.kind == Planar => R::ONE,
            _ => R::ZERO,
        }
    }

    /// The dependence of S on the joint's coordinate k, if there is one.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn bend(&self, turns: &[JointCoordinate<R>], k: usize) -> Option<Bend<R>> {
        if self.kind != Universal || k != 1 {
            return None;
        }
        let turn = entry(turns, self.idx_q + 1);
        let column = R::Vec3::new(-turn.sin, -turn.cos, R::ZERO);
        let column = Motion::new(column, R::Vec3::ZERO);
        Some(Bend { column, straight: self.column(turns, 0), idx_v: self.idx_v })
    }

    /// Column k of S: the velocity of the joint at unit rate of its coordinate k.
    #[cfg_attr(optimised, inline(always))]
    pub fn column(&self, turns: &[JointCoordinate<R>], k: usize) -> Motion<R> {
        let zero = R::Vec3::ZERO;
        match self.kind {
            Revolute | Continuous => Motion::new(z(R::ONE), zero),
            Prismatic => Motion::new(zero, z(R::ONE)),
            Helical => Motion::new(z(R::ONE), z(self.joint.pitch)),
            Cylindrical => Motion::unit(2 + 3 * k),
            Universal if k == 0 => {
                let turn = entry(turns, self.idx_q + 1);
                Motion::new(R::Vec3::new(turn.cos, -turn.sin, R::ZERO), zero)
            }
            Universal => Motion::unit(2),
            Planar => Motion::unit(2 + k),
            Spherical | Free => Motion::unit(k),
            Fixed => Motion::ZERO,
        }
    }

    /// Column k of S.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn subspace(&self, turns: &[JointCoordinate<R>], k: usize) -> MotionSubspace<R> {
        match self.kind {
            Revolute | Continuous => MotionSubspace::RevoluteZ,
            Prismatic => MotionSubspace::PrismaticZ,
            Spherical | Free => MotionSubspace::Unit(k),
            _ => MotionSubspace::General(self.column(turns, k)),
        }
    }

    /// Sᵀ f: the components of a force along the joint's coordinates, stored in their entries of
    /// `tau`.
    #[cfg_attr(optimised, inline(always))]
    pub fn project(&self, turns: &[JointCoordinate<R>], f: Force<R>, tau: &mut [R]) {
        let ([nx, ny, nz], [fx, fy, fz]) = (f.ang.array(), f.lin.array());
        let mut put = |values: &[R]| {
            for (k, &value) in values.iter().enumerate() {
                if let Some(tau) = tau.get_mut(self.idx_v + k) {
                    *tau = value;
                }
            }
        };
        match self.kind {
            Revolute | Continuous => put(&[nz]),
            Prismatic => put(&[fz]),
            Helical => put(&[nz + self.joint.pitch * fz]),
            Cylindrical => put(&[nz, fz]),
            Universal => {
                let turn = entry(turns, self.idx_q + 1);
                put(&[turn.cos * nx - turn.sin * ny, nz]);
            }
            Spherical => put(&[nx, ny, nz]),
            Planar => put(&[nz, fx, fy]),
            Free => put(&[nx, ny, nz, fx, fy, fz]),
            Fixed => {}
        }
    }

    /// (v × S + S̊)ᵀ f: the components of a force along the rate of S in a body of velocity v.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn project_rate(
        &self,
        turns: &[JointCoordinate<R>],
        rates: &[R],
        v: Motion<R>,
        f: Force<R>,
        out: &mut [R],
    ) {
        self.project(turns, -v.cross_force(f), out);
        if self.kind == Universal
            && let Some(first) = out.get_mut(self.idx_v)
        {
            let turn = entry(turns, self.idx_q + 1);
            let [nx, ny, _] = f.ang.array();
            *first -= entry(rates, self.idx_v + 1) * (turn.sin * nx + turn.cos * ny);
        }
    }
}

/// The dependence of a universal joint's S on its second angle.
pub(crate) struct Bend<R: Real> {
    /// ∂S₀/∂q₁.
    pub(crate) column: Motion<R>,
    /// S₀, which is −∂²S₀/∂q₁².
    straight: Motion<R>,
    idx_v: usize,
}

impl<R: Real> Bend<R> {
    /// (∂S/∂q₁) y of a velocity in all of `rates`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(&self, rates: &[R]) -> Motion<R> {
        self.column * entry(rates, self.idx_v)
    }

    /// ∂(S̊ q̇)/∂q₁.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of_rate(&self, qd: &[R]) -> Motion<R> {
        -(self.straight * (entry(qd, self.idx_v) * entry(qd, self.idx_v + 1)))
    }
}

/// A vector along z.
#[cfg_attr(optimised, inline(always))]
fn z<R: Real>(z: R) -> R::Vec3 {
    R::Vec3::new(R::ZERO, R::ZERO, z)
}

/// a + v × z r.
#[cfg_attr(optimised, inline(always))]
fn plus_cross_z<R: Real>(a: R::Vec3, v: R::Vec3, r: R) -> R::Vec3 {
    let ([x, y, z], [vx, vy, _]) = (a.array(), v.array());
    R::Vec3::new(x + vy * r, y - vx * r, z)
}

/// The last row of a matrix: z of the turned frame.
#[cfg_attr(optimised, inline(always))]
fn row_z<R: Real>(m: &R::Mat3) -> R::Vec3 {
    let [x, y, z] = m.cols().map(|column| column.array()[2]);
    R::Vec3::new(x, y, z)
}
