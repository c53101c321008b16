//! Machines that no maker publishes, as constants: numbers of our own, of the size of real ones.

mod direct_drive;
mod leg;
mod scara;

pub use direct_drive::DirectDrive;
pub use leg::Leg;
pub use scara::Scara;
