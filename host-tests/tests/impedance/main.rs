//! Cartesian impedance control: the spring and the damping that an arm shows, its null space, and singular postures.

#[path = "../common/mod.rs"]
mod common;

mod attitude;
mod damping;
mod plant;
mod singular;
mod spring;
