//! Dual numbers a + b ε, ε² = 0: a value and its derivative, of numbers that may be dual
//! themselves.

use std::ops::{Add, Mul, Neg, Sub};

/// A number that can be differentiated.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Makes a constant, whose derivative is zero.
    fn constant(x: f64) -> Self;
    /// The product with a constant: half the work of that with a number whose derivatives are zero,
    /// and the same bits.
    fn scaled(self, by: f64) -> Self;
    /// The sine and the cosine of the number.
    fn sin_cos(self) -> (Self, Self);
}

impl Number for f64 {
    fn constant(x: f64) -> Self {
        x
    }

    fn scaled(self, by: f64) -> Self {
        self * by
    }

    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
}

/// A value and its derivative.
#[derive(Clone, Copy, Debug)]
pub struct Dual<T> {
    /// The value.
    pub value: T,
    /// The derivative of the value.
    pub rate: T,
}

impl<T: Number> Dual<T> {
    /// A value and its derivative.
    pub fn new(value: T, rate: T) -> Self {
        Self { value, rate }
    }
}

impl<T: Number> Number for Dual<T> {
    fn constant(x: f64) -> Self {
        Self::new(T::constant(x), T::constant(0.0))
    }

    fn scaled(self, by: f64) -> Self {
        Self::new(self.value.scaled(by), self.rate.scaled(by))
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (
            Self::new(sin, cos * self.rate),
            Self::new(cos, -sin * self.rate),
        )
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.rate + other.rate)
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.rate - other.rate)
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let rate = self.value * other.rate + self.rate * other.value;
        Self::new(self.value * other.value, rate)
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivatives_of_sine_products_are_exact() {
        let x = Dual::new(Dual::new(0.7, 1.0), Dual::new(1.0, 0.0));
        let y = x * x * x.sin_cos().0;
        let (s, c) = 0.7_f64.sin_cos();
        assert!((y.rate.rate - (2.0 * s + 2.8 * c - 0.49 * s)).abs() < 1e-15);
    }
}
