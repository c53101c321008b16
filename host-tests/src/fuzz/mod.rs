//! Targets that accept any bytes: they panic only to report a broken promise.
//!
//! `tests/fuzz.rs` runs each target on a fixed stream, `host-tests/fuzz` for as long as one likes.

mod bytes;
mod can;
mod controller;
mod description;
mod dynamics;
mod frames;

pub use can::{BYTES_PER_FRAME, can_frames};
pub use controller::controller;
pub use description::description;
pub use dynamics::dynamics;
pub use frames::frames;
