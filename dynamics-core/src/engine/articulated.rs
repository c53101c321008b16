//! Articulated-body inertia: what a joint must move when the joints beyond it are free.
//!
//! Featherstone, RBDA (2008), section 7.1, in blocks over units of length:
//! n = I α + H a, f = Hᵀ α + A a.

use core::ops::Add;

use super::field::Inertia;
use super::known::Known;
use super::prepare::Joint;
use super::small::{Mat3, Sym3, Vec3};
use crate::model::Turn;
use crate::scalar::Real;

/// The three blocks.
#[derive(Clone, Copy)]
pub(crate) struct Articulated<R> {
    pub(crate) turning: Sym3<R>,
    pub(crate) mixed: Mat3<R>,
    pub(crate) moving: Sym3<R>,
}

impl<R: Real> Articulated<R> {
    /// A rigid body's: I = tr Σ 1 − Σ, H = [h]×, A = m 1.
    #[inline(always)]
    pub(crate) fn of(body: &Inertia<R>) -> Self {
        let (s, m, zero) = (body.second, body.mass, Known::ZERO);
        let [x, y, z] = body.moment.0;
        Self {
            turning: Sym3 {
                xx: s.yy + s.zz,
                xy: -s.xy,
                xz: -s.xz,
                yy: s.xx + s.zz,
                yz: -s.yz,
                zz: s.xx + s.yy,
            },
            mixed: Mat3([
                Vec3([zero, z, -y]),
                Vec3([-z, zero, x]),
                Vec3([y, -x, zero]),
            ]),
            moving: Sym3 {
                xx: m,
                yy: m,
                zz: m,
                ..Sym3::ZERO
            },
        }
    }

    /// What is left when a joint yields: less U Uᵀ/d.
    #[inline(always)]
    pub(crate) fn yielding(self, n: Vec3<R>, f: Vec3<R>, per_d: Known<R>) -> Self {
        let ([fx, fy, fz], minus) = (f.scale(per_d).0, -per_d);
        let [hx, hy, hz] = self.mixed.0;
        Self {
            turning: self.turning + Sym3::square(n, minus),
            mixed: Mat3([hx - n.scale(fx), hy - n.scale(fy), hz - n.scale(fz)]),
            moving: self.moving + Sym3::square(f, minus),
        }
    }

    /// The same in the parent's frame and about its origin; RBDA (2.66).
    #[inline(always)]
    pub(crate) fn handed_down(self, joint: &Joint, turn: Turn<R>, slide: Known<R>) -> Self {
        let (rot, mut p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        let mut at = self;
        if joint.prismatic {
            p = p + rot.0[2].scale(slide);
        } else {
            let (sin, cos) = (Known::any(turn.sin), Known::any(turn.cos));
            at = Self {
                turning: at.turning.turn(sin, cos),
                mixed: at.mixed.turned(sin, cos),
                moving: at.moving.turn(sin, cos),
            };
        }
        let moving = at.moving.rotate(&rot);
        let here = at.mixed.rotate(&rot);
        // H′ = H + [p]× A; I′ = I + [p]× Hᵀ + ([p]× H′ᵀ)ᵀ.
        let [ax, ay, az] = moving.columns();
        let mixed = here + Mat3([p.cross(ax), p.cross(ay), p.cross(az)]);
        let [[x, y, z], [x_, y_, z_]] = [here.rows(), mixed.rows()];
        let (lx, ly, lz) = (p.cross(x), p.cross(y), p.cross(z));
        let (rx, ry, rz) = (p.cross(x_), p.cross(y_), p.cross(z_));
        let shift = Sym3 {
            xx: lx.0[0] + rx.0[0],
            xy: ly.0[0] + rx.0[1],
            xz: lz.0[0] + rx.0[2],
            yy: ly.0[1] + ry.0[1],
            yz: lz.0[1] + ry.0[2],
            zz: lz.0[2] + rz.0[2],
        };
        Self {
            turning: at.turning.rotate(&rot) + shift,
            mixed,
            moving,
        }
    }
}

impl<R: Real> Add for Articulated<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            turning: self.turning + o.turning,
            mixed: self.mixed + o.mixed,
            moving: self.moving + o.moving,
        }
    }
}
