//! Polynomials in time up to t²: of a quantity x the coefficients x, ẋ and ẍ/2.
//!
//! A sum or a product of polynomials has the first two derivatives of that of the quantities
//! (Griewank & Walther, *Evaluating Derivatives*, 2008, chapter 13). Each coefficient folds by
//! itself: what is constant has no others.

use core::ops::Add;

use super::{Folded, Mat3, Vec3};
use crate::model::JointCoordinate;
use crate::scalar::Real;

/// The coefficients of 1, t and t².
#[derive(Clone, Copy)]
pub(crate) struct Series<Arm>(pub(crate) [Arm; 3]);

impl<Arm: Add<Output = Arm>> Add for Series<Arm> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, o.0);
        Self([a + d, b + e, c + f])
    }
}

impl<Scalar: Real> Series<Folded<Scalar>> {
    /// A polynomial of run-time numbers.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn runtime([a, b, c]: [Scalar; 3]) -> Self {
        Self([Folded::runtime(a), Folded::runtime(b), Folded::runtime(c)])
    }

    /// The same by a number that does not change.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn times(self, s: Folded<Scalar>) -> Self {
        let [a, b, c] = self.0;
        Self([a * s, b * s, c * s])
    }
}

impl<Scalar: Real> Series<Vec3<Scalar>> {
    /// A vector that does not change.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn constant(v: Vec3<Scalar>) -> Self {
        Self([v, Vec3::ZERO, Vec3::ZERO])
    }

    /// The polynomials of the components along z.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn z(&self) -> Series<Folded<Scalar>> {
        let [a, b, c] = self.0;
        Series([a.0[2], b.0[2], c.0[2]])
    }

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn scale(self, o: Series<Folded<Scalar>>) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, o.0);
        Self([a.scale(d), a.scale(e) + b.scale(d), a.scale(f) + b.scale(e) + c.scale(d)])
    }

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn cross(self, o: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, o.0);
        Self([a.cross(d), a.cross(e) + b.cross(d), a.cross(f) + b.cross(e) + c.cross(d)])
    }

    /// Mᵀ v of a matrix that does not change.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn times_transposed(self, m: &Mat3<Scalar>) -> Self {
        let [a, b, c] = self.0;
        Self([m.transpose_mul(a), m.transpose_mul(b), m.transpose_mul(c)])
    }
}

impl<Scalar: Real> Series<Mat3<Scalar>> {
    /// M v.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn mul(&self, v: Series<Vec3<Scalar>>) -> Series<Vec3<Scalar>> {
        let ([a, b, c], [d, e, f]) = (&self.0, v.0);
        Series([a.mul(d), a.mul(e) + b.mul(d), a.mul(f) + b.mul(e) + c.mul(d)])
    }
}

/// The rotation Rz(q(t)) of a revolute joint: the sine and the cosine at t = 0, and the rates.
#[derive(Clone, Copy)]
pub(crate) struct Turn<Scalar> {
    sin: Folded<Scalar>,
    cos: Folded<Scalar>,
    rate: Folded<Scalar>,
    half_rate: Folded<Scalar>,
    half_accel: Folded<Scalar>,
}

impl<Scalar: Real> Turn<Scalar> {
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(turn: JointCoordinate<Scalar>, rate: Scalar, accel: Scalar) -> Self {
        let half = Scalar::from_f64(0.5);
        Self {
            sin: Folded::runtime(turn.sin),
            cos: Folded::runtime(turn.cos),
            rate: Folded::runtime(rate),
            half_rate: Folded::runtime(half * rate),
            half_accel: Folded::runtime(half * accel),
        }
    }

    /// Rzᵀ v at t = 0.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn enter_now(&self, v: Vec3<Scalar>) -> Vec3<Scalar> {
        v.turn_back(self.sin, self.cos)
    }

    /// Rzᵀ v: into the body's frame. The derivative of y = Rzᵀ x is Rzᵀ ẋ − q̇ z × y.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn enter(&self, v: Series<Vec3<Scalar>>) -> Series<Vec3<Scalar>> {
        let [a, b, c] = v.0;
        let (a, b, c) = (self.enter_now(a), self.enter_now(b), self.enter_now(c));
        let once = b - about_z(self.rate, a);
        let twice = c - about_z(self.half_rate, b + once) - about_z(self.half_accel, a);
        Series([a, once, twice])
    }

    /// Rz v: out of the body's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn leave(&self, v: Series<Vec3<Scalar>>) -> Series<Vec3<Scalar>> {
        let [a, b, c] = v.0;
        let once = b + about_z(self.rate, a);
        let twice = c + about_z(self.half_rate, b + once) + about_z(self.half_accel, a);
        Series([
            a.turn(self.sin, self.cos),
            once.turn(self.sin, self.cos),
            twice.turn(self.sin, self.cos),
        ])
    }
}

/// w z × v.
#[cfg_attr(optimised, inline(always))]
fn about_z<Scalar: Real>(w: Folded<Scalar>, Vec3([x, y, _]): Vec3<Scalar>) -> Vec3<Scalar> {
    Vec3([-(w * y), w * x, Folded::ZERO])
}
