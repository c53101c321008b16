//! The whole tick of a scene, from its encoders to its drives, as `marked_tick` is for the meter.

use embedded_can::Frame;
use firmware_demo::digest::Digest;
use firmware_demo::replay::Replay;
use firmware_demo::scene::Scene;
use firmware_demo::sim_io::Wires;
use joint_drivers::{Phase, Probe, Telemetry};

#[cfg(target_os = "none")]
use semihosting::println;

use crate::counters::{Count, between, read};

/// The ticks that are counted, from the start of the motion: every tick without a fault executes
/// the same dynamics, law and gate.
const TICKS: u32 = 50;

/// Counts the phase [`Phase::Tick`].
#[derive(Default)]
struct Counted {
    begin: Count,
    tick: Count,
}

impl<const V: usize> Probe<V> for Counted {
    #[inline(always)]
    fn begin(&mut self, phase: Phase) {
        if let Phase::Tick = phase {
            self.begin = read();
        }
    }

    #[inline(always)]
    fn end(&mut self, phase: Phase) {
        if let Phase::Tick = phase {
            self.tick = between(self.begin, read());
        }
    }

    #[inline(always)]
    fn record(&mut self, _: &Telemetry<V>) {}
}

/// Prints the row of a scene.
#[inline(never)]
pub fn of<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    wires: &'static Wires<N>,
) where
    S: Scene<B, Q, V, N>,
{
    let Ok(mut replay) = Replay::<S, B, Q, V, N>::new(wires) else {
        panic!("the limits of the robot do not allow the trajectory");
    };
    let (mut cycles, mut instructions) = (0, 0);
    let digest = replay.run(TICKS, |replay| {
        let mut probe = Counted::default();
        let telemetry = replay.tick_probed(&mut probe);
        cycles = probe.tick.cycles.max(cycles);
        instructions = probe.tick.instructions.max(instructions);
        telemetry
    });
    match digest {
        Ok(Digest(digest)) => println!("tick {} {cycles} {instructions} {digest:016x}", S::NAME),
        Err(interrupted) => panic!("{interrupted}"),
    }
}

/// Prints the row of `openarm_free_drive`, with its frames.
#[inline(never)]
pub fn on_bus() {
    let (mut cycles, mut instructions, mut digest) = (0, 0, Digest::EMPTY);
    let counted = crate::on_bus::with(|arm| {
        for came in (0..TICKS as usize).filter_map(crate::on_bus::replies) {
            let begin = read();
            let sent = crate::on_bus::tick(arm, &came);
            let count = between(begin, read());
            cycles = count.cycles.max(cycles);
            instructions = count.instructions.max(instructions);
            for frame in sent.iter().flatten() {
                digest.add::<8>(core::array::from_fn(|i| frame.data()[i].into()));
            }
        }
    });
    assert!(counted.is_some(), "the arm is none");
    println!("tick openarm_free_drive {cycles} {instructions} {:016x}", digest.0);
}
