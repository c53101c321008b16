//! Machines that no maker publishes, as constants: numbers of our own, of the size of real ones.

mod direct_drive;

pub use direct_drive::DirectDrive;
