//! The shipped control loop on the scene's plant under random faults, for as many ticks as one
//! likes: `SOAK_TICKS=10000000` names ten million.

use crate::arm::{Arm, POISON};
use host_tests::random::random_numbers;
use motion_control::limits::Mode;
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

/// Ticks of one arm: its way and some rest.
const ROUND: u32 = 8_000;

fn spoil(arm: &Arm, rng: &mut TestRng) {
    let joint = rng.random_range(0..6);
    match rng.random_range(0..6) {
        0 | 1 => arm.corrupt(joint, rng.random()),
        2 => arm.bent[joint].bus.set(true),
        3 => POISON.set(Some((joint, f32::from_bits(rng.random())))),
        4 => arm.wires.flag(joint),
        _ => arm.bent[joint].drive.set(rng.random_range(0..4) == 0),
    }
}

fn mend(arm: &Arm) {
    for (joint, bent) in arm.bent.iter().enumerate() {
        arm.corrupt(joint, 0);
        bent.bus.set(false);
        bent.drive.set(false);
    }
    POISON.set(None);
}

/// Demands that a tick kept every limit.
fn tick(arm: &mut Arm, last: &mut [f32; 6]) -> Mode {
    let telemetry = arm.tick();
    for ((&tau, last), limit) in telemetry.torque.iter().zip(last).zip(&arm.limits) {
        assert!(tau.abs() <= limit.torque, "{telemetry:?}");
        let least = (tau - *last).abs() <= 0.5001 * limit.torque;
        assert!(least || tau == 0.0, "{telemetry:?} after {last}");
        *last = tau;
    }
    let numbers =
        [telemetry.reference, telemetry.estimate, arm.rig.plant.state.q, arm.rig.plant.state.qd];
    assert!(numbers.iter().flatten().all(|x| x.is_finite()), "{telemetry:?}");
    let stopped = telemetry.status.mode == Mode::Stopped;
    assert!(!stopped || telemetry.torque == [0.0; 6] && arm.brake.0.0.get());
    telemetry.status.mode
}

#[test]
fn random_failures_never_exceed_a_limit() {
    let ticks = std::env::var("SOAK_TICKS").ok().and_then(|n| n.parse().ok());
    let (ticks, rng) = (ticks.unwrap_or(200_000_u64), &mut random_numbers());
    let (mut done, mut stops, mut held) = (0_u64, 0_u64, 0_u64);
    while done < ticks {
        let (mut arm, mut last) = (Arm::new(), [0.0; 6]);
        let mut wrong = 0;
        for _ in 0..ROUND {
            if wrong == 0 && rng.random_range(0..200) == 0 {
                spoil(&arm, rng);
                wrong = rng.random_range(1..150);
            } else if wrong > 0 {
                wrong -= 1;
                if wrong == 0 {
                    mend(&arm);
                }
            }
            match tick(&mut arm, &mut last) {
                Mode::Stopped if wrong == 0 => {
                    stops += u64::from(arm.control.reset(&arm.trajectory).is_ok());
                }
                Mode::Hold => held += 1,
                _ => {}
            }
        }
        mend(&arm);
        done += u64::from(ROUND);
    }
    println!("{done} ticks, {held} of them held, {stops} restarts");
    assert!(stops > 0 && held > 0, "the faults did something");
}
