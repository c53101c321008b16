//! Cartesian impedance control: the spring and the damping that an arm shows, its null space, and
//! singular postures.

mod attitude;
mod damping;
mod plant;
mod singular;
mod spring;
