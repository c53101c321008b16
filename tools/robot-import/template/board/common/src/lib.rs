//! The robot's model, limits, motion and control loop, whatever board it runs on.

#![no_std]
#![forbid(unsafe_code)]

pub mod board;
pub mod control;
pub mod robot;
pub mod say;
pub mod scene;
