//! Franka Emika Panda.

// Formatted as users' files are.

#[rustfmt::skip]
#[path = "imported/panda.rs"]
mod imported;

/// Franka Emika Panda without its hand: 7 revolute joints, every inertia dense.
///
/// The parameters were identified from motion (Gaz, Cognetti, Oliva, Robuffo Giordano, De Luca,
/// "Dynamic Identification of the Franka Emika Panda Robot With Retrieval of Feasible Parameters
/// Using Penalty-Based Optimization", IEEE Robotics and Automation Letters 4(4), 2019). Such a fit
/// fixes only the combinations that the torques depend on, so a single link's numbers need not look
/// like that link: 0.70 kg m² for link 1 is not its real inertia. Link 2 satisfies the triangle
/// inequality of its principal moments by 1.7e-6 kg m², which is 5.5e-5 of the largest of them.
///
/// # Source
///
/// - Inertias: frankaemika/franka_ros at commit b2a62ff6,
///   `franka_description/robots/common/inertial.yaml`; kinematics:
///   `robots/common/franka_arm.xacro`; limits: `robots/panda/joint_limits.yaml` of the same commit.
///   Licence: Apache-2.0.
/// - The same numbers stand in the PyPI package example-robot-data 6.0.0 and in mujoco_menagerie
///   (`franka_emika_panda/panda_nohand.xml`, commit 251ca9e8).
///
/// # Changed
///
/// Written by `robot-import` without the hand and its fingers, since the flange is where a user
/// mounts a tool. Rotations are exact quarter turns. Link 0 is omitted since it does not move, link
/// 8 since it has no mass.
#[doc(inline)]
pub use imported::Panda;
