//! The acceleration field of a body, from parent to child, and the wrench of its inertia.
//!
//! The field form of the Newton-Euler equations: the acceleration of the points of a body, and the
//! wrench of its inertia,
//!
//! ```text
//! a(r) = a + U r        U = α× + ω× ω×      Σ = ∫ r rᵀ dm
//! f    = m a + U h      n = h × a + axial(U Σ − Σ Uᵀ)
//! ```
//!
//! Balafoutis & Patel, *Dynamic Analysis of Robot Manipulators* (1991), also use U.

use core::ops::Add;

use super::compile::{Compiled, CompiledJoint, Joint, JointMotion};
use super::displacement::{Displacement, offset_cross};
use super::folding::Folded;
use super::folding::{Mat3, Sym3, Vec3};
use super::folding::{rotate_symmetric_to_parent, rotate_to_parent};
use super::joint_rates::{JointRates, SeveralRates};
use super::pose::Pose;
use crate::effects::RegroupedInertia;
use crate::model::{BASE, JointCoordinate};
use crate::scalar::Real;

/// The acceleration field of a body, in its frame.
#[derive(Clone, Copy)]
pub(crate) struct AccelerationField<R> {
    /// ω, for effects that read the body's velocity.
    pub(crate) omega: Vec3<R>,
    /// ω in the velocity products: zero unless an effect needs them.
    pub(crate) omega_products: Vec3<R>,
    /// α.
    pub(crate) alpha: Vec3<R>,
    /// U = \[α\]× + \[ω\]×\[ω\]×.
    pub(crate) u: Mat3<R>,
    /// Acceleration of the origin, in units of length.
    pub(crate) a: Vec3<R>,
    /// Velocity of the origin, in units of length; zero unless an effect reads it.
    pub(crate) v: Vec3<R>,
    /// Pose of the body; unknown unless an effect reads it.
    pub(crate) pose: Pose<R>,
}

/// The base parameters of a body, or of a body and its descendants: m, h and Σ, in units of length.
#[derive(Clone, Copy)]
pub(crate) struct Inertia<R> {
    pub(crate) mass: Folded<R>,
    pub(crate) moment: Vec3<R>,
    pub(crate) second: Sym3<R>,
}

/// A force f at the origin and a couple n.
#[derive(Clone, Copy)]
pub(crate) struct Wrench<R> {
    pub(crate) f: Vec3<R>,
    pub(crate) n: Vec3<R>,
}

impl<R: Real> Wrench<R> {
    pub(crate) const ZERO: Self = Self { f: Vec3::ZERO, n: Vec3::ZERO };

    /// The component along a joint's coordinate at the origin: N·m about its axis, or N along it.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(&self, joint: &Joint, length_inv: Folded<R>) -> Folded<R> {
        if joint.prismatic {
            self.f.along_axis(joint.axis) * length_inv
        } else if matches!(joint.motion, JointMotion::Screw) {
            self.n.0[2] + self.f.0[2] * Folded::constant(joint.pitch)
        } else {
            self.n.along_axis(joint.axis)
        }
    }

    /// The same in the frame of joint I's parent and about its origin.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn to_parent<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        self.turned(at).turned_to_parent(at)
    }

    /// The same in the joint's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turned<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        Self { f: at.leave(self.f), n: at.leave(self.n) }
    }

    /// The same in the frame of joint I's parent and about its origin, from the joint's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turned_to_parent<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        let f = rotate_to_parent::<R, T, I>(self.f);
        Self { f, n: rotate_to_parent::<R, T, I>(self.n) + offset_cross(f, at) }
    }
}

impl<R: Real> Add for Wrench<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self { f: self.f + o.f, n: self.n + o.n }
    }
}

impl<R: Real> Inertia<R> {
    /// No body.
    pub(crate) const NONE: Self =
        Self { mass: Folded::ZERO, moment: Vec3::ZERO, second: Sym3::ZERO };

