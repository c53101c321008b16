//! Runs the scene [`space_arm`](firmware_demo::scenes::space_arm).
#![no_std]
#![no_main]

firmware_demo::scene_main!(space_arm::ReachOut, 7, 13, 12, 6);
