//! Scalars that may be known while compiling.
//!
//! LLVM may not fold 0·x, 0 + x or x − x for floats (IEEE's −0, NaN and infinities forbid it); here
//! the operators fold them by a tag. Tags come from constants and every operator is inlined, so
//! that none of them is left in the machine code: placements of real arms are mostly zeros and
//! ones, and most products vanish. Tags live between load and store; memory holds plain numbers.

use core::ops::{Add, Mul, Neg, Sub};

use crate::scalar::Real;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Tag {
    Any,
    Zero,
    One,
    Minus,
}

/// A number with what the compiler knows of it: anything, 0, 1 or −1.
#[derive(Clone, Copy)]
pub(crate) struct Known<R> {
    value: R,
    tag: Tag,
}

impl<R: Real> Known<R> {
    pub(crate) const ZERO: Self = Self {
        value: R::ZERO,
        tag: Tag::Zero,
    };

    /// A number known only at run time.
    #[inline(always)]
    pub(crate) fn any(value: R) -> Self {
        Self {
            value,
            tag: Tag::Any,
        }
    }

    /// A number known at run time if `asked`, else zero.
    #[inline(always)]
    pub(crate) fn only_if(asked: bool, value: R) -> Self {
        if asked { Self::any(value) } else { Self::ZERO }
    }

    /// A constant of the robot.
    #[inline(always)]
    pub(crate) fn constant(value: f64) -> Self {
        let tag = if value == 0.0 {
            Tag::Zero
        } else if value == 1.0 {
            Tag::One
        } else if value == -1.0 {
            Tag::Minus
        } else {
            Tag::Any
        };
        Self {
            value: R::from_f64(value),
            tag,
        }
    }

    /// The plain number.
    #[inline(always)]
    pub(crate) fn get(self) -> R {
        match self.tag {
            Tag::Any => self.value,
            Tag::Zero => R::ZERO,
            Tag::One => R::ONE,
            Tag::Minus => -R::ONE,
        }
    }
}

impl<R: Real> Add for Known<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        match (self.tag, o.tag) {
            (Tag::Zero, _) => o,
            (_, Tag::Zero) => self,
            (Tag::One, Tag::Minus) | (Tag::Minus, Tag::One) => Self::ZERO,
            _ => Self::any(self.get() + o.get()),
        }
    }
}

impl<R: Real> Sub for Known<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        match (self.tag, o.tag) {
            (Tag::Zero, _) => -o,
            (_, Tag::Zero) => self,
            (Tag::One, Tag::One) | (Tag::Minus, Tag::Minus) => Self::ZERO,
            _ => Self::any(self.get() - o.get()),
        }
    }
}

impl<R: Real> Mul for Known<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        match (self.tag, o.tag) {
            (Tag::Zero, _) | (_, Tag::Zero) => Self::ZERO,
            (Tag::One, _) => o,
            (_, Tag::One) => self,
            (Tag::Minus, _) => -o,
            (_, Tag::Minus) => -self,
            _ => Self::any(self.value * o.value),
        }
    }
}

impl<R: Real> Neg for Known<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        match self.tag {
            Tag::Any => Self::any(-self.value),
            Tag::Zero => self,
            Tag::One => Self {
                value: -R::ONE,
                tag: Tag::Minus,
            },
            Tag::Minus => Self {
                value: R::ONE,
                tag: Tag::One,
            },
        }
    }
}
