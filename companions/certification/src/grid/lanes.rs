//! The numbers with which a program is evaluated: f64, or intervals as midpoint and radius.

use super::{Kind, Step};
use crate::interval::Interval;

/// Points that are evaluated at once.
pub(super) const LANES: usize = 8;

/// A coefficient at some points.
pub(super) trait Lanes: Copy + Default {
    /// A number of which an interval is known.
    fn within(range: Interval) -> Self;
    /// Sets one of them to the sine or cosine that the host computes.
    fn set(&mut self, lane: usize, value: f64);
    /// Adds a product, or its opposite.
    fn add_product(&mut self, a: &Self, b: &Self, is_minus: bool);
    /// The reciprocal 1/x.
    fn reciprocal(&self) -> Self;
    /// The square root √x.
    fn root(&self) -> Self;
    /// The greatest absolute value in each lane.
    fn magnitudes(&self) -> [f64; LANES];
}

/// Numbers, whose roundings the proof adds.
pub(super) type Plain = [f64; LANES];

impl Lanes for Plain {
    fn within(range: Interval) -> Self {
        [0.5 * (range.low + range.high); LANES]
    }
    fn set(&mut self, lane: usize, value: f64) {
        self[lane] = value;
    }
    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self, is_minus: bool) {
        if is_minus {
            (0..LANES).for_each(|i| self[i] -= a[i] * b[i]);
        } else {
            (0..LANES).for_each(|i| self[i] += a[i] * b[i]);
        }
    }
    fn reciprocal(&self) -> Self {
        self.map(|x| 1.0 / x)
    }
    fn root(&self) -> Self {
        self.map(f64::sqrt)
    }
    #[inline(always)]
    fn magnitudes(&self) -> [f64; LANES] {
        self.map(f64::abs)
    }
}

/// Numbers within a radius of others, roundings included.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ball {
    centre: [f64; LANES],
    radius: [f64; LANES],
}

/// More than the roundings of a few operations, relative to their results.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

impl Ball {
    fn each(&self, of: impl Fn(Interval) -> Interval) -> Self {
        let mut ball = Self::default();
        for i in 0..LANES {
            let one = Interval::point(self.centre[i]).widened(self.radius[i]);
            let Interval { low, high } = of(one);
            ball.centre[i] = 0.5 * (low + high);
            // A result that is not a number becomes a range without bounds.
            let radius = 0.5 * (high - low) + ROUNDED * (low.abs() + high.abs());
            (ball.centre[i], ball.radius[i]) = match radius.is_finite() {
                true => (ball.centre[i], radius),
                false => (0.0, f64::INFINITY),
            };
        }
        ball
    }
}

impl Lanes for Ball {
    fn within(range: Interval) -> Self {
        Self::default().each(|_| range)
    }
    fn set(&mut self, lane: usize, value: f64) {
        (self.centre[lane], self.radius[lane]) = (value, 4e-15);
    }
    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self, is_minus: bool) {
        let sign = if is_minus { -1.0 } else { 1.0 };
        for i in 0..LANES {
            let product = a.centre[i] * b.centre[i];
            let sum = self.centre[i] + sign * product;
            let spread =
                a.centre[i].abs() * b.radius[i] + a.radius[i] * (b.centre[i].abs() + b.radius[i]);
            let rounded = ROUNDED * (product.abs() + sum.abs());
            self.centre[i] = sum;
            self.radius[i] = (self.radius[i] + spread + rounded) * (1.0 + ROUNDED);
        }
    }
    fn reciprocal(&self) -> Self {
        self.each(|x| Interval::point(1.0) / x)
    }
    fn root(&self) -> Self {
        // The root of a number that may be negative becomes a range without bounds.
        self.each(|x| match x.low >= 0.0 {
            true => x.root(),
            false => Interval::new(f64::NEG_INFINITY, f64::INFINITY),
        })
    }
    #[inline(always)]
    fn magnitudes(&self) -> [f64; LANES] {
        std::array::from_fn(|i| {
            let most = self.centre[i].abs() + self.radius[i];
            if most.is_nan() { f64::INFINITY } else { most }
        })
    }
}

/// Carries out the steps of a program.
pub(super) fn evaluate<L: Lanes>(steps: &[Step], x: &mut [L]) {
    for step in steps {
        let (a, b) = (x[step.a as usize], x[step.b as usize]);
        let to = &mut x[step.to as usize];
        match step.kind {
            Kind::Product { is_first, is_minus } => {
                if is_first {
                    *to = L::default();
                }
                to.add_product(&a, &b, is_minus);
            }
            Kind::Reciprocal => *to = a.reciprocal(),
            Kind::Root => *to = a.root(),
        }
    }
}

/// A sum of absolute values with factors.
pub(super) fn absolute<L: Lanes>(sum: &[(u32, f64)], x: &[L]) -> [f64; LANES] {
    let mut result = [0.0; LANES];
    for (place, most) in sum {
        let x = x[*place as usize].magnitudes();
        (0..LANES).for_each(|i| result[i] += x[i] * most);
    }
    result
}
