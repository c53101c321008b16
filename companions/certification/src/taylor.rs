//! Numbers as functions of where in a part of the box the joints are: a centre, a slope for each
//! coordinate, and a remainder.
//!
//! With each coordinate of the part as d ∈ [−1, 1], a number is c + Σ g_k d_k + e with |e| ≤ r: a
//! Taylor model of first order (Makino & Berz, International Journal of Pure and Applied
//! Mathematics 4, 2003). Slopes keep what intervals forget, that two numbers grow together; the
//! remainder falls with the square of the part's width. Roundings of f64 are in the remainder.

use std::ops::{Add, Mul, Neg, Sub};

use crate::interval::Interval;

/// Coordinates with a slope; of further ones only the remainder knows.
pub const SLOPES: usize = 8;

/// A number over a part of the box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Taylor {
    /// Its value in the middle, up to the remainder.
    pub centre: f64,
    /// The change from the middle to the end of each coordinate.
    pub slopes: [f64; SLOPES],
    /// The most by which it differs from that.
    pub rest: f64,
}

/// A scalar of kinematics: a number, or a [`Taylor`] model of one.
pub trait Scalar:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The constant `x` as such a scalar.
    fn of(x: f64) -> Self;
    /// This number times a constant.
    fn times(self, factor: f64) -> Self;
}

impl Scalar for f64 {
    fn of(x: f64) -> Self {
        x
    }
    fn times(self, factor: f64) -> Self {
        self * factor
    }
}

/// More than the relative error of the few operations by which a sum of magnitudes is computed.
const UP: f64 = 1.0 + 1e-13;

impl Taylor {
    /// A coordinate of the part itself.
    pub fn coordinate(range: Interval, slope: Option<usize>) -> Self {
        let (middle, half) = halves(range);
        Self::linear(middle, half, slope, 0.0)
    }

    /// The cosine and the sine of a coordinate times a whole number.
    pub fn cosine_and_sine(angles: Interval, times: f64, slope: Option<usize>) -> [Self; 2] {
        let (middle, half) = halves(angles);
        let (middle, half) = (middle * times, half * times);
        if half > 3.1 {
            let any = Self { rest: 1.0, ..Self::default() };
            return [any, any];
        }
        let (s, c) = middle.sin_cos();
        // cos δ is between cos h and 1; sin δ is δ − δ³/6 with at most δ⁵/120 more, of which a line
        // leaves h³/24.
        let (level, spread) = (0.5 * (1.0 + half.cos()), 0.5 * (1.0 - half.cos()));
        let (cube, fifth) = (half.powi(3), half.powi(5));
        let (slant, bend) = match cube / 24.0 + fifth / 120.0 {
            bend if bend < 1.0 => (half - cube / 8.0, bend),
            _ => (0.0, 1.0),
        };
        // The host's sines, and the middle times a whole number.
        let slack = 1e-15 * (2.0 + middle.abs());
        [
            Self::linear(c * level, -s * slant, slope, c.abs() * spread + s.abs() * bend + slack),
            Self::linear(s * level, c * slant, slope, s.abs() * spread + c.abs() * bend + slack),
        ]
    }

    fn linear(centre: f64, gain: f64, slope: Option<usize>, rest: f64) -> Self {
        let mut number = Self { centre, rest: rest * UP, ..Self::default() };
        match slope.and_then(|slope| number.slopes.get_mut(slope)) {
            Some(slope) => *slope = gain,
            None => number.rest = (rest + gain.abs()) * UP,
        }
        number
    }

    /// The most by which it differs from the centre by its slopes.
    #[inline]
    fn reach(&self) -> f64 {
        self.slopes.iter().map(|slope| slope.abs()).sum()
    }

    /// The interval that encloses its values.
    pub fn range(&self) -> Interval {
        Interval::point(self.centre).widened((self.reach() + self.rest) * UP)
    }

    /// The greatest absolute value over the part.
    #[inline]
    pub fn magnitude(&self) -> f64 {
        (self.centre.abs() + self.reach() + self.rest) * UP
    }

    /// The model of x².
    pub fn square(self) -> Self {
        self * self
    }

    /// With the roundings of a few operations on numbers of a size.
    #[inline]
    fn rounded(mut self, size: f64) -> Self {
        self.rest = (self.rest + 4.0 * f64::EPSILON * size) * UP;
        self
    }
}

/// The middle of a range, and at least the half of its width.
fn halves(range: Interval) -> (f64, f64) {
    let middle = 0.5 * (range.low + range.high);
    let half = (range.high - middle).max(middle - range.low);
    (middle, half + 1e-15 * (half + middle.abs()))
}

impl Add for Taylor {
    type Output = Self;
    #[inline]
    fn add(mut self, b: Self) -> Self {
        self.centre += b.centre;
        let mut size = self.centre.abs();
        for (a, b) in self.slopes.iter_mut().zip(b.slopes) {
            *a += b;
            size += a.abs();
        }
        self.rest += b.rest;
        self.rounded(size)
    }
}

impl Neg for Taylor {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { centre: -self.centre, slopes: self.slopes.map(|slope| -slope), rest: self.rest }
    }
}

impl Sub for Taylor {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Taylor {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        let mut slopes = [0.0; SLOPES];
        let (mut squares, mut sizes) = (0.0, 0.0);
        for (to, (x, y)) in slopes.iter_mut().zip(self.slopes.iter().zip(&b.slopes)) {
            *to = self.centre * y + b.centre * x;
            squares += x * y;
            sizes += (x * y).abs();
        }
        // Σ g_k g'_l d_k d_l, of which each d_k² is ½ ± ½.
        let (mine, theirs) = (self.reach(), b.reach());
        let products = mine * theirs - 0.5 * sizes;
        let (m, n) = (self.centre.abs() + mine, b.centre.abs() + theirs);
        let product = Self {
            centre: self.centre * b.centre + 0.5 * squares,
            slopes,
            rest: products.max(0.0) + m * b.rest + n * self.rest + self.rest * b.rest,
        };
        product.rounded((m + self.rest) * (n + b.rest))
    }
}

impl Scalar for Taylor {
    fn of(x: f64) -> Self {
        Self { centre: x, ..Self::default() }
    }
    #[inline]
    fn times(mut self, factor: f64) -> Self {
        self.centre *= factor;
        self.slopes = self.slopes.map(|slope| slope * factor);
        self.rest *= factor.abs();
        let size = self.centre.abs() + self.reach();
        self.rounded(size)
    }
}
