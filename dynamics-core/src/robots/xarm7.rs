//! UFACTORY xArm7.

// Formatted as users' files are.

#[rustfmt::skip]
#[path = "imported/xarm7.rs"]
mod imported;

/// UFACTORY xArm7: 7 revolute joints, 10.4 kg of moving mass, every inertia dense but the last.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/xarm_description/urdf/xarm7.urdf`, which
///   states as its origin xArm-Developer/xarm_ros2 and BSD-3-Clause as the licence.
///
/// # Changed
///
/// Written by `robot-import`. Rotations are exact quarter turns where the source rounds (1.5708).
/// The base link is omitted since it does not move, the end effector's frame since it has no mass.
#[doc(inline)]
pub use imported::XArm7;
