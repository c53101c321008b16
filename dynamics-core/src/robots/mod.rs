//! Robots as constants: kinematics, inertias and limits, each with its source and licence.
//!
//! - [`Ur5e`]: Universal Robots UR5e, 6 revolute joints, every placement in quarter turns.
//! - [`Panda`]: Franka Emika Panda without its hand, 7 revolute joints, dense inertias.
//! - [`Iiwa14`]: KUKA LBR iiwa 14 R820, 7 revolute joints, diagonal inertias.
//! - [`A1`]: Unitree A1 with its trunk held, a tree of four legs, 12 revolute joints and 4 fixed
//!   feet.
//! - [`A1Leg`]: one leg of it, 3 revolute joints and a fixed foot.
//! - [`A1Free`]: the same with its trunk free, 18 degrees of freedom.
//! - [`OpenArm`]: Enactic OpenArm 2.0 with its gripper held, 7 revolute joints moved by
//!   quasi-direct drives.
//! - [`Yam`]: I2RT YAM with its gripper held, 6 revolute joints moved by quasi-direct drives.
//! - [`Gen3`]: Kinova Gen3 with vision module, 7 joints, four of which are continuous.
//! - [`So101`]: The Robot Studio's SO-101 with its gripper's jaw, 6 revolute joints moved by hobby
//!   servos.
//! - [`Puma560`]: Unimation PUMA 560 with the inertias of 1986, 6 revolute joints.
//! - [`XArm7`]: UFACTORY xArm7, 7 revolute joints, dense inertias.
//! - [`Z1`]: Unitree Z1 with its gripper, 7 revolute joints about x, y and z.
//! - [`G1`]: Unitree G1 with its pelvis held, a humanoid of 29 revolute joints.
//! - [`G1Free`]: the same with its pelvis free, 35 degrees of freedom.
//!
//! All are in SI units with the joint frames of the URDF they come from, or of the paper, so that
//! poses, torques and signs compare directly with other libraries. The numbers are facts of
//! published descriptions; no file of those is part of this crate.

mod a1;
mod g1;
mod gen3;
mod iiwa14;
mod openarm;
mod panda;
mod puma560;
mod so101;
mod ur5e;
mod welded_part;
mod xarm7;
mod yam;
mod z1;

pub use a1::{A1, A1Free, A1Leg};
pub use g1::{G1, G1Free};
pub use gen3::Gen3;
pub use iiwa14::Iiwa14;
pub use openarm::OpenArm;
pub use panda::Panda;
pub use puma560::Puma560;
pub use so101::So101;
pub use ur5e::Ur5e;
pub use xarm7::XArm7;
pub use yam::Yam;
pub use z1::Z1;
