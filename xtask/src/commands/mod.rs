//! The commands of a user, and the tests.

pub mod demo;
pub mod identify;
pub mod import;
pub mod meter;
pub mod test;
pub mod watch;
