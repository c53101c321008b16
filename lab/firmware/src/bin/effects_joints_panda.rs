//! The cost of effects at joints in the engine's inverse dynamics of the Panda.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::effects::joints::<robots::Panda, 7>());