    /// The wrench of a unit acceleration along a joint's coordinate.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn wrench_of(&self, joint: &Joint, length_inv: Folded<R>) -> Wrench<R> {
        let (zero, [hx, hy, hz], s) = (Folded::ZERO, self.moment.0, &self.second);
        if joint.prismatic {
            let (m, x, y, z) =
                (self.mass * length_inv, hx * length_inv, hy * length_inv, hz * length_inv);
            let (f, n) = match joint.axis {
                0 => ([m, zero, zero], [zero, z, -y]),
                1 => ([zero, m, zero], [-z, zero, x]),
                _ => ([zero, zero, m], [y, -x, zero]),
            };
            return Wrench { f: Vec3(f), n: Vec3(n) };
        }
        let (f, n) = match joint.axis {
            0 => ([zero, -hz, hy], [s.yy + s.zz, -s.xy, -s.xz]),
            1 => ([hz, zero, -hx], [-s.xy, s.xx + s.zz, -s.yz]),
            _ => ([-hy, hx, zero], [-s.xz, -s.yz, s.xx + s.yy]),
        };
        let turn = Wrench { f: Vec3(f), n: Vec3(n) };
        if matches!(joint.motion, JointMotion::Screw) {
            let pitch = Folded::constant(joint.pitch);
            let slide =
                Wrench { f: along_z(self.mass * pitch), n: Vec3([hy, -hx, zero]).scale(pitch) };
            return turn + slide;
        }
        turn
    }

    /// The inertia left to a body.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(joint: &Joint) -> Self {
        Self {
            mass: Folded::constant(joint.mass),
            moment: Vec3::constant(joint.moment),
            second: Sym3::of(&Mat3::constant(&joint.second)),
        }
    }

    /// The inertia left to a body in M.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn in_matrix(joint: &Joint) -> Self {
        Self { second: Sym3::of(&Mat3::constant(&joint.matrix_second)), ..Self::of(joint) }
    }

    /// The inertia left to a body on a base that may move.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn second_moment_only(joint: &Joint) -> Self {
        Self { second: Sym3::of(&Mat3::constant(&joint.second_moment_only)), ..Self::of(joint) }
    }

    /// The inertia that loaded base parameters leave to a body, which coordinate `by` moves; what
    /// is zero of every robot is a known zero.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn loaded(body: &RegroupedInertia<R>, by: &Joint, base_moves: bool) -> Self {
        let ([x, y, z], [xx, xy, xz, yy, yz]) =
            (body.moment.map(Folded::runtime), body.second.map(Folded::runtime));
        let (zero, mut second) = (Folded::ZERO, Sym3::ZERO);
        if by.prismatic {
            return Self { mass: Folded::runtime(body.mass), moment: Vec3([x, y, z]), second };
        }
        use JointMotion::*;
        if matches!(by.motion, Turn | Screw | Planar) && by.parent == BASE && !base_moves {
            // A base at rest leaves one rotation, about z, which depends on Σ_xx + Σ_yy alone.
            second.xx = xx + yy;
        } else {
            (second.xx, second.yy) = (xx, yy);
            (second.xy, second.xz, second.yz) = (xy, xz, yz);
        }
        let mut left = Self { mass: zero, moment: Vec3([x, y, zero]), second };
        if matches!(by.motion, Screw | Planar | Free) {
            left.mass = Folded::runtime(body.mass);
        }
        if !matches!(by.motion, Turn) {
            left.moment = Vec3([x, y, z]);
        }
        if matches!(by.motion, Spherical | Free) {
            left.second.zz = Folded::runtime(body.second_zz);
        }
        left
    }

    /// The same in the frame of joint I's parent and about its origin.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn to_parent<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        self.turned(at).turned_to_parent(at)
    }

    /// The same in the frame of joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turned<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        Self {
            mass: self.mass,
            moment: at.leave(self.moment),
            second: at.leave_symmetric(self.second),
        }
    }

    /// The same in the frame of joint I's parent and about its origin, from the joint's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turned_to_parent<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        let joint = CompiledJoint::<T, I>::JOINT;
        let mut p = Vec3::constant(joint.pos);
        if CompiledJoint::<T, I>::SHIFTS {
            p = p + at.shift();
        }
        let h = rotate_to_parent::<R, T, I>(self.moment);
        let second = rotate_symmetric_to_parent::<R, T, I>(self.second);
        Self {
            mass: self.mass,
            moment: h + p.scale(self.mass),
            second: second + Sym3::both(h, p) + Sym3::square(p, self.mass),
        }
    }
}

impl<R: Real> Add for Inertia<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            mass: self.mass + o.mass,
            moment: self.moment + o.moment,
            second: self.second + o.second,
        }
    }
}

impl<R: Real> AccelerationField<R> {
    /// The field of a base at rest, in its pose.
    pub(crate) const RESTING: Self = Self {
        omega: Vec3::ZERO,
        omega_products: Vec3::ZERO,
        alpha: Vec3::ZERO,
        u: Mat3::ZERO,
        a: Vec3::ZERO,
        v: Vec3::ZERO,
        pose: Pose::BASE,
    };

