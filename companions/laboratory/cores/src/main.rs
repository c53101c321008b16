//! Runs the control loop of two scenes without a simulated robot, and prints digests of its torques
//! and the stack of a tick: in QEMU on each core, on the host the digests alone, which are the
//! reference.
//!
//! The laboratory builds it with the flags and the linker script of each core, and compares
//! what it prints.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware_demo::replay::Replay;
use firmware_demo::scene::{Full, Scene, marked_tick};
use firmware_demo::scenes::scara_table::Serve;
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;

#[cfg(target_os = "none")]
use semihosting::println;

#[cfg(target_os = "none")]
mod stack;
#[cfg(target_os = "none")]
mod start;

static SMALL: Wires<3> = Wires::new();
static UR5E: Wires<6> = Wires::new();

/// The work of `main` on every processor.
fn work() {
    replay::<Serve, 3, 3, 3, 3>(&SMALL);
    replay::<PickAndPlace, 6, 6, 6, 6>(&UR5E);
    println!("done");
}

/// Runs a scene from the start of its reference to its end.
#[inline(never)]
fn replay<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    wires: &'static Wires<N>,
) where
    S: Scene<B, Q, V, N>,
{
    let name = S::NAME;
    let Ok(mut replay) = Replay::<S, B, Q, V, N>::new(wires) else {
        panic!("the limits of the robot do not allow the trajectory");
    };
    let ticks = replay.length();
    let mut deepest = 0;
    let digest = replay.run(ticks, |replay| {
        let (telemetry, depth) = measured(|| replay.tick());
        deepest = deepest.max(depth);
        telemetry
    });
    match digest {
        Ok(digest) => println!("digest {name} {ticks} {:016x}", digest.0),
        Err(interrupted) => panic!("{interrupted}"),
    }
    if cfg!(target_os = "none") {
        let tick = marked_tick::<Full<S, B, Q, V>, S::Reference, S::Environment, N>;
        println!("stack {name} {deepest}");
        println!("tick {name} {}", tick as *const () as usize);
    }
}

#[cfg(target_os = "none")]
use stack::measured;

/// The result of `run`. A host does not measure the stack.
#[cfg(not(target_os = "none"))]
fn measured<T>(run: impl FnOnce() -> T) -> (T, usize) {
    (run(), 0)
}

#[cfg(not(target_os = "none"))]
fn main() {
    work();
}
