//! Vectors and matrices of scalars that glam does not have.

use dynamics_core::scalar::{Matrix, Real, Vector};

use super::{assigning, operators};

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<R>(pub [R; 3]);

/// A 3×3 matrix, by columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3<R>(pub [Vec3<R>; 3]);

/// A scalar that these are made of.
pub trait Plain: Real<Vec3 = Vec3<Self>, Mat3 = Mat3<Self>> {
    /// Σ a b, rounded as little as the scalar can.
    fn products<const K: usize>(terms: [(Self, Self); K]) -> Self;
}

impl<R: Copy> Vec3<R> {
    /// From components, in constants too.
    pub const fn of(x: R, y: R, z: R) -> Self {
        Self([x, y, z])
    }
}

impl<R: Copy> Mat3<R> {
    /// From columns, in constants too.
    pub const fn of(x: Vec3<R>, y: Vec3<R>, z: Vec3<R>) -> Self {
        Self([x, y, z])
    }
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
        let minor = |a: R, y: R, b: R, x: R| R::products([(a, y), (-b, x)]);
        Self([minor(b, z, c, y), minor(c, x, a, z), minor(a, y, b, x)])
    }
}

impl<R: Plain> Matrix<R> for Mat3<R> {
    const ZERO: Self = Self([Vec3([R::ZERO; 3]); 3]);
    const IDENTITY: Self = {
        let (i, o) = (R::ONE, R::ZERO);
        Self([Vec3([i, o, o]), Vec3([o, i, o]), Vec3([o, o, i])])
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

operators! {
    [R: Plain] Vec3<R>, Add add (Self) -> Self: |a, b| Self([0, 1, 2].map(|i| a.0[i] + b.0[i]));
    [R: Plain] Vec3<R>, Sub sub (Self) -> Self: |a, b| Self([0, 1, 2].map(|i| a.0[i] - b.0[i]));
    [R: Plain] Vec3<R>, Mul mul (R) -> Self: |a, s| Self(a.0.map(|x| x * s));
    [R: Plain] Vec3<R>, Neg neg () -> Self: |a| Self(a.0.map(|x| -x));
    [R: Plain] Mat3<R>, Add add (Self) -> Self: |a, b| Self([0, 1, 2].map(|i| a.0[i] + b.0[i]));
    [R: Plain] Mat3<R>, Sub sub (Self) -> Self: |a, b| Self([0, 1, 2].map(|i| a.0[i] - b.0[i]));
    [R: Plain] Mat3<R>, Mul mul (R) -> Self: |a, s| Self(a.0.map(|x| x * s));
    [R: Plain] Mat3<R>, Mul mul (Vec3<R>) -> Vec3<R>: |a, v| a.transpose().transpose_mul(v);
    [R: Plain] Mat3<R>, Mul mul (Self) -> Self: |a, b| Self(b.0.map(|column| a * column));
}
assigning! {
    [R: Plain] Vec3<R>, AddAssign add_assign +;
    [R: Plain] Vec3<R>, SubAssign sub_assign -;
    [R: Plain] Mat3<R>, AddAssign add_assign +;
    [R: Plain] Mat3<R>, SubAssign sub_assign -;
}
