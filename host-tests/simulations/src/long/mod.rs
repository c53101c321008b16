//! Computations of hard cases that take minutes: a full run of the tests optimises this package.

pub mod attitude;
pub mod day;
pub mod integrators;
pub mod pendulum;

/// The scalar's name.
pub fn name<R>() -> &'static str {
    std::any::type_name::<R>()
}
