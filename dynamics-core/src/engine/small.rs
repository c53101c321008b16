//! Vectors and matrices of three over [`Known`]: glam's cannot hold it.

use core::ops::{Add, Neg, Sub};

use super::known::Known;
use crate::scalar::{Real, Vector};
use glam::{DMat3, DVec3};

/// A vector.
#[derive(Clone, Copy)]
pub(crate) struct Vec3<R>(pub(crate) [Known<R>; 3]);

/// A matrix, by columns.
#[derive(Clone, Copy)]
pub(crate) struct Mat3<R>(pub(crate) [Vec3<R>; 3]);

impl<R: Real> Vec3<R> {
    pub(crate) const ZERO: Self = Self([Known::ZERO; 3]);

    #[inline(always)]
    pub(crate) fn constant(v: DVec3) -> Self {
        Self([
            Known::constant(v.x),
            Known::constant(v.y),
            Known::constant(v.z),
        ])
    }

    /// A vector of run-time numbers.
    #[inline(always)]
    pub(crate) fn any(v: R::Vec3) -> Self {
        let [x, y, z] = v.array();
        Self([Known::any(x), Known::any(y), Known::any(z)])
    }

    /// The plain vector.
    #[inline(always)]
    pub(crate) fn get(self) -> R::Vec3 {
        let [x, y, z] = self.0;
        R::Vec3::new(x.get(), y.get(), z.get())
    }

    #[inline(always)]
    pub(crate) fn scale(self, s: Known<R>) -> Self {
        let [x, y, z] = self.0;
        Self([x * s, y * s, z * s])
    }

    #[inline(always)]
    pub(crate) fn dot(self, o: Self) -> Known<R> {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        ax * bx + ay * by + az * bz
    }

    #[inline(always)]
    pub(crate) fn cross(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    }

    /// Rz(q) v: out of the body's frame.
    #[inline(always)]
    pub(crate) fn turn(self, sin: Known<R>, cos: Known<R>) -> Self {
        let [x, y, z] = self.0;
        Self([cos * x - sin * y, sin * x + cos * y, z])
    }

    /// Rz(q)ᵀ v: into the body's frame.
    #[inline(always)]
    pub(crate) fn turn_back(self, sin: Known<R>, cos: Known<R>) -> Self {
        let [x, y, z] = self.0;
        Self([cos * x + sin * y, cos * y - sin * x, z])
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ax + bx, ay + by, az + bz])
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ax - bx, ay - by, az - bz])
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let [x, y, z] = self.0;
        Self([-x, -y, -z])
    }
}

impl<R: Real> Mat3<R> {
    pub(crate) const ZERO: Self = Self([Vec3::ZERO; 3]);

    #[inline(always)]
    pub(crate) fn constant(m: &DMat3) -> Self {
        Self([
            Vec3::constant(m.x_axis),
            Vec3::constant(m.y_axis),
            Vec3::constant(m.z_axis),
        ])
    }

    /// The rows.
    #[inline(always)]
    pub(crate) fn rows(&self) -> [Vec3<R>; 3] {
        let [x, y, z] = self.0;
        [
            Vec3([x.0[0], y.0[0], z.0[0]]),
            Vec3([x.0[1], y.0[1], z.0[1]]),
            Vec3([x.0[2], y.0[2], z.0[2]]),
        ]
    }

    /// M v.
    #[inline(always)]
    pub(crate) fn mul(&self, v: Vec3<R>) -> Vec3<R> {
        let ([x, y, z], [a, b, c]) = (self.0, v.0);
        x.scale(a) + y.scale(b) + z.scale(c)
    }

    /// Mᵀ v.
    #[inline(always)]
    pub(crate) fn transpose_mul(&self, v: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.0;
        Vec3([x.dot(v), y.dot(v), z.dot(v)])
    }
}

impl<R: Real> Add for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, o.0);
        Self([ax + bx, ay + by, az + bz])
    }
}
