//! Articulated-body inertia: the inertia that a joint moves when its descendants are free.
//!
//! Featherstone, RBDA (2008), section 7.1, in blocks over units of length:
//!
//! ```text
//! n = I α + H a      f = Hᵀ α + A a
//! ```

use core::ops::Add;

use super::acceleration_field::{Inertia, Wrench};
use super::compile::{Compiled, Joint, JointMotion};
use super::displacement::{Displacement, cross_offset};
use super::folding::Folded;
use super::folding::{Mat3, Sym3, Vec3};
use super::folding::{rotate_matrix_to_parent, rotate_symmetric_to_parent};
use crate::scalar::Real;

/// The three blocks.
#[derive(Clone, Copy)]
pub(crate) struct Articulated<R> {
    pub(crate) ang: Sym3<R>,
    pub(crate) coupling: Mat3<R>,
    pub(crate) lin: Sym3<R>,
}

impl<R: Real> Articulated<R> {
    /// A rigid body's: I = tr Σ 1 − Σ, H = \[h\]×, A = m 1.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(body: &Inertia<R>) -> Self {
        let (s, m, zero) = (body.second, body.mass, Folded::ZERO);
        let [x, y, z] = body.moment.0;
        Self {
            ang: Sym3 {
                xx: s.yy + s.zz,
                xy: -s.xy,
                xz: -s.xz,
                yy: s.xx + s.zz,
                yz: -s.yz,
                zz: s.xx + s.yy,
            },
            coupling: Mat3([Vec3([zero, z, -y]), Vec3([-z, zero, x]), Vec3([y, -x, zero])]),
            lin: Sym3 { xx: m, yy: m, zz: m, ..Sym3::ZERO },
        }
    }

    /// The wrench of a unit acceleration along a joint's coordinate: the column of its axis.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn wrench_of(&self, joint: &Joint, length_inv: Folded<R>) -> Wrench<R> {
        let axis = joint.axis;
        if joint.prismatic {
            return Wrench {
                f: column(self.lin.columns(), axis).scale(length_inv),
                n: column(self.coupling.0, axis).scale(length_inv),
            };
        }
        let turn =
            Wrench { f: column(self.coupling.rows(), axis), n: column(self.ang.columns(), axis) };
        if matches!(joint.motion, JointMotion::Screw) {
            let pitch = Folded::constant(joint.pitch);
            let slide = Wrench {
                f: column(self.lin.columns(), axis).scale(pitch),
                n: column(self.coupling.0, axis).scale(pitch),
            };
            return turn + slide;
        }
        turn
    }

    /// The inertia with a joint free: minus U Uᵀ/d.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn minus_joint(self, n: Vec3<R>, f: Vec3<R>, d_inv: Folded<R>) -> Self {
        let ([fx, fy, fz], minus) = (f.scale(d_inv).0, -d_inv);
        let [hx, hy, hz] = self.coupling.0;
        Self {
            ang: self.ang + Sym3::square(n, minus),
            coupling: Mat3([hx - n.scale(fx), hy - n.scale(fy), hz - n.scale(fz)]),
            lin: self.lin + Sym3::square(f, minus),
        }
    }

    /// The same in the frame of joint I's parent and about its origin; RBDA (2.66).
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn to_parent<T, const I: usize>(self, at: &Displacement<R, T, I>) -> Self
    where
        T: Compiled,
    {
        let turned = Self {
            ang: at.leave_symmetric(self.ang),
            coupling: at.leave_matrix(&self.coupling),
            lin: at.leave_symmetric(self.lin),
        };
        let lin = rotate_symmetric_to_parent::<R, T, I>(turned.lin);
        let here = rotate_matrix_to_parent::<R, T, I>(&turned.coupling);
        // H′ = H + [p]× A; I′ = I + [p]× Hᵀ + ([p]× H′ᵀ)ᵀ.
        let coupling = here + cross_offset(Mat3(lin.columns()), at);
        let Mat3([lx, ly, lz]) = cross_offset(Mat3(here.rows()), at);
        let Mat3([rx, ry, rz]) = cross_offset(Mat3(coupling.rows()), at);
        let shift = Sym3 {
            xx: lx.0[0] + rx.0[0],
            xy: ly.0[0] + rx.0[1],
            xz: lz.0[0] + rx.0[2],
            yy: ly.0[1] + ry.0[1],
            yz: lz.0[1] + ry.0[2],
            zz: lz.0[2] + rz.0[2],
        };
        Self { ang: rotate_symmetric_to_parent::<R, T, I>(turned.ang) + shift, coupling, lin }
    }
}

#[cfg_attr(optimised, inline(always))]
fn column<R: Real>([x, y, z]: [Vec3<R>; 3], axis: usize) -> Vec3<R> {
    match axis {
        0 => x,
        1 => y,
        _ => z,
    }
}

impl<R: Real> Add for Articulated<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self { ang: self.ang + o.ang, coupling: self.coupling + o.coupling, lin: self.lin + o.lin }
    }
}
