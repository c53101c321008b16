//! Encoders of a joint on a bus of its own.

pub mod as5047p;
pub mod as5600;
#[cfg(feature = "async")]
mod asynch;
pub mod incremental;
pub(crate) mod multi_turn;
