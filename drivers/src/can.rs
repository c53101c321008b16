//! Controllers on CAN: frames, their errors, and the joints of a bus.

pub(crate) mod frame;
pub(crate) mod joint;
pub(crate) mod joints;
pub mod mit;
pub mod moteus;
pub mod odrive;
mod silence;
mod turns;

pub use frame::{CanError, CanFrame, ClassicFrame, Component, FdFrame, fd_length};
pub use silence::{Silence, Silent};
