//! Runs the scene [`leg_hop`](firmware_demo::scenes::leg_hop).
#![no_std]
#![no_main]

firmware_demo::scene_main!(leg_hop::Hopping, 5, 4, 4, 3);
