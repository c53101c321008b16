//! Runs the scene [`panda_payload`](firmware_demo::scenes::panda_payload).
#![no_std]
#![no_main]

firmware_demo::scene_main!(panda_payload::Carry, 7, 7, 7, 7);
