//! Dynamics by core and engine, and whole control ticks, each counted by the counters of the core
//! on which it runs. It prints the digest of every result's bits too, so that two processors can be
//! compared; on a host the digests alone.
//!
//! ```text
//! row ROBOT ALGORITHM FORM SINES CYCLES INSTRUCTIONS DIGEST
//! tick SCENE CYCLES INSTRUCTIONS DIGEST
//! torques ROBOT FORM STATE BITS,…
//! exact ROBOT STATE BITS,…
//! ```
//!
//! Counts are the largest of some states, or ticks. SINES is `inside` or `outside`. Lines `exact` are
//! in f64, of a host alone.
#![cfg_attr(target_os = "none", no_std, no_main)]

mod counters;
#[path = "../../../../lab/firmware/src/bin/costs/on_bus.rs"]
mod on_bus;
mod rows;
#[cfg(target_os = "none")]
#[path = "../../cores/src/start.rs"]
mod start;
mod ticks;

use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e, XArm7};
use firmware_demo::scenes::so101_teach::TaughtPath;
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;

#[cfg(target_os = "none")]
use semihosting::println;

static UR5E: Wires<6> = Wires::new();
static SO101: Wires<6> = Wires::new();

/// The work of `main` on every processor.
fn work() {
    counters::calibrate();
    rows::of::<Ur5e, 6, 6>();
    rows::of::<Panda, 7, 7>();
    rows::of::<Iiwa14, 7, 7>();
    rows::derivatives::<Iiwa14, 7, 7>();
    rows::of::<XArm7, 7, 7>();
    rows::of::<A1, 16, 12>();
    ticks::of::<PickAndPlace, 6, 6, 6, 6>(&UR5E);
    ticks::of::<TaughtPath, 6, 6, 6, 6>(&SO101);
    ticks::on_bus();
    println!("done");
}

#[cfg(not(target_os = "none"))]
fn main() {
    work();
}
