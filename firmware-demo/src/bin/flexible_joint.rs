//! Runs the scene [`flexible_joint`](firmware_demo::scenes::flexible_joint).
#![no_std]
#![no_main]

firmware_demo::scene_main!(flexible_joint::CompliantArm, 7, 7, 7, 7);
