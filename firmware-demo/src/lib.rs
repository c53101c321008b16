//! Motor-control firmware on `embedded-hal`: a control loop that computes feed-forward torques
//! each tick, and what an emulator needs to run it.
//!
//! | module | what | on hardware |
//! |---|---|---|
//! | [`joint_drivers`] | the control loop, an AS5047P on SPI, a current-controlled drive on PWM | as they are |
//! | [`digest`] | a digest of many numbers, to compare machines by | as it is |
//! | [`marker`] | the measured regions | `dbg` is a no-op there |
//! | [`plant`], [`sim_io`] | a simulated robot behind the same traits | left out |
//! | [`region`] | the regions of a tick, as a probe of the control loop | left out |
//! | [`replay`] | the control loop of a scene without a simulated robot, with a digest of its torques | as it is |
//! | [`scene`] | runs of one trajectory under several laws, with their tracking errors | left out |
//! | [`robots`] | robots that no manufacturer publishes | left out |
//! | [`scenes`] | the data sheet of each scene | left out |
//! | [`trajectories`] | the motions of the scenes | left out |
//! | `watched` (feature `telemetry`) | a scene that runs without end and sends its telemetry | the queue and its two sides |
//! | `target` | interrupt, log, panic handler of the emulated board | your board's |
#![no_std]

pub mod digest;
pub mod marker;
pub mod plant;
pub mod region;
pub mod replay;
pub mod robots;
pub mod scene;
pub mod scenes;
pub mod sim_io;
#[cfg(all(target_arch = "arm", feature = "netduinoplus2"))]
pub mod target;
pub mod trajectories;
#[cfg(feature = "telemetry")]
pub mod watched;
