//! Machines that no maker publishes, as constants: numbers of our own, of the size of real ones.

mod direct_drive;
mod gimbal;
mod leg;
mod scara;
pub mod ship;
mod space_arm;

pub use direct_drive::DirectDrive;
pub use gimbal::Gimbal;
pub use leg::Leg;
pub use scara::Scara;
pub use ship::Ship;
pub use space_arm::SpaceArm;
