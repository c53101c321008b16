//! The cost of M, forward dynamics and Jacobians on the Panda.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::forward::both::<robots::Panda, 7, 7, 6>());
