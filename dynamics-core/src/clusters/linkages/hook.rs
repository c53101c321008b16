//! A universal joint, about y and then about x, from the direction in which its body points.

use super::dyad::{Branch, Root, root};
use super::zero::of_unit;
use crate::clusters::ClusterProblem;
use crate::model::JointCoordinate;
use crate::scalar::{Real, Vector};

/// A universal joint: the body's z axis is e_l = (sin α cos v, −sin v, cos α cos v), α about y and
/// v about x.
///
/// Spherical coordinates of the vector z = l e_l, with e_α = (cos α, 0, −sin α) and e_v = ∂e_l/∂v:
/// ż = l̇ e_l + l α̇ cos v e_α + l v̇ e_v.
#[derive(Clone, Copy)]
pub(super) struct Hook<R> {
    /// sin α and cos α.
    turn: [R; 2],
    /// sin v and cos v.
    lift: [R; 2],
    /// 1 / (l cos v), 1/m, damped where the body is parallel to y.
    pub(super) flat_inv: R,
    pub(super) singular: bool,
}

impl<R: Real> Hook<R> {
    /// For a body that points along `z`, m, with 1/l and l² of its length.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(z: R::Vec3, l_inv: R, l2: R) -> Result<Self, ClusterProblem> {
        let [zx, zy, zz] = z.array();
        let flat2 = zx * zx + zz * zz;
        let Root { h, h_inv, singular } = root(flat2, l2, Branch::Positive)?;
        let turn = if singular { direction(zx, zz, flat2) } else { [zx * h_inv, zz * h_inv] };
        Ok(Self { turn, lift: [-(zy * l_inv), h * l_inv], flat_inv: h_inv, singular })
    }

    /// For a body of almost no length, which is `scale` at most: with rates that are damped as that
    /// size has it.
    #[cold]
    #[inline(never)]
    pub(super) fn short(z: R::Vec3, scale: R) -> Result<Self, ClusterProblem> {
        let [zx, zy, zz] = z.array();
        let flat2 = zx * zx + zz * zz;
        let Root { h, h_inv, .. } = root(flat2, scale, Branch::Positive)?;
        Ok(Self {
            turn: direction(zx, zz, flat2),
            lift: direction(-zy, h, flat2 + zy * zy),
            flat_inv: h_inv,
            singular: true,
        })
    }

    /// The coordinates α − `from` and v, `from` being the angle of this sine and cosine.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn angles_from(&self, [sin, cos]: [R; 2]) -> [JointCoordinate<R>; 2] {
        let ([sa, ca], [sv, cv]) = (self.turn, self.lift);
        let turn = of_unit(sa * cos - ca * sin, ca * cos + sa * sin);
        [turn, of_unit(sv, cv)]
    }

    /// The coordinates α and v.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn angles(&self) -> [JointCoordinate<R>; 2] {
        let ([sa, ca], [sv, cv]) = (self.turn, self.lift);
        [of_unit(sa, ca), of_unit(sv, cv)]
    }

    /// α̇ of ż.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn turn_rate(&self, zd: R::Vec3) -> R {
        let ([sa, ca], [x, _, z]) = (self.turn, zd.array());
        (ca * x - sa * z) * self.flat_inv
    }

    /// v̇ of ż at constant length.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn lift_rate(&self, zd: R::Vec3) -> R {
        -(zd.array()[1] * self.flat_inv)
    }

    /// e_l, e_α and e_v.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn axes(&self) -> [R::Vec3; 3] {
        let ([sa, ca], [sv, cv]) = (self.turn, self.lift);
        [
            R::Vec3::new(sa * cv, -sv, ca * cv),
            R::Vec3::new(ca, R::ZERO, -sa),
            R::Vec3::new(-(sa * sv), -cv, -(ca * sv)),
        ]
    }

    /// α̈ and v̈ of z̈ and of the rates α̇ and v̇ at constant length `l`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn accelerations(&self, zdd: R::Vec3, [turn, lift]: [R; 2], l: R) -> [R; 2] {
        let ([sa, ca], [x, y, z]) = (self.turn, zdd.array());
        // z̈·e_α = l (α̈ cos v − 2 α̇ v̇ sin v), −z̈_y = l (v̈ cos v − v̇² sin v).
        let across = lift * (l * self.lift[0]);
        [
            (ca * x - sa * z + (turn + turn) * across) * self.flat_inv,
            (lift * across - y) * self.flat_inv,
        ]
    }

    /// α̈, v̈ and l̈ of z̈ and of the rates α̇, v̇ and l̇ of a body of length l.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn telescoping(
        &self,
        zdd: R::Vec3,
        [turn, lift, slide]: [R; 3],
        [l, l_inv]: [R; 2],
    ) -> [R; 3] {
        let ([sa, ca], [sv, cv]) = (self.turn, self.lift);
        let ([e_l, _, e_lift], [x, _, z]) = (self.axes(), zdd.array());
        let level = turn * cv;
        let stretch = slide * l_inv;
        let both = turn * (lift * sv - stretch * cv);
        let lengthening = stretch * lift;
        [
            (ca * x - sa * z + (both + both) * l) * self.flat_inv,
            zdd.dot(e_lift) * l_inv - (lengthening + lengthening) - turn * level * sv,
            zdd.dot(e_l) + l * (level * level + lift * lift),
        ]
    }
}

/// x and z of square `squared` at length one, also where that is almost zero.
#[cold]
#[inline(never)]
fn direction<R: Real>(x: R, z: R, squared: R) -> [R; 2] {
    if squared < R::MIN_POSITIVE {
        return [R::ZERO, R::ONE];
    }
    let inv = squared.rsqrt();
    [x * inv, z * inv]
}
