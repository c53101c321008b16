//! Arms that tests in `tests/` simulate, and hard cases that compute for minutes.

pub mod contact;
pub mod learning;
pub mod long;
mod step;
