//! A scalar that counts: products, sums (differences are sums) and quotients, for each thread its
//! own count.

extern crate std;

use core::cell::Cell;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    pub products: i64,
    /// Sums and differences; a change of sign is neither.
    pub sums: i64,
    pub quotients: i64,
}

std::thread_local! {
    static COUNT: Cell<Operations> = const { Cell::new(Operations { products: 0, sums: 0, quotients: 0 }) };
}

/// An f64 whose operations are counted.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Counted(f64);

impl From<f64> for Counted {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

pub fn count<T>(compute: impl FnOnce() -> T) -> Operations {
    COUNT.set(Operations::default());
    core::hint::black_box(compute());
    COUNT.get()
}

fn step(change: impl FnOnce(&mut Operations)) {
    let mut operations = COUNT.get();
    change(&mut operations);
    COUNT.set(operations);
}

fn one_more(count: &mut i64) {
    *count += 1;
}

impl Number for Counted {
    const ZERO: Self = Self(0.0);

    fn of(value: f64) -> Self {
        Self(value)
    }

    fn value(self) -> f64 {
        self.0
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $field:ident;)+) => {$(
        impl $operator for Counted {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                step(|count| one_more(&mut count.$field));
                Self(self.0.$method(other.0))
            }
        }
    )+};
}

operators! {
    Add add sums;
    Sub sub sums;
    Mul mul products;
    Div div quotients;
}

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}
