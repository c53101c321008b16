//! Intervals of real numbers in f64, rounded outward.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All real numbers from one to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Interval {
    /// The least number of the interval.
    pub low: f64,
    /// The greatest number of the interval.
    pub high: f64,
}

/// At least the next number: one unit in the last place is at most |x| 2⁻⁵², and the result of an
/// operation is half of one off.
#[inline]
fn up(x: f64) -> f64 {
    x + (x.abs() * f64::EPSILON + f64::MIN_POSITIVE)
}

/// At most the number before.
#[inline]
fn down(x: f64) -> f64 {
    -up(-x)
}

impl Interval {
    /// From one number to another.
    #[inline]
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// The interval of a single number.
    #[inline]
    pub const fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// The greatest absolute value in it.
    #[inline]
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The width of the interval.
    #[inline]
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// It, and this far beyond both ends.
    #[inline]
    pub fn widened(self, by: f64) -> Self {
        Self::new(down(self.low - by), up(self.high + by))
    }

    /// Whether it is zero alone: sums and products with it are exact.
    #[inline]
    pub fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    /// Whether another one lies in it.
    #[inline]
    pub fn contains(self, other: Self) -> bool {
        self.low <= other.low && other.high <= self.high
    }

    /// The intersection of two intervals; both hold the number in question, so that they meet.
    #[inline]
    pub fn and(self, other: Self) -> Self {
        Self::new(self.low.max(other.low), self.high.min(other.high))
    }

    /// The product of the interval and a number.
    #[inline]
    pub fn times(self, factor: f64) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        Self::new(down(a.min(b)), up(a.max(b)))
    }

    /// The range of x².
    #[inline]
    pub fn square(self) -> Self {
        if self.is_zero() {
            return self;
        }
        let (a, b) = (self.low * self.low, self.high * self.high);
        let low = if self.low <= 0.0 && self.high >= 0.0 { 0.0 } else { down(a.min(b)).max(0.0) };
        Self::new(low, up(a.max(b)))
    }

    /// √x of the numbers that have one.
    #[inline]
    pub fn root(self) -> Self {
        Self::new(down(self.low.max(0.0).sqrt()).max(0.0), up(self.high.max(0.0).sqrt()))
    }
}

impl Div for Interval {
    type Output = Self;
    /// All numbers if the divisor may be zero.
    #[inline]
    fn div(self, b: Self) -> Self {
        if !(b.low > 0.0 || b.high < 0.0) {
            return Self::new(f64::NEG_INFINITY, f64::INFINITY);
        }
        self * Self::new(down(1.0 / b.high), up(1.0 / b.low))
    }
}

impl Add for Interval {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        if self.is_zero() || b.is_zero() {
            return if b.is_zero() { self } else { b };
        }
        Self::new(down(self.low + b.low), up(self.high + b.high))
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        if b.is_zero() {
            return self;
        }
        Self::new(down(self.low - b.high), up(self.high - b.low))
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.high, -self.low)
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        if self.is_zero() || b.is_zero() {
            return Self::default();
        }
        let [p, q, r, s] =
            [self.low * b.low, self.low * b.high, self.high * b.low, self.high * b.high];
        Self::new(down(p.min(q).min(r.min(s))), up(p.max(q).max(r.max(s))))
    }
}

/// Half a unit in the last place of f32 at a magnitude: the most that rounding to nearest changes a
/// number of it.
#[inline]
pub fn half_ulp(magnitude: f64) -> f64 {
    const SMALLEST: f64 = f32::MIN_POSITIVE as f64;
    // The power of two at or below it.
    let power = f64::from_bits(magnitude.max(SMALLEST).to_bits() & 0x7ff0_0000_0000_0000);
    power * (0.5 * f32::EPSILON as f64)
}
