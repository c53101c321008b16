//! The cost of inverse dynamics on the UR5e.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::inverse::run::<robots::Ur5e, 6, 6>());
