//! The control loop without a plant: its digest covers every bit of every torque.

use firmware_demo::digest::Digest;
use firmware_demo::replay::Replay;
use firmware_demo::scenes::scara_table::Serve;
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;
use motion_control::limits::{Fault, Mode};

type Scara = Replay<Serve, 3, 3, 3, 3>;

/// Wires that no other test uses.
fn wires<const N: usize>() -> &'static Wires<N> {
    Box::leak(Box::default())
}

/// The digest of the whole reference, one bit of one torque of one tick flipped if wanted.
fn digest(flipped: Option<(u32, usize, u32)>) -> Digest {
    let mut replay = Scara::new(wires()).expect("a trajectory");
    let (ticks, mut now) = (replay.length(), 0);
    let digest = replay.run(ticks, |replay| {
        let mut telemetry = replay.tick();
        if let Some((_, joint, bit)) = flipped.filter(|(tick, ..)| *tick == now) {
            let torque = &mut telemetry.torque[joint];
            *torque = f32::from_bits(torque.to_bits() ^ 1 << bit);
        }
        now += 1;
        telemetry
    });
    digest.expect("every tick under the full law")
}

#[test]
fn one_changed_bit_changes_the_digest() {
    let whole = digest(None);
    assert_eq!(digest(None), whole);
    for flipped in [(0, 0, 0), (700, 1, 31), (2559, 2, 0)] {
        assert_ne!(digest(Some(flipped)), whole, "{flipped:?}");
    }
    // Ticks after the end of the reference are not run, and change nothing.
    assert_eq!(digest(Some((2560, 0, 0))), whole);
}

#[test]
fn the_arm_runs_undisturbed_to_the_end_of_its_reference() {
    let mut replay = Replay::<PickAndPlace, 6, 6, 6, 6>::new(wires()).expect("a trajectory");
    let ticks = replay.length();
    let mut largest = 0.0_f32;
    let digest = replay.run(ticks, |replay| {
        let telemetry = replay.tick();
        largest = telemetry.torque.into_iter().map(f32::abs).fold(largest, f32::max);
        telemetry
    });
    assert_eq!(ticks, 6700);
    assert_ne!(digest.expect("every tick under the full law"), Digest::EMPTY);
    assert!(largest > 50.0, "the shoulder bears the arm: {largest} N·m");
}

#[test]
fn a_disturbed_tick_gives_no_digest() {
    let wires = wires();
    let mut replay = Scara::new(wires).expect("a trajectory");
    let mut now = 0;
    let outcome = replay.run(20, |replay| {
        if now == 7 {
            wires.flag(1);
        }
        now += 1;
        replay.tick()
    });
    let interrupted = outcome.expect_err("an encoder with an error");
    // The frame of a tick was latched in the tick before.
    assert_eq!(interrupted.tick, 8);
    assert_eq!(interrupted.status.mode, Mode::Full);
    assert_eq!(interrupted.status.fault, Some(Fault::Encoder { joint: 1 }));
}
