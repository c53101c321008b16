//! Tests that simulate: optimised, and in one program.

mod arm;
#[path = "../../tests/common/mod.rs"]
mod common;

mod carried;
mod contact;
mod contact_reaction;
mod control_loop;
mod fault_injection;
mod free_drive;
#[path = "../../tests/fuzz.rs"]
mod fuzz;
mod hand_guiding;
mod hop;
mod impedance;
mod integrators;
mod jog;
mod momentum_observer;
#[path = "../../tests/moving_goal.rs"]
mod moving_goal;
mod panda_payload;
mod parameter_estimator;
mod payload_estimator;
mod pose_solver;
mod replay;
mod scenes;
mod so101;
mod so101_record;
mod soak;
mod taught_path;
#[path = "../../tests/tip_motion.rs"]
mod tip_motion;
mod true_motion;
mod wheel_leg;
