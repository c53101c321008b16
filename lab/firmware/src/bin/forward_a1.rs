//! The cost of M, forward dynamics and Jacobians on the A1, by the core: the engine's build takes
//! too long for a test.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::forward::core::<robots::A1, 16, 12, 15>());
