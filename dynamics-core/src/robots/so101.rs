//! The Robot Studio's SO-101.

// Formatted as users' files are.

#[rustfmt::skip]
#[path = "imported/so101.rs"]
mod imported;

/// SO-101 follower arm with its gripper's jaw: 6 revolute joints, 0.49 kg of moving mass, 0.4 m
/// reach.
///
/// The joints are shoulder pan, shoulder lift, elbow flex, wrist flex, wrist roll and the jaw, each
/// moved by a servo of the type STS3215 that stands on the joint's parent link.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/so_arm_description/urdf/so101.urdf` ("new
///   calibration"), whose README states as its origin github.com/TheRobotStudio/SO-ARM100 and
///   Apache-2.0 as the licence.
///
/// # Changed
///
/// - Written by `robot-import`. Rotations are exact quarter turns where the source rounds (1.5708,
///   3.14159, or a remainder below 1e-7 rad), and offsets below 1e-8 m are zero. Left as they are,
///   they make no entry of a rotation zero. The 0.0486795 rad of the wrist's roll are no rounding
///   and are kept.
/// - The base link is omitted, since it does not move, and so is the gripper's tool frame with its
///   placeholder of 1e-9 kg.
/// - The limits of 10 N·m and 10 rad/s are the source's placeholders: at 7.4 V the servo reaches
///   3.4 N·m and 6.1 rad/s.
#[doc(inline)]
pub use imported::So101;
