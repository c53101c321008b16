//! The data sheets of the scenes: robot, effects, trajectory and controller of each. The bin of the
//! same name runs it, and tests run it on devices that can be bent.

pub mod delta_pick;
pub mod direct_drive;
pub mod flexible_joint;
pub mod flexible_link;
pub mod gimbal_ship;
pub mod jog;
pub mod leg_hop;
pub mod openarm_free_drive;
pub mod panda_payload;
pub mod parallel_ankle;
pub mod scara_table;
pub mod so101_teach;
pub mod space_arm;
pub mod ur5e;
pub mod wheel_leg_balance;
