//! Vectors and matrices of a scalar, which are glam's.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use super::Real;

/// A vector of three components.
pub trait Vector<R>:
    Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<R, Output = Self>
    + AddAssign
    + SubAssign
    + Send
    + Sync
    + 'static
{
    /// The zero vector.
    const ZERO: Self;
    /// From components.
    fn new(x: R, y: R, z: R) -> Self;
    /// The components.
    fn array(self) -> [R; 3];
    /// The scalar product.
    fn dot(self, other: Self) -> R;
    /// The vector product.
    fn cross(self, other: Self) -> Self;
}

/// A 3×3 matrix, stored by columns.
pub trait Matrix<R: Real>:
    Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<R::Vec3, Output = R::Vec3>
    + Mul<Self, Output = Self>
    + Mul<R, Output = Self>
    + AddAssign
    + SubAssign
    + Send
    + Sync
    + 'static
{
    /// The zero matrix.
    const ZERO: Self;
    /// The unit matrix.
    const IDENTITY: Self;
    /// From columns.
    fn from_cols(x: R::Vec3, y: R::Vec3, z: R::Vec3) -> Self;
    /// The columns.
    fn cols(self) -> [R::Vec3; 3];
    /// The transpose.
    fn transpose(self) -> Self;
    /// Mᵀ v.
    fn transpose_mul(self, v: R::Vec3) -> R::Vec3;
}

macro_rules! glam {
    ($r:ident, $vec:path, $mat:path) => {
        impl Vector<$r> for $vec {
            const ZERO: Self = Self::ZERO;
            #[cfg_attr(optimised, inline(always))]
            fn new(x: $r, y: $r, z: $r) -> Self {
                Self::new(x, y, z)
            }
            #[cfg_attr(optimised, inline(always))]
            fn array(self) -> [$r; 3] {
                [self.x, self.y, self.z]
            }
            #[cfg_attr(optimised, inline(always))]
            fn dot(self, other: Self) -> $r {
                self.dot(other)
            }
            #[cfg_attr(optimised, inline(always))]
            fn cross(self, other: Self) -> Self {
                self.cross(other)
            }
        }

        impl Matrix<$r> for $mat {
            const ZERO: Self = Self::ZERO;
            const IDENTITY: Self = Self::IDENTITY;
            #[cfg_attr(optimised, inline(always))]
            fn from_cols(x: $vec, y: $vec, z: $vec) -> Self {
                Self::from_cols(x, y, z)
            }
            #[cfg_attr(optimised, inline(always))]
            fn cols(self) -> [$vec; 3] {
                [self.x_axis, self.y_axis, self.z_axis]
            }
            #[cfg_attr(optimised, inline(always))]
            fn transpose(self) -> Self {
                Self::transpose(&self)
            }
            #[cfg_attr(optimised, inline(always))]
            fn transpose_mul(self, v: $vec) -> $vec {
                <$vec>::new(self.x_axis.dot(v), self.y_axis.dot(v), self.z_axis.dot(v))
            }
        }
    };
}

glam!(f32, glam::Vec3, glam::Mat3);
glam!(f64, glam::DVec3, glam::DMat3);
