//! The inertia of the bodies beyond joints on parallel axes, as these joints feel it: four sums in
//! place of a composite inertia.
//!
//! Most arms have two or three such joints in a row, perpendicular to the joint on the base. Turns
//! about their axis z change neither z nor Σ_xx + Σ_yy, so that of Σ no component is turned: only h
//! is. The joint on the base feels Σ along e, its own axis, which lies in their x-y plane, and
//! along u, perpendicular to both. Moved by p, the offset of a joint from its parent:
//!
//! - h becomes h + m p,
//! - Σ_xx + Σ_yy becomes Σ_xx + Σ_yy + 2 h·p + m p·p,
//! - z·Σe becomes z·Σe + h_z (p·e), since p has no component along z,
//! - u·Σu becomes u·Σu + 2 (u·h)(u·p) + m (u·p)².
//!
//! These are the components of Σ + h pᵀ + p hᵀ + m p pᵀ, as in [`super::crba`].

use core::ops::Add;

use super::acceleration_field::{Inertia, Wrench, along_z};
use super::compile::{Compiled, CompiledJoint};
use super::displacement::Displacement;
use super::folding::{Folded, Vec3, rotate_to_parent};
use super::joint_rates::Twist;
use crate::scalar::Real;

/// The sums of a composite body, in the frame of its joint.
#[derive(Clone, Copy)]
pub(crate) struct Felt<R> {
    mass: Folded<R>,
    /// h.
    moment: Vec3<R>,
    /// Σ_xx + Σ_yy, about the parallel axes.
    pub(crate) about: Folded<R>,
    /// z·Σe, the component of M of the joint and the one on the base if that one moves at rate −1.
    pub(crate) between: Folded<R>,
    /// u·Σu + Σ_zz, about the axis of the joint on the base.
    of_root: Folded<R>,
}

impl<R: Real> Felt<R> {
    pub(crate) const NONE: Self = Self {
        mass: Folded::ZERO,
        moment: Vec3::ZERO,
        about: Folded::ZERO,
        between: Folded::ZERO,
        of_root: Folded::ZERO,
    };

    /// Those of a body and of the inertia `spin` that turns about z alone feel; `root` is the
    /// motion of the joint on the base, in its frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(body: &Inertia<R>, spin: Folded<R>, root: &Twist<R>) -> Self {
        let (s, [ex, ey, _]) = (&body.second, root.ang.0);
        // For a unit vector u, u·Σu = Σ_yy + u_x ((Σ_xx − Σ_yy) u_x + 2 Σ_xy u_y).
        let (ux, uy) = (ey, -ex);
        let of_root = s.yy + s.zz + ux * ((s.xx - s.yy) * ux + (s.xy + s.xy) * uy);
        Self {
            mass: body.mass,
            moment: body.moment,
            about: (s.xx + spin) + s.yy,
            between: ex * s.xz + ey * s.yz,
            of_root,
        }
    }

    /// The wrench of the joint's unit acceleration without what only the joint on the base feels of
    /// it, in the joint's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn wrench<T: Compiled, const I: usize>(
        &self,
        at: &Displacement<R, T, I>,
    ) -> Wrench<R> {
        let [hx, hy, _] = at.leave(self.moment).0;
        Wrench { f: Vec3([-hy, hx, Folded::ZERO]), n: along_z(self.about) }
    }

    /// The same sums in the frame of joint I's parent and about its origin; `root` is in that
    /// frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn to_parent<T: Compiled, const I: usize>(
        self,
        at: &Displacement<R, T, I>,
        root: &Twist<R>,
    ) -> Self {
        let joint = CompiledJoint::<T, I>::JOINT;
        let (p, z) = (Vec3::constant(joint.pos), Vec3::constant(joint.rot.z_axis));
        let turned = at.leave(self.moment);
        let moment = rotate_to_parent::<R, T, I>(turned);
        let (along, u, m) = (moment.dot(p), z.cross(root.ang), self.mass);
        let (up, mp) = (u.dot(p), p.scale(m));
        let across = u.dot(moment) * up;
        Self {
            mass: m,
            moment: moment + mp,
            about: self.about + along + along + mp.dot(p),
            between: self.between + turned.0[2] * root.ang.dot(p),
            of_root: self.of_root + across + across + m * up * up,
        }
    }

    /// The inertia that the joint on the base feels of them, as a Σ in its frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn on_root(&self) -> Inertia<R> {
        let mut inertia = Inertia::NONE;
        inertia.second.xx = self.of_root;
        inertia
    }
}

impl<R: Real> Add for Felt<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            mass: self.mass + o.mass,
            moment: self.moment + o.moment,
            about: self.about + o.about,
            between: self.between + o.between,
            of_root: self.of_root + o.of_root,
        }
    }
}
