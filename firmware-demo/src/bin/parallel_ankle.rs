//! Runs the scene [`parallel_ankle`](firmware_demo::scenes::parallel_ankle).
#![no_std]
#![no_main]

firmware_demo::scene_main!(parallel_ankle::AnkleSteps, 9, 9, 9, 3);
