//! Runs the scene [`direct_drive`](firmware_demo::scenes::direct_drive).
#![no_std]
#![no_main]

firmware_demo::scene_main!(direct_drive::FastArm, 3, 3, 3, 3);
