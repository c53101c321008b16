//! Robots as constants: kinematics, inertias and limits, each with its source and licence.
//!
//! - [`Ur5e`]: Universal Robots UR5e, 6 revolute joints, every placement in quarter turns.
//! - [`Panda`]: Franka Emika Panda without its hand, 7 revolute joints, dense inertias.
//! - [`Iiwa14`]: KUKA LBR iiwa 14 R820, 7 revolute joints, diagonal inertias.
//! - [`A1`]: Unitree A1 with its trunk held, a tree of four legs, 12 revolute joints and 4 fixed feet.
//!
//! All are in SI units with the joint frames of the URDF they come from, so that poses, torques and
//! signs compare directly with other libraries. The numbers are facts of published descriptions; no
//! file of those is part of this crate.

mod a1;
mod iiwa14;
mod panda;
mod ur5e;

pub use a1::A1;
pub use iiwa14::Iiwa14;
pub use panda::Panda;
pub use ur5e::Ur5e;
