//! The cost of a rigid body's own terms, and of effects on bodies, in the engine's inverse dynamics
//! of the Panda.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::effects::bodies::<robots::Panda, 7, 6>());
