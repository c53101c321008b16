//! Unitree Z1.

// Formatted as users' files are.

#[rustfmt::skip]
#[path = "imported/z1.rs"]
mod imported;

/// Unitree Z1 with its gripper: 6 revolute joints of the arm and the gripper's jaw, about x, y and
/// z; 4.7 kg of moving mass.
///
/// # Source
///
/// - The PyPI package example-robot-data 6.0.0, `robots/z1_description/urdf/z1.urdf`, which states
///   as its origin unitreerobotics/unitree_ros (`robots/z1_description`) and MPL-2.0 as the
///   licence.
///
/// # Changed
///
/// Written by `robot-import`. The gripper's fixed half is part of link 6, the base link omitted
/// since it does not move.
#[doc(inline)]
pub use imported::Z1;
