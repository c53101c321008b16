//! The cost of inverse dynamics on the Panda.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::inverse::run::<robots::Panda, 7, 7>());
