//! The wrench that a change of motion causes in a body with its descendants: see the
//! [module](super).

use super::Change;
use crate::engine::acceleration_field::{AccelerationField, Inertia, Wrench};
use crate::engine::compile::{Compiled, Joint};
use crate::engine::displacement::Displacement;
use crate::engine::folding::{Folded, Mat3, Vec3, rotate_matrix_to_parent, rotate_to_parent};
use crate::engine::joint_rates::Twist;
use crate::scalar::Real;

/// The inertia of a body and its descendants, its rates, and the wrench that it needs.
#[derive(Clone, Copy)]
pub(super) struct Composite<R> {
    pub(super) inertia: Inertia<R>,
    /// P.
    pub(super) momentum: Vec3<R>,
    /// D, whose column k is ∫ r ṙ_k dm.
    pub(super) product: Mat3<R>,
    pub(super) wrench: Wrench<R>,
}

/// The coefficients of the torque by which a joint feels a change: g δa + κ β + 2 s δω.
#[derive(Clone, Copy)]
pub(super) struct Felt<R> {
    /// (g, κ): the wrench of a unit acceleration.
    pub(super) unit: Wrench<R>,
    pub(super) rate: Vec3<R>,
}

/// S of a coordinate, in units of length.
#[cfg_attr(optimised, inline(always))]
pub(super) fn subspace<R: Real>(joint: &Joint) -> Twist<R> {
    Twist::along(joint, 1.0, Folded::ONE)
}

impl<R: Real> Composite<R> {
    /// A body alone: P = ω × h, D = Σ \[ω\]×ᵀ.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(inertia: Inertia<R>, field: &AccelerationField<R>) -> Self {
        let ([wx, wy, wz], [x, y, z]) = (field.omega_products.0, inertia.second.columns());
        let product =
            Mat3([z.scale(wy) - y.scale(wz), x.scale(wz) - z.scale(wx), y.scale(wx) - x.scale(wy)]);
        let momentum = field.omega_products.cross(inertia.moment);
        Self { inertia, momentum, product, wrench: field.wrench(&inertia) }
    }

    /// The wrench by which a change is felt, at the origin.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn wrench_by(&self, change: &Change<R>) -> Wrench<R> {
        let (h, s, d) = (self.inertia.moment, &self.inertia.second, &self.product.0);
        let (w, beta) = (change.omega, change.beta);
        let [x, y, z] = s.columns();
        let half_f = w.cross(self.momentum);
        let f = change.accel.scale(self.inertia.mass) + beta.cross(h) + half_f + half_f;
        let half_n = w.scale(d[0].0[0] + d[1].0[1] + d[2].0[2])
            - Vec3([d[0].dot(w), d[1].dot(w), d[2].dot(w)]);
        let spin = beta.scale(s.xx + s.yy + s.zz) - Vec3([x.dot(beta), y.dot(beta), z.dot(beta)]);
        Wrench { f, n: h.cross(change.accel) + spin + half_n + half_n }
    }

    /// The coefficients of a joint's torque, in units of length.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn felt(&self, joint: &Joint) -> Felt<R> {
        let Mat3([x, y, z]) = self.product;
        let ([xx, xy, xz], [yx, yy, yz], [zx, zy, zz]) = (x.0, y.0, z.0);
        let turned = match joint.axis {
            0 => [yy + zz, -xy, -xz],
            1 => [-yx, xx + zz, -yz],
            _ => [-zx, -zy, xx + yy],
        };
        let s = subspace(joint);
        let turned = if joint.prismatic { Vec3::ZERO } else { Vec3(turned) };
        let unit = self.inertia.wrench_of(joint, Folded::ONE);
        Felt { unit, rate: turned + self.momentum.cross(s.lin) }
    }

    /// The change of the composite's wrench as the joint moves it.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn moved_wrench(&self, joint: &Joint) -> Wrench<R> {
        let (Wrench { f, n }, s) = (self.wrench, subspace(joint));
        Wrench { f: s.ang.cross(f), n: s.ang.cross(n) + s.lin.cross(f) }
    }

    /// The same in the frame of joint I's parent and about its origin, which is `offset` away and
    /// moves more slowly by `step`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn to_parent<T: Compiled, const I: usize>(
        self,
        at: &Displacement<R, T, I>,
        step: Vec3<R>,
        offset: Vec3<R>,
    ) -> Self {
        let turned = self.inertia.turned(at);
        let h = rotate_to_parent::<R, T, I>(turned.moment);
        let p = rotate_to_parent::<R, T, I>(at.leave(self.momentum));
        let Mat3([x, y, z]) = rotate_matrix_to_parent::<R, T, I>(&at.leave_matrix(&self.product));
        let m = self.inertia.mass;
        let ([px, py, pz], [ux, uy, uz]) = (p.0, step.0);
        let there = h + offset.scale(m);
        let product = Mat3([
            x + offset.scale(px) + there.scale(ux),
            y + offset.scale(py) + there.scale(uy),
            z + offset.scale(pz) + there.scale(uz),
        ]);
        Self {
            inertia: turned.turned_to_parent(at),
            momentum: p + step.scale(m),
            product,
            wrench: self.wrench.to_parent(at),
        }
    }
}

impl<R: Real> core::ops::Add for Composite<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            inertia: self.inertia + o.inertia,
            momentum: self.momentum + o.momentum,
            product: self.product + o.product,
            wrench: self.wrench + o.wrench,
        }
    }
}

impl<R: Real> Felt<R> {
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(&self, change: &Change<R>) -> Folded<R> {
        let half = self.rate.dot(change.omega);
        self.unit.f.dot(change.accel) + self.unit.n.dot(change.beta) + half + half
    }

    /// The same in the frame of joint I's parent, at whose origin the change is then.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn to_parent<T: Compiled, const I: usize>(
        self,
        at: &Displacement<R, T, I>,
        step: Vec3<R>,
    ) -> Self {
        let unit = self.unit.to_parent(at);
        let rate = rotate_to_parent::<R, T, I>(at.leave(self.rate));
        Self { unit, rate: rate + step.cross(unit.f) }
    }
}