    /// The field of a child behind joint I of one coordinate.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn across<T: Compiled, const I: usize>(
        &self,
        at: &Displacement<R, T, I>,
        rates: JointRates<R>,
    ) -> Self {
        let joint = CompiledJoint::<T, I>::JOINT;
        match CompiledJoint::<T, I>::MOTION {
            JointMotion::Slide => self.across_prismatic(joint, at.slide, rates),
            JointMotion::Screw => self.across_screw(joint, at, rates),
            _ => self.across_revolute::<true>(joint, at.turn, rates),
        }
    }

    /// The field of a child behind a revolute joint: in the axes of the child, or in those that it
    /// has at q = 0.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn across_revolute<const TURNED: bool>(
        &self,
        joint: &Joint,
        turn: JointCoordinate<R>,
        rates: JointRates<R>,
    ) -> Self {
        let (rot, p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        let omega_products =
            enter::<R, TURNED>(&rot, turn, self.omega_products) + along_z(rates.omega_products);
        let az = rot.transpose_mul(self.alpha).0[2] + rates.accel;
        // Points on the joint's axis move with both links: U's column along it is the parent's.
        let along = enter::<R, TURNED>(&rot, turn, self.u.mul(rot.0[2]));
        let a = enter::<R, TURNED>(&rot, turn, self.a + self.u.mul(p));
        let (ax, ay, u) = complete(omega_products, az, along);
        Self {
            omega: enter::<R, TURNED>(&rot, turn, self.omega) + along_z(rates.velocity),
            omega_products,
            alpha: Vec3([ax, ay, az]),
            u,
            a,
            v: enter::<R, TURNED>(&rot, turn, self.v + self.omega.cross(p)),
            pose: Pose::UNKNOWN,
        }
    }

    /// The field of a child behind a prismatic joint at q, in units of length.
    #[cfg_attr(optimised, inline(always))]
    fn across_prismatic(&self, joint: &Joint, q: Folded<R>, rates: JointRates<R>) -> Self {
        let rot = Mat3::constant(&joint.rot);
        let p = Vec3::constant(joint.pos) + rot.0[2].scale(q);
        let omega_products = rot.transpose_mul(self.omega_products);
        let a = rot.transpose_mul(self.a + self.u.mul(p));
        let v = rot.transpose_mul(self.v + self.omega.cross(p));
        let u = Mat3([
            rot.transpose_mul(self.u.mul(rot.0[0])),
            rot.transpose_mul(self.u.mul(rot.0[1])),
            rot.transpose_mul(self.u.mul(rot.0[2])),
        ]);
        Self {
            omega: rot.transpose_mul(self.omega),
            omega_products,
            alpha: rot.transpose_mul(self.alpha),
            u,
            a: a + omega_products.cross(along_z(rates.omega_products + rates.omega_products))
                + along_z(rates.accel),
            v: v + along_z(rates.velocity),
            pose: Pose::UNKNOWN,
        }
    }

    /// The field of a child behind a screw joint: a rotation, then a translation that it drives.
    #[cfg_attr(optimised, inline(always))]
    fn across_screw<T, const I: usize>(
        &self,
        joint: &Joint,
        at: &Displacement<R, T, I>,
        rates: JointRates<R>,
    ) -> Self {
        let turned = self.across_revolute::<true>(joint, at.turn, rates);
        let pitch = Folded::constant(joint.pitch);
        let (shift, products) = (along_z(at.slide), rates.omega_products * pitch);
        Self {
            a: turned.a
                + turned.u.mul(shift)
                + turned.omega_products.cross(along_z(products + products))
                + along_z(rates.accel * pitch),
            v: turned.v + turned.omega.cross(shift) + along_z(rates.velocity * pitch),
            ..turned
        }
    }

    /// The field of a child behind joint I, a planar, spherical or free one: v_J is the velocity of
    /// the body in the joint's frame, by the body's axes, so that α = E α_λ + ω̇_J + E ω_λ × ω_J
    /// and a = E a_λ(p) + v̇_J + (ω + E ω_λ) × v_J.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn across_several<T: Compiled, const I: usize>(
        &self,
        at: &Displacement<R, T, I>,
        rates: &SeveralRates<R>,
    ) -> Self {
        let joint = CompiledJoint::<T, I>::JOINT;
        let rot = Mat3::constant(&joint.rot);
        let p = Vec3::constant(joint.pos) + at.shift();
        let carried = at.enter(&rot, self.omega_products);
        let omega_products = carried + rates.products.ang;
        let alpha =
            at.enter(&rot, self.alpha) + rates.accel.ang + carried.cross(rates.products.ang);
        let a = at.enter(&rot, self.a + self.u.mul(p));
        let v = at.enter(&rot, self.v + self.omega.cross(p));
        Self {
            omega: at.enter(&rot, self.omega) + rates.velocity.ang,
            omega_products,
            alpha,
            u: u_of(alpha, omega_products),
            a: a + rates.accel.lin + (omega_products + carried).cross(rates.products.lin),
            v: v + rates.velocity.lin,
            pose: Pose::UNKNOWN,
        }
    }

    /// The wrench that accelerates the body's inertia: f = m a + U h, n = h × a + axial(U Σ − Σ
    /// Uᵀ).
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn wrench(&self, body: &Inertia<R>) -> Wrench<R> {
        let (mass, h) = (body.mass, body.moment);
        let ([x, y, z], [wx, wy, wz]) = (self.u.0, self.omega_products.0);
        let (sxx, sxy, sxz) = (body.second.xx, body.second.xy, body.second.xz);
        let (syy, syz, szz) = (body.second.yy, body.second.yz, body.second.zz);
        let (xx, yy, zz) = (wx * wx, wy * wy, wz * wz);
        let (zy, xz, yx) = (zz - yy, xx - zz, yy - xx);
        let n = Vec3([zy * syz, xz * sxz, yx * sxy])
            + Vec3([x.0[2] * sxy, y.0[0] * syz, z.0[1] * sxz])
            + Vec3([y.0[2] * syy, z.0[0] * szz, x.0[1] * sxx])
            - Vec3([x.0[1] * sxz, y.0[2] * sxy, z.0[0] * syz])
            - Vec3([z.0[1] * szz, x.0[2] * sxx, y.0[0] * syy]);
        Wrench { f: self.a.scale(mass) + self.u.mul(h), n: h.cross(self.a) + n }
    }
}

