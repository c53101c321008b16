//! The cost of M, forward dynamics and Jacobians on the UR5e.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::forward::both::<robots::Ur5e, 6, 6, 5>());
