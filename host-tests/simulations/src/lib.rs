//! The UR5e that tests in `tests/` simulate, and hard cases that compute for minutes.

pub mod long;
pub mod plant;
