//! The UR5e that tests in `tests/` simulate.

pub mod plant;
