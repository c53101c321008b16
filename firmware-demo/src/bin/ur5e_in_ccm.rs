//! Runs the scene [`ur5e`](firmware_demo::scenes::ur5e) with its tick placed as a project for a
//! Nucleo-G474RE places it: in memory that never waits.
#![no_std]
#![no_main]

#[path = "../../boards/support/src/stm32g4/fast.rs"]
mod fast;

firmware_demo::scene_main!(ur5e::PickAndPlace, 6, 6, 6, 6);
