//! Arms that tests in `tests/` simulate.

pub mod contact;
pub mod learning;
mod step;
