//! The cost of effects at joints in the engine's inverse dynamics of the UR5e.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::effects::joints::<robots::Ur5e, 6>());
