//! Scalars: the arithmetic that the algorithms need, and no more.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A scalar: f32, f64, or one that counts its operations.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The zero of an array that is filled later, and of a sum that has not begun; it counts as
    /// nothing.
    const ZERO: Self;

    /// A constant of the robot, rounded.
    fn of(value: f64) -> Self;

    /// The value in f64.
    fn value(self) -> f64;
}

macro_rules! float {
    ($($float:ty)+) => {$(
        impl Number for $float {
            const ZERO: Self = 0.0;

            fn of(value: f64) -> Self {
                value as Self
            }

            fn value(self) -> f64 {
                self.into()
            }
        }
    )+};
}

float!(f32 f64);
