//! Runs the scene [`gimbal_ship`](firmware_demo::scenes::gimbal_ship).
#![no_std]
#![no_main]

firmware_demo::scene_main!(gimbal_ship::OnWatch, 3, 3, 3, 3);