/// U = \[α\]× + \[ω\]×\[ω\]×.
#[cfg_attr(optimised, inline(always))]
pub(super) fn u_of<R: Real>(alpha: Vec3<R>, omega: Vec3<R>) -> Mat3<R> {
    let ([ax, ay, az], [wx, wy, wz]) = (alpha.0, omega.0);
    let (xz, yz, xy) = (wx * wz, wy * wz, wx * wy);
    let (xx, yy, zz) = (wx * wx, wy * wy, wz * wz);
    Mat3([
        Vec3([-(yy + zz), xy + az, xz - ay]),
        Vec3([xy - az, -(xx + zz), yz + ax]),
        Vec3([xz + ay, yz - ax, -(xx + yy)]),
    ])
}

/// α_x, α_y and U from ω, α_z and U's z column.
#[cfg_attr(optimised, inline(always))]
fn complete<R: Real>(
    omega: Vec3<R>,
    az: Folded<R>,
    along: Vec3<R>,
) -> (Folded<R>, Folded<R>, Mat3<R>) {
    let ([wx, wy, wz], [uxz, uyz, uzz]) = (omega.0, along.0);
    let (xz, yz, xy) = (wx * wz, wy * wz, wx * wy);
    let (xx, yy, zz) = (wx * wx, wy * wy, wz * wz);
    let (ax, ay) = (yz - uyz, uxz - xz);
    let u = Mat3([
        Vec3([-(yy + zz), xy + az, xz - ay]),
        Vec3([xy - az, -(xx + zz), yz + ax]),
        Vec3([uxz, uyz, uzz]),
    ]);
    (ax, ay, u)
}

/// Rz(q)ᵀ Rᵀ v: from the parent's frame into the body's, or Rᵀ v. A function, not a closure:
/// closures are inlined too late for the tags to fold.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn enter<R: Real, const TURNED: bool>(
    rot: &Mat3<R>,
    turn: JointCoordinate<R>,
    v: Vec3<R>,
) -> Vec3<R> {
    let v = rot.transpose_mul(v);
    if TURNED { v.turn_back(Folded::runtime(turn.sin), Folded::runtime(turn.cos)) } else { v }
}

/// A vector along the joint's axis.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn along_z<R: Real>(z: Folded<R>) -> Vec3<R> {
    Vec3([Folded::ZERO, Folded::ZERO, z])
}
