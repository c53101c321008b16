//! The control loop of a robot: its model, what acts on it, its motion, its board.
//!
//! `cargo test` and `cargo run` simulate it on this computer, `cargo qemu` on an emulated
//! Cortex-M4F.

#![cfg_attr(target_os = "none", no_std)]
#![deny(unsafe_code)]

pub mod board;
pub mod control;
#[cfg(feature = "telemetry")]
pub mod excitation;
pub mod marker;
pub mod report;
pub mod robot;
pub mod scene;
pub mod simulation;
#[cfg(feature = "telemetry")]
pub mod watch;
