//! Vectors and matrices of three over [`Folded`]: glam's cannot hold it.

use core::ops::{Add, Neg, Sub};

use crate::engine::folding::Folded;
use crate::scalar::{Real, Vector};
use glam::{DMat3, DVec3};

/// A vector.
#[derive(Clone, Copy)]
pub(crate) struct Vec3<R>(pub(crate) [Folded<R>; 3]);

/// A matrix, by columns.
#[derive(Clone, Copy)]
pub(crate) struct Mat3<R>(pub(crate) [Vec3<R>; 3]);

impl<R: Real> Vec3<R> {
    pub(crate) const ZERO: Self = Self([Folded::ZERO; 3]);

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn constant(v: DVec3) -> Self {
        Self([Folded::constant(v.x), Folded::constant(v.y), Folded::constant(v.z)])
    }

    /// A vector of run-time numbers.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn runtime(v: R::Vec3) -> Self {
        let [x, y, z] = v.array();
        Self([Folded::runtime(x), Folded::runtime(y), Folded::runtime(z)])
    }

    /// The plain vector.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn get(self) -> R::Vec3 {
        let [x, y, z] = self.0;
        R::Vec3::new(x.get(), y.get(), z.get())
    }

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn scale(self, s: Folded<R>) -> Self {
        let [x, y, z] = self.0;
        Self([x * s, y * s, z * s])
    }

    /// The component of the axis of this number.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along_axis(self, axis: usize) -> Folded<R> {
        let [x, y, z] = self.0;
        match axis {
            0 => x,
            1 => y,
            _ => z,
        }
    }

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn dot(self, o: Self) -> Folded<R> {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        ax * bx + ay * by + az * bz
    }

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn cross(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    }

    /// Rz(q) v: out of the body's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turn(self, sin: Folded<R>, cos: Folded<R>) -> Self {
        let [x, y, z] = self.0;
        Self([cos * x - sin * y, sin * x + cos * y, z])
    }

    /// Rz(q)ᵀ v: into the body's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turn_back(self, sin: Folded<R>, cos: Folded<R>) -> Self {
        let [x, y, z] = self.0;
        Self([cos * x + sin * y, cos * y - sin * x, z])
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ax + bx, ay + by, az + bz])
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn sub(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ax - bx, ay - by, az - bz])
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn neg(self) -> Self {
        let [x, y, z] = self.0;
        Self([-x, -y, -z])
    }
}

impl<R: Real> Mat3<R> {
    pub(crate) const ZERO: Self = Self([Vec3::ZERO; 3]);

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn constant(m: &DMat3) -> Self {
        Self([Vec3::constant(m.x_axis), Vec3::constant(m.y_axis), Vec3::constant(m.z_axis)])
    }

    /// The rows.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn rows(&self) -> [Vec3<R>; 3] {
        let [x, y, z] = self.0;
        [
            Vec3([x.0[0], y.0[0], z.0[0]]),
            Vec3([x.0[1], y.0[1], z.0[1]]),
            Vec3([x.0[2], y.0[2], z.0[2]]),
        ]
    }

    /// M v.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn mul(&self, v: Vec3<R>) -> Vec3<R> {
        let ([x, y, z], [a, b, c]) = (self.0, v.0);
        x.scale(a) + y.scale(b) + z.scale(c)
    }

    /// Mᵀ v.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn transpose_mul(&self, v: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.0;
        Vec3([x.dot(v), y.dot(v), z.dot(v)])
    }
}

impl<R: Real> Mat3<R> {
    /// Rz M Rzᵀ.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn rotated_about_z(&self, sin: Folded<R>, cos: Folded<R>) -> Self {
        let [Vec3([xx, yx, zx]), Vec3([xy, yy, zy]), Vec3([xz, yz, zz])] = self.0;
        let w = sin * (xx - yy) + cos * (xy + yx);
        let (step, bend) = (sin * w, cos * w);
        Self([
            Vec3([xx - step, bend - xy, cos * zx - sin * zy]),
            Vec3([bend - yx, yy + step, sin * zx + cos * zy]),
            Vec3([cos * xz - sin * yz, sin * xz + cos * yz, zz]),
        ])
    }
}

impl<R: Real> Add for Mat3<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ax + bx, ay + by, az + bz])
    }
}

/// A symmetric matrix, by its upper triangle.
#[derive(Clone, Copy)]
pub(crate) struct Sym3<R> {
    pub(crate) xx: Folded<R>,
    pub(crate) xy: Folded<R>,
    pub(crate) xz: Folded<R>,
    pub(crate) yy: Folded<R>,
    pub(crate) yz: Folded<R>,
    pub(crate) zz: Folded<R>,
}

impl<R: Real> Sym3<R> {
    pub(crate) const ZERO: Self = Self {
        xx: Folded::ZERO,
        xy: Folded::ZERO,
        xz: Folded::ZERO,
        yy: Folded::ZERO,
        yz: Folded::ZERO,
        zz: Folded::ZERO,
    };

    /// A matrix that is symmetric but for rounding.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(m: &Mat3<R>) -> Self {
        let [x, y, z] = m.0;
        Self { xx: x.0[0], xy: y.0[0], xz: z.0[0], yy: y.0[1], yz: z.0[1], zz: z.0[2] }
    }

    /// The columns.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn columns(&self) -> [Vec3<R>; 3] {
        [
            Vec3([self.xx, self.xy, self.xz]),
            Vec3([self.xy, self.yy, self.yz]),
            Vec3([self.xz, self.yz, self.zz]),
        ]
    }

    /// Rz S Rzᵀ, by five products.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turn(self, sin: Folded<R>, cos: Folded<R>) -> Self {
        let bend = cos * self.xy;
        let w = sin * (self.xx - self.yy) + bend + bend;
        let step = sin * w;
        Self {
            xx: self.xx - step,
            yy: self.yy + step,
            xy: cos * w - self.xy,
            xz: cos * self.xz - sin * self.yz,
            yz: sin * self.xz + cos * self.yz,
            zz: self.zz,
        }
    }

    /// a bᵀ + b aᵀ.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn both(a: Vec3<R>, b: Vec3<R>) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (a.0, b.0);
        let (xx, yy, zz) = (ax * bx, ay * by, az * bz);
        Self {
            xx: xx + xx,
            xy: ax * by + ay * bx,
            xz: ax * bz + az * bx,
            yy: yy + yy,
            yz: ay * bz + az * by,
            zz: zz + zz,
        }
    }

    /// s a aᵀ.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn square(a: Vec3<R>, s: Folded<R>) -> Self {
        let ([x, y, z], [sx, sy, sz]) = (a.0, a.scale(s).0);
        Self { xx: sx * x, xy: sx * y, xz: sx * z, yy: sy * y, yz: sy * z, zz: sz * z }
    }
}

impl<R: Real> Add for Sym3<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            xx: self.xx + o.xx,
            xy: self.xy + o.xy,
            xz: self.xz + o.xz,
            yy: self.yy + o.yy,
            yz: self.yz + o.yz,
            zz: self.zz + o.zz,
        }
    }
}
