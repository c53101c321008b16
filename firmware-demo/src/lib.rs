//! Motor-control firmware on `embedded-hal`: a control loop that computes feed-forward torques
//! each tick, and what an emulator needs to run it.
//!
//! | module | what | on hardware |
//! |---|---|---|
//! | [`control_loop`] | the tick: read, reference, dynamics, safety, write | as it is |
//! | [`encoder`], [`drive`] | an AS5047P-type encoder on SPI, a current-controlled drive on PWM | as they are |
//! | [`digest`] | digests of the dynamics' results on recorded states | as they are |
//! | [`hard`] | hard cases that host and target share | left out |
//! | [`marker`] | the measured regions | `dbg` is a no-op there |
//! | [`plant`], [`sim_io`] | a simulated robot behind the same traits | left out |
//! | [`scene`] | runs of one trajectory under several laws, with their tracking errors | left out |
//! | [`robots`] | robots that no manufacturer publishes | left out |
//! | [`scenes`] | the data sheet of each scene | left out |
//! | [`effect_presets`], [`trajectories`] | every effect with numbers, and motions to price effects by | left out |
//! | `accuracy` (feature of that name) | the ways to compute a torque that `cargo xtask accuracy` compares | left out |
//! | `target` | interrupt, log, panic handler of the emulated board | your board's |
#![no_std]

#[cfg(feature = "accuracy")]
pub mod accuracy;
pub mod control_loop;
pub mod digest;
pub mod drive;
pub mod effect_presets;
pub mod encoder;
pub mod hard;
pub mod marker;
pub mod plant;
pub mod robots;
pub mod scene;
pub mod scenes;
pub mod sim_io;
#[cfg(target_arch = "arm")]
pub mod target;
pub mod trajectories;
