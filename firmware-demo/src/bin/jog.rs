//! Runs the scene [`jog`](firmware_demo::scenes::jog).
#![no_std]
#![no_main]

firmware_demo::scene_main!(jog::Jog, 6, 6, 6, 6);
