//! Runs the scene [`ur5e`](firmware_demo::scenes::ur5e) without end and sends its telemetry over
//! the serial port: what `cargo xtask watch` shows.
#![no_std]
#![no_main]

firmware_demo::watch_main!(ur5e::PickAndPlace, 6, 6, 6, 6);
