//! The parts of boards that no project changes, for the control loop of `joint-drivers`: where the
//! HAL of a chip lacks something, or has it with a panic that a tick could reach.
//!
//! `stm32f4` and `stm32g4` have the period, the watchdog and PWM under the same names, `rp2350` has
//! pins and PWM. Each is a feature.

#![no_std]

pub mod encoders;
pub mod periods;
#[cfg(feature = "rp2350")]
pub mod rp2350;
#[cfg(feature = "stm32f4")]
pub mod stm32f4;
#[cfg(feature = "stm32g4")]
pub mod stm32g4;
