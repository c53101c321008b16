//! Servos that share a serial bus.

pub mod feetech;
