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
pub(crate) struct Series<T>(pub(crate) [T; 3]);

impl<T: Add<Output = T>> Add for Series<T> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, o.0);
        Self([a + d, b + e, c + f])
    }
}

impl<R: Real> Series<Folded<R>> {
    /// A polynomial of run-time numbers.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn runtime([a, b, c]: [R; 3]) -> Self {
        Self([Folded::runtime(a), Folded::runtime(b), Folded::runtime(c)])
    }

    /// The same by a number that does not change.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn times(self, s: Folded<R>) -> Self {
        let [a, b, c] = self.0;
        Self([a * s, b * s, c * s])
    }
}

impl<R: Real> Series<Vec3<R>> {
    /// A vector that does not change.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn constant(v: Vec3<R>) -> Self {
        Self([v, Vec3::ZERO, Vec3::ZERO])
    }

    /// The polynomials of the components along z.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn z(&self) -> Series<Folded<R>> {
        let [a, b, c] = self.0;
        Series([a.0[2], b.0[2], c.0[2]])
    }

    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn scale(self, o: Series<Folded<R>>) -> Self {
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
    pub(crate) fn times_transposed(self, m: &Mat3<R>) -> Self {
        let [a, b, c] = self.0;
        Self([m.transpose_mul(a), m.transpose_mul(b), m.transpose_mul(c)])
    }
}

impl<R: Real> Series<Mat3<R>> {
    /// M v.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn mul(&self, v: Series<Vec3<R>>) -> Series<Vec3<R>> {
        let ([a, b, c], [d, e, f]) = (&self.0, v.0);
        Series([a.mul(d), a.mul(e) + b.mul(d), a.mul(f) + b.mul(e) + c.mul(d)])
    }
}

/// The rotation Rz(q(t)) of a revolute joint: the sine and the cosine at t = 0, and the rates.
#[derive(Clone, Copy)]
pub(crate) struct Turn<R> {
    sin: Folded<R>,
    cos: Folded<R>,
    rate: Folded<R>,
    half_rate: Folded<R>,
    half_accel: Folded<R>,
}

impl<R: Real> Turn<R> {
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(turn: JointCoordinate<R>, rate: R, accel: R) -> Self {
        let half = R::from_f64(0.5);
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
    pub(crate) fn enter_now(&self, v: Vec3<R>) -> Vec3<R> {
        v.turn_back(self.sin, self.cos)
    }

    /// Rzᵀ v: into the body's frame. The derivative of y = Rzᵀ x is Rzᵀ ẋ − q̇ z × y.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn enter(&self, v: Series<Vec3<R>>) -> Series<Vec3<R>> {
        let [a, b, c] = v.0;
        let (a, b, c) = (self.enter_now(a), self.enter_now(b), self.enter_now(c));
        let once = b - about_z(self.rate, a);
        let twice = c - about_z(self.half_rate, b + once) - about_z(self.half_accel, a);
        Series([a, once, twice])
    }

    /// Rz v: out of the body's frame.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn leave(&self, v: Series<Vec3<R>>) -> Series<Vec3<R>> {
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
fn about_z<R: Real>(w: Folded<R>, Vec3([x, y, _]): Vec3<R>) -> Vec3<R> {
    Vec3([-(w * y), w * x, Folded::ZERO])
}
