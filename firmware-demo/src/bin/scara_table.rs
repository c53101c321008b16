//! Runs the scene [`scara_table`](firmware_demo::scenes::scara_table).
#![no_std]
#![no_main]

firmware_demo::scene_main!(scara_table::Serve, 3, 3, 3, 3);
