//! Drives that take a torque, and the spring and damper of those that have them.

pub mod h_bridge;
pub(crate) mod pd;
