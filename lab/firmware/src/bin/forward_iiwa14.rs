//! The cost of M, forward dynamics and Jacobians on the iiwa 14.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::forward::both::<robots::Iiwa14, 7, 7, 6>());
