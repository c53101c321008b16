//! The cost of inverse dynamics on the iiwa 14.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::inverse::run::<robots::Iiwa14, 7, 7>());
