//! Vectors and matrices of scalars that glam does not have.

use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use super::{Matrix, Real, Vector};

/// A vector of three.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<R>(pub(crate) [R; 3]);

/// A 3×3 matrix, by columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3<R>(pub(crate) [Vec3<R>; 3]);

/// A scalar that these are made of.
pub trait Plain: Real<Vec3 = Vec3<Self>, Mat3 = Mat3<Self>> {
    /// Σ a b, rounded as little as the scalar can.
    fn products<const K: usize>(terms: [(Self, Self); K]) -> Self;
}

impl<R: Plain> Vector<R> for Vec3<R> {
    const ZERO: Self = Self([R::ZERO; 3]);
    #[inline(always)]
    fn new(x: R, y: R, z: R) -> Self {
        Self([x, y, z])
    }
    #[inline(always)]
    fn array(self) -> [R; 3] {
        self.0
    }
    #[inline(always)]
    fn dot(self, other: Self) -> R {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        R::products([(a, x), (b, y), (c, z)])
    }
    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([
            R::products([(b, z), (-c, y)]),
            R::products([(c, x), (-a, z)]),
            R::products([(a, y), (-b, x)]),
        ])
    }
}

impl<R: Plain> Matrix<R> for Mat3<R> {
    const ZERO: Self = Self([Vec3([R::ZERO; 3]); 3]);
    const IDENTITY: Self = {
        let (one, zero) = (R::ONE, R::ZERO);
        Self([
            Vec3([one, zero, zero]),
            Vec3([zero, one, zero]),
            Vec3([zero, zero, one]),
        ])
    };
    #[inline(always)]
    fn from_cols(x: Vec3<R>, y: Vec3<R>, z: Vec3<R>) -> Self {
        Self([x, y, z])
    }
    #[inline(always)]
    fn cols(self) -> [Vec3<R>; 3] {
        self.0
    }
    #[inline(always)]
    fn transpose(self) -> Self {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.0.map(|column| column.0);
        Self([Vec3([a, d, g]), Vec3([b, e, h]), Vec3([c, f, i])])
    }
    #[inline(always)]
    fn transpose_mul(self, v: Vec3<R>) -> Vec3<R> {
        Vec3(self.0.map(|column| column.dot(v)))
    }
}

impl<R: Plain> Mul<Vec3<R>> for Mat3<R> {
    type Output = Vec3<R>;
    #[inline(always)]
    fn mul(self, v: Vec3<R>) -> Vec3<R> {
        self.transpose().transpose_mul(v)
    }
}

impl<R: Plain> Mul for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self(o.0.map(|column| self * column))
    }
}

macro_rules! by_entry {
    ($t:ident) => {
        impl<R: Plain> Add for $t<R> {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                let ([a, b, c], [x, y, z]) = (self.0, o.0);
                Self([a + x, b + y, c + z])
            }
        }
        impl<R: Plain> Sub for $t<R> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                let ([a, b, c], [x, y, z]) = (self.0, o.0);
                Self([a - x, b - y, c - z])
            }
        }
        impl<R: Plain> Mul<R> for $t<R> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, s: R) -> Self {
                Self(self.0.map(|x| x * s))
            }
        }
        impl<R: Plain> AddAssign for $t<R> {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl<R: Plain> SubAssign for $t<R> {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
    };
}
by_entry!(Vec3);
by_entry!(Mat3);

impl<R: Plain> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

/// The operators that follow from others.
macro_rules! assigning {
    ($t:ty) => {
        impl Sub for $t {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                self + -o
            }
        }
        impl AddAssign for $t {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl SubAssign for $t {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
        impl MulAssign for $t {
            #[inline(always)]
            fn mul_assign(&mut self, o: Self) {
                *self = *self * o;
            }
        }
    };
}
pub(super) use assigning;
