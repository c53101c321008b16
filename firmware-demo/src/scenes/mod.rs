//! The data sheets of the scenes: robot, effects, trajectory and controller of each. The bin of the
//! same name runs it, and tests run it on devices that can be bent. Scenes that run on the
//! emulated board alone need its feature.

#[cfg(feature = "netduinoplus2")]
pub mod delta_pick;
#[cfg(feature = "netduinoplus2")]
pub mod direct_drive;
#[cfg(feature = "netduinoplus2")]
pub mod flexible_joint;
#[cfg(feature = "netduinoplus2")]
pub mod flexible_link;
#[cfg(feature = "netduinoplus2")]
pub mod gimbal_ship;
#[cfg(feature = "netduinoplus2")]
pub mod jog;
#[cfg(feature = "netduinoplus2")]
pub mod leg_hop;
pub mod openarm_free_drive;
pub mod panda_payload;
#[cfg(feature = "netduinoplus2")]
pub mod parallel_ankle;
pub mod scara_table;
pub mod so101_teach;
#[cfg(feature = "netduinoplus2")]
pub mod space_arm;
pub mod ur5e;
#[cfg(feature = "netduinoplus2")]
pub mod wheel_leg_balance;
