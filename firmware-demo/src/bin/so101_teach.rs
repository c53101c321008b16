//! Runs the scene [`so101_teach`](firmware_demo::scenes::so101_teach).
#![no_std]
#![no_main]

firmware_demo::scene_main!(so101_teach::TaughtPath, 6, 6, 6, 6);
