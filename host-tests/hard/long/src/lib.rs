//! The parts of hard cases that compute for minutes: a package of its own, because a full run of
//! the tests optimises it.

pub mod attitude;
pub mod day;
pub mod integrators;
pub mod pendulum;

/// The scalar's name.
pub fn name<R>() -> &'static str {
    std::any::type_name::<R>()
}
