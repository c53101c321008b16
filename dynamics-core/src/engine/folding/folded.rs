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

#[derive(Clone, Copy, PartialEq, Eq)]
enum Tag {
    Any,
    Zero,
    One,
}

/// A number with a tag for its compile-time value: any, 0 or 1, and a sign.
#[derive(Clone, Copy)]
pub(crate) struct Folded<R> {
    magnitude: R,
    tag: Tag,
    minus: bool,
}

impl<R: Real> Folded<R> {
    pub(crate) const ZERO: Self = Self {
        magnitude: R::ZERO,
        tag: Tag::Zero,
        minus: false,
    };

    pub(crate) const ONE: Self = Self {
        magnitude: R::ONE,
        tag: Tag::One,
        minus: false,
    };

    /// A number known only at run time.
    #[inline(always)]
    pub(crate) fn runtime(value: R) -> Self {
        Self {
            magnitude: value,
            tag: Tag::Any,
            minus: false,
        }
    }

    /// A number known at run time if `needed`, else zero.
    #[inline(always)]
    pub(crate) fn runtime_if(needed: bool, value: R) -> Self {
        if needed {
            Self::runtime(value)
        } else {
            Self::ZERO
        }
    }

    /// A constant of the robot.
    #[inline(always)]
    pub(crate) fn constant(value: f64) -> Self {
        let size = if value < 0.0 { -value } else { value };
        Self {
            magnitude: R::from_f64(size),
            tag: if size == 0.0 {
                Tag::Zero
            } else if size == 1.0 {
                Tag::One
            } else {
                Tag::Any
            },
            minus: value < 0.0,
        }
    }

    /// The plain number.
    #[inline(always)]
    pub(crate) fn get(self) -> R {
        if self.minus {
            -self.magnitude
        } else {
            self.magnitude
        }
    }
}

// Few and flat branches: what is not yet known when LLVM first sees it is paid for in build time.

impl<R: Real> Add for Folded<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        if self.tag == Tag::Zero {
            return o;
        }
        if o.tag == Tag::Zero {
            return self;
        }
        let same = self.minus == o.minus;
        let sum = self.magnitude + o.magnitude;
        let (first, second) = if self.minus { (o, self) } else { (self, o) };
        let difference = first.magnitude - second.magnitude;
        Self {
            magnitude: if same { sum } else { difference },
            tag: Tag::Any,
            minus: same & self.minus,
        }
    }
}

impl<R: Real> Sub for Folded<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl<R: Real> Mul for Folded<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        if self.tag == Tag::Zero || o.tag == Tag::Zero {
            return Self::ZERO;
        }
        let minus = self.minus != o.minus;
        if self.tag == Tag::One {
            return Self { minus, ..o };
        }
        if o.tag == Tag::One {
            return Self { minus, ..self };
        }
        Self {
            magnitude: self.magnitude * o.magnitude,
            tag: Tag::Any,
            minus,
        }
    }
}

impl<R: Real> Neg for Folded<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            minus: !self.minus,
            ..self
        }
    }
}
