//! Runs the scene [`flexible_link`](firmware_demo::scenes::flexible_link).
#![no_std]
#![no_main]

firmware_demo::scene_main!(flexible_link::BendingArm, 2, 2, 2, 2);
