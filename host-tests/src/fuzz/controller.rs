//! The controller under any sequence of wrong inputs, missed ticks and resets.

use super::bytes::Bytes;
use crate::controller::{Bench, INPUTS, Poison, TICK};
use motion_control::limits::{Command, Fault, Mode};

/// Ticks of an arm in motion, one or a few for every four bytes.
///
/// # Panics
/// If a torque is no number or beyond its limit, or an arm that is stopped is not on its brake.
pub fn controller(bytes: &[u8]) {
    let from = &mut Bytes(bytes);
    let mut bench = Bench::<f32>::new(0.5, 500);
    while from.any() {
        let (what, joint) = (from.byte(), from.below(6));
        match what % 16 {
            0..4 => tick(&mut bench, |bench| bench.tick(None)),
            4..10 => {
                let poison = Poison {
                    input: INPUTS[usize::from(what) % INPUTS.len()],
                    joint,
                    value: from.number() as f32,
                };
                tick(&mut bench, |bench| bench.tick(Some(poison)));
            }
            10 => tick(&mut bench, |bench| bench.tick_of(Err(Fault::Encoder { joint }), None)),
            11 => {
                let missed = u32::from(from.byte());
                bench.advance(TICK * f64::from(missed));
                tick(&mut bench, |bench| bench.late_tick(missed));
            }
            12 => {
                let q = from.numbers().map(|x: f64| x as f32);
                tick(&mut bench, |bench| bench.tick_of(Ok(&q), None));
            }
            13 => _ = bench.reset(),
            _ => (0..from.byte() % 32).for_each(|_| tick(&mut bench, |bench| bench.tick(None))),
        }
    }
}

fn tick(bench: &mut Bench<f32>, call: impl FnOnce(&mut Bench<f32>) -> Command<f32, 6>) {
    let stopped = call(bench).status.mode == Mode::Stopped;
    assert!(bench.effort() <= 1.0, "{:?}", bench.command);
    assert!(!stopped || bench.brake && bench.command == [0.0; 6]);
    bench.advance(TICK);
}
