//! The cost of a rigid body's own terms, and of effects on bodies, in the engine's inverse dynamics
//! of the UR5e.
#![no_std]
#![no_main]

mod costs;

costs::main!(costs::effects::bodies::<robots::Ur5e, 6, 5>());
