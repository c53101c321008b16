//! Machines that no maker publishes, as constants: numbers of our own, of the size of real ones.

mod ankle_leg;
mod delta;
mod direct_drive;
pub mod four_bar_leg;
mod g1_ankle;
mod gimbal;
mod leg;
pub mod pick_delta;
pub mod planar_loops;
mod scara;
pub mod ship;
mod space_arm;
mod stewart;
pub mod two_link;
mod wheel_leg;

pub use ankle_leg::{AnkleLeg, RODS};
pub use delta::{Delta, FlatDelta};
pub use direct_drive::DirectDrive;
pub use four_bar_leg::FourBarLeg;
pub use g1_ankle::{G1Ankle, SerialAnkle};
pub use gimbal::Gimbal;
pub use leg::Leg;
pub use pick_delta::PickDelta;
pub use scara::Scara;
pub use ship::Ship;
pub use space_arm::SpaceArm;
pub use stewart::{ABOVE, BELOW, LEGS, StewartPlatform};
pub use two_link::TwoLink;
pub use wheel_leg::{COORDINATES, Straight, WheelLeg};
