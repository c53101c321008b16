//! Runs the scene [`delta_pick`](firmware_demo::scenes::delta_pick).
#![no_std]
#![no_main]

firmware_demo::scene_main!(delta_pick::Picking, 12, 12, 12, 3);
