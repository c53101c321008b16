//! Claims about the control loop that ships, on the scene's plant, with wires that fail.

use crate::arm::outcome::bad_frames;
use crate::arm::{Arm, HOLD, POISON, RIDE};
use host_tests::measured::{largest, within};
use motion_control::{limits::Mode, motion::ResetError};
use proptest::prelude::*;

/// The fastest moment of the trajectory: 1.9 rad/s.
const FAST: u32 = 3200;
/// A moment with a load on the shoulder, slower.
const SLOW: u32 = 1600;

#[test]
fn a_bad_frame_does_not_jolt_the_arm() {
    let mut more = vec![];
    for at in [SLOW, FAST, 5000] {
        let whole = bad_frames(at, 0, 0).worst;
        for mask in [1, 0x8000] {
            for ticks in 1..=RIDE {
                let ridden = bad_frames(at, ticks, mask);
                more.push(ridden.worst - whole);
                assert!(ridden.modes.iter().all(|&mode| mode == Mode::Full));
                assert_eq!((ridden.others, ridden.back), (vec![], 0));
            }
        }
    }
    within("error of bad frames, rad", largest(more), 5e-5);
}

// No joint turns back.
#[test]
fn a_longer_fault_ends_on_the_trajectory() {
    let (mut reversals, mut errors, mut back) = (vec![], vec![], vec![]);
    for at in [SLOW, FAST, 5000] {
        for ticks in [RIDE + 1, 20, 50, 100, RIDE + HOLD] {
            let held = bad_frames(at, ticks, 1);
            reversals.push(held.reversal);
            errors.push(held.worst);
            back.push(held.back);
            assert_eq!(held.others, vec![]);
            let of = |mode| held.modes.iter().filter(|&&m| m == mode).count() as u32;
            assert_eq!((of(Mode::Hold), of(Mode::Stopped)), (ticks - RIDE, 0));
        }
    }
    let reversal = largest(reversals);
    assert!(reversal <= 0.0, "{reversal} rad/s");
    within("error, rad", largest(errors), 4e-3);
    within("ticks until back", largest(back), 120.0);
}

#[test]
fn a_moment_without_a_torque_does_not_jolt_the_arm() {
    let mut arm = Arm::new();
    arm.run(FAST);
    let mut errors = vec![];
    for tick in 0..300 {
        POISON.set((tick < RIDE).then_some((0, f32::NAN)));
        let actual = arm.rig.plant.state.q;
        let telemetry = arm.tick();
        errors.push(Arm::error(&telemetry.reference, &actual));
        assert_eq!(telemetry.status.mode, Mode::Full);
    }
    within("error, rad", largest(errors), 3e-4);
}

/// An arm that a lasting fault at full speed has stopped.
fn stopped() -> Arm {
    let mut arm = Arm::new();
    arm.run(FAST);
    arm.corrupt(0, 1);
    arm.run(RIDE + HOLD + 20);
    arm
}

#[test]
fn after_a_reset_the_arm_goes_back_to_its_trajectory() {
    let mut arm = stopped();
    assert_eq!(arm.control.reset(&arm.trajectory), Err(ResetError::NoMeasurement));
    arm.corrupt(0, 0);
    arm.run(2000);
    assert_eq!(arm.control.reset(&arm.trajectory), Ok(()));
    let (mut errors, mut speeds) = (vec![], vec![]);
    for tick in 0..600 {
        let actual = arm.rig.plant.state.q;
        let telemetry = arm.tick();
        assert_eq!((telemetry.status.mode, telemetry.status.fault), (Mode::Full, None));
        // The brake opens no sooner than the torque is there.
        assert!(tick > 0 || arm.brake.0.0.get() == telemetry.status.limited);
        errors.push(Arm::error(&telemetry.reference, &actual));
        speeds.extend(arm.rig.plant.state.qd.map(f32::abs));
    }
    within("error on the way back, rad", largest(errors.iter().copied()), 1e-3);
    within("error on the trajectory, rad", largest(errors.split_off(400)), 5e-4);
    within("speed, rad/s", largest(speeds), 2.5);
    assert_eq!(arm.control.reset(&arm.trajectory), Err(ResetError::NotStopped));
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        cases: 64,
        ..ProptestConfig::default()
    })]

    #[test]
    fn no_fault_drives_a_torque_beyond_its_limits(
        at in 0..6000_u32,
        wrongs in prop::collection::vec((0..6_usize, 0..6_u8, any::<u16>(), 1..150_u32), 1..6),
    ) {
        let mut arm = Arm::new();
        arm.run(at + 1);
        for (joint, kind, bits, ticks) in wrongs {
            match kind {
                0 | 1 => arm.corrupt(joint, bits),
                2 => arm.bent[joint].bus.set(true),
                3 => POISON.set(Some((joint, f32::from_bits(u32::from(bits) << 16)))),
                4 => arm.wires.flag(joint),
                _ => arm.bent[joint].drive.set(bits % 4 == 0),
            }
            for _ in 0..ticks {
                let telemetry = arm.tick();
                for (tau, limit) in telemetry.torque.iter().zip(&arm.limits) {
                    prop_assert!(tau.abs() <= limit.torque, "{telemetry:?}");
                }
                let stopped = telemetry.status.mode == Mode::Stopped;
                prop_assert!(!stopped || telemetry.torque == [0.0; 6] && arm.brake.0.0.get());
                prop_assert!(telemetry.estimate.iter().all(|q| q.is_finite()));
            }
            arm.corrupt(joint, 0);
            arm.bent[joint].bus.set(false);
            POISON.set(None);
            let _ = arm.control.reset(&arm.trajectory);
        }
    }
}
