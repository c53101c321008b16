//! Scalars that may be known at compile time.
//!
//! LLVM may not fold 0·x or 0 + x for floats (IEEE's −0, NaN and infinities forbid it); here the
//! operators fold them by a tag. Tags come from constants and every operator is inlined, so that
//! none of them is left in the machine code: placements of real arms are mostly zeros and ones, and
//! most products vanish. Signs are carried beside the number and spent in the next addition, so
//! that no negation and no second constant −c is left either. Tags live between load and store;
//! memory holds plain numbers.

use core::ops::{Add, Mul, Neg, Sub};

use crate::scalar::Real;

/// The tag of zero, of one, and the sign, in the bits of [`Folded::tags`].
const ZERO: u8 = 1;
const ONE: u8 = 2;
const MINUS: u8 = 4;

/// A number with a tag for its compile-time value: any, 0 or 1, and a sign. Two scalars, which
/// rustc keeps out of memory.
#[derive(Clone, Copy)]
pub(crate) struct Folded<R> {
    magnitude: R,
    tags: u8,
}

// No branches: those of thousands of operators, all in one function until LLVM has seen their tags,
// took up to nine tenths of the time of a build.

/// `yes` if `condition`, else `no`.
#[cfg_attr(optimised, inline(always))]
fn either(condition: bool, yes: u8, no: u8) -> u8 {
    let mask = u8::from(condition).wrapping_neg();
    (yes & mask) | (no & !mask)
}

impl<R: Real> Folded<R> {
    pub(crate) const ZERO: Self = Self { magnitude: R::ZERO, tags: ZERO };

    pub(crate) const ONE: Self = Self { magnitude: R::ONE, tags: ONE };

    /// A number known only at run time.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn runtime(value: R) -> Self {
        Self { magnitude: value, tags: 0 }
    }

    /// A number known at run time if `needed`, else zero.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn runtime_if(needed: bool, value: R) -> Self {
        Self { magnitude: R::either(needed, value, R::ZERO), tags: either(needed, 0, ZERO) }
    }

    /// A constant of the robot.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn constant(value: f64) -> Self {
        let minus = value < 0.0;
        let size = f64::either(minus, -value, value);
        let size_tag = either(size == 0.0, ZERO, either(size == 1.0, ONE, 0));
        Self { magnitude: R::from_f64(size), tags: size_tag | either(minus, MINUS, 0) }
    }

    /// The plain number.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn get(self) -> R {
        R::either(self.is(MINUS), -self.magnitude, self.magnitude)
    }

    #[cfg_attr(optimised, inline(always))]
    fn is(self, tag: u8) -> bool {
        self.tags & tag != 0
    }
}

impl<R: Real> Add for Folded<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        let (a, b) = (self.magnitude, o.magnitude);
        let opposite = (self.tags ^ o.tags) & MINUS != 0;
        let first = R::either(self.is(MINUS), b, a);
        let second = R::either(self.is(MINUS), a, b);
        let sum = R::either(opposite, first - second, a + b);
        let minus = self.tags & o.tags & MINUS;
        Self {
            magnitude: R::either(self.is(ZERO), b, R::either(o.is(ZERO), a, sum)),
            tags: either(self.is(ZERO), o.tags, either(o.is(ZERO), self.tags, minus)),
        }
    }
}

impl<R: Real> Sub for Folded<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl<R: Real> Mul for Folded<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, o: Self) -> Self {
        let (a, b) = (self.magnitude, o.magnitude);
        let zero = self.is(ZERO) | o.is(ZERO);
        let product = R::either(self.is(ONE), b, R::either(o.is(ONE), a, a * b));
        // The tags of the factor that is not one.
        let other = either(self.is(ONE), o.tags, either(o.is(ONE), self.tags, 0));
        let minus = (self.tags ^ o.tags) & MINUS;
        Self {
            magnitude: R::either(zero, R::ZERO, product),
            tags: either(zero, ZERO, (other & !MINUS) | minus),
        }
    }
}

impl<R: Real> Neg for Folded<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn neg(self) -> Self {
        Self { tags: self.tags ^ MINUS, ..self }
    }
}
