//! Machines that no maker publishes: the numbers are ours, of the size of real ones.

pub mod gimbal;
pub mod ship;
pub mod space_arm;

pub use gimbal::Gimbal;
pub use ship::{Ship, Watch};
pub use space_arm::SpaceArm;
