//! Runs the scene [`ur5e`](firmware_demo::scenes::ur5e).
#![no_std]
#![no_main]

firmware_demo::scene_main!(ur5e::PickAndPlace, 6, 6, 6, 6);
