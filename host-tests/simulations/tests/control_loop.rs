//! Claims about the control loop that ships, on the scene's plant, with wires that fail.

use std::cell::RefCell;

use crate::arm::outcome::bad_frames;
use crate::arm::{Arm, FullModel, HOLD, POISON, RIDE};
use embedded_hal::spi::ErrorKind;
use firmware_demo::scenes::ur5e::GravityOnly;
use host_tests::measured::{largest, within};
use joint_drivers::as5047p::FrameError;
use motion_control::{Fault, Mode, ResetError, StopCategory};
use proptest::prelude::*;

/// The fastest moment of the trajectory: 1.9 rad/s.
const FAST: u32 = 3200;
/// A moment with a load on the shoulder, slower.
const SLOW: u32 = 1600;

/// The joint whose encoder had no angle in the last tick, and why.
fn frame(arm: &Arm) -> Option<(usize, FrameError)> {
    let last = arm.control.encoder_error();
    last.map(|last| (last.joint, *last.error))
}

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
fn a_measurement_after_a_hold_is_accepted_at_once() {
    let mut arm = Arm::new();
    arm.run(FAST);
    arm.corrupt(0, 1);
    arm.run(50);
    // Something has pushed the arm while nobody looked.
    arm.rig.plant.state.q[0] += 0.01;
    arm.wires.publish(&arm.rig.plant.state.q);
    arm.run(2);
    arm.corrupt(0, 0);
    let actual = arm.rig.plant.state.q;
    let telemetry = arm.tick();
    assert_eq!(telemetry.status.fault, None);
    let error = Arm::error(&telemetry.estimate, &actual);
    within("error of the estimate, rad", error, 1e-3);
}

/// Such a law cannot bring a deceleration about.
#[test]
fn k_d_slows_an_arm_whose_law_lacks_inertia() {
    let mut arm = Arm::new();
    (0..FAST).for_each(|_| _ = arm.tick_under::<GravityOnly>());
    arm.corrupt(0, 1);
    let speed = |arm: &Arm| largest(arm.rig.plant.state.qd.map(f32::abs));
    let fast = speed(&arm);
    (0..RIDE + 50).for_each(|_| _ = arm.tick_under::<GravityOnly>());
    within("speed left", speed(&arm) / fast, 0.6);
}

#[test]
fn a_lasting_fault_brakes_and_names_frame_and_joint() {
    let mut arm = Arm::new();
    arm.run(SLOW);
    arm.corrupt(3, 1);
    arm.corrupt(5, 1);
    for tick in 0..2 * (RIDE + HOLD) {
        let telemetry = arm.tick();
        assert_eq!(telemetry.status.fault, Some(Fault::Encoder { joint: 3 }));
        assert_eq!(frame(&arm), Some((3, FrameError::Parity)));
        let stopped = tick >= RIDE + HOLD;
        assert_eq!(telemetry.status.mode == Mode::Stopped, stopped);
        assert_eq!(arm.brake.0.0.get(), stopped);
        assert!(!stopped || telemetry.torque == [0.0; 6]);
    }
}

#[test]
fn an_error_flag_costs_one_angle_and_is_read() {
    let mut arm = Arm::new();
    arm.run(FAST);
    arm.wires.flag(2);
    // The answer of this tick was latched before.
    arm.tick();
    assert_eq!(frame(&arm), None);
    let telemetry = arm.tick();
    assert_eq!(frame(&arm), Some((2, FrameError::Flag)));
    assert_eq!(telemetry.status.fault, Some(Fault::Encoder { joint: 2 }));
    for _ in 0..100 {
        assert_eq!(arm.tick().status.fault, None);
    }
}

#[test]
fn a_bus_that_fails_for_a_moment_is_ridden_through() {
    let mut arm = Arm::new();
    arm.run(FAST);
    arm.bent[4].bus.set(true);
    for _ in 0..RIDE {
        let telemetry = arm.tick();
        assert_eq!(frame(&arm), Some((4, FrameError::Bus(ErrorKind::Other))));
        assert_eq!(telemetry.status.mode, Mode::Full);
    }
    arm.bent[4].bus.set(false);
    let errors = [(); 100].map(|()| {
        let actual = arm.rig.plant.state.q;
        let telemetry = arm.tick();
        // The frame after the failure still carries the angle of before it.
        assert_eq!(telemetry.status.mode, Mode::Full);
        Arm::error(&telemetry.reference, &actual)
    });
    within("error, rad", largest(errors), 3e-4);
}

#[test]
fn nan_from_the_law_never_reaches_a_drive() {
    for poison in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut arm = Arm::new();
        let before = arm.run(SLOW).torque;
        let fault = Some(Fault::Torque { joint: 1 });
        POISON.set(Some((1, poison)));
        for tick in 0..20 {
            let telemetry = arm.tick();
            assert_eq!(telemetry.status.fault, fault);
            let (torque, mode) = match tick {
                0..RIDE => (before, Mode::Full),
                RIDE => (before, Mode::Hold),
                _ => ([0.0; 6], Mode::Stopped),
            };
            assert_eq!((telemetry.torque, telemetry.status.mode), (torque, mode));
            assert_eq!(arm.brake.0.0.get(), mode == Mode::Stopped);
        }
        POISON.set(None);
    }
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

#[test]
fn a_refusing_drive_brakes_the_arm_and_is_named() {
    let mut arm = Arm::new();
    arm.run(SLOW);
    arm.bent[2].drive.set(true);
    arm.bent[4].drive.set(true);
    assert_eq!(arm.tick().status.fault, None);
    assert!(arm.brake.0.0.get());
    let telemetry = arm.tick();
    assert_eq!(telemetry.status.fault, Some(Fault::Drive { joint: 2 }));
    assert_eq!(
        (telemetry.status.mode, telemetry.torque),
        (Mode::Stopped, [0.0; 6])
    );
    arm.bent[2].drive.set(false);
    arm.bent[4].drive.set(false);
    assert_eq!(arm.run(50).status.mode, Mode::Stopped);
}

#[test]
fn a_brake_that_refuses_stops_the_arm() {
    let mut arm = Arm::new();
    arm.run(SLOW);
    arm.brake.0.1.set(true);
    arm.tick();
    let status = arm.tick().status;
    assert_eq!(
        (status.mode, status.fault),
        (Mode::Stopped, Some(Fault::Brake))
    );
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
    assert_eq!(
        arm.control.reset(&arm.trajectory),
        Err(ResetError::NoMeasurement)
    );
    arm.corrupt(0, 0);
    arm.run(2000);
    assert_eq!(arm.control.reset(&arm.trajectory), Ok(()));
    let (mut errors, mut speeds) = (vec![], vec![]);
    for tick in 0..600 {
        let actual = arm.rig.plant.state.q;
        let telemetry = arm.tick();
        assert_eq!(
            (telemetry.status.mode, telemetry.status.fault),
            (Mode::Full, None)
        );
        // The brake opens no sooner than the torque is there.
        assert!(tick > 0 || arm.brake.0.0.get() == telemetry.status.limited);
        errors.push(Arm::error(&telemetry.reference, &actual));
        speeds.extend(arm.rig.plant.state.qd.map(f32::abs));
    }
    within(
        "error on the way back, rad",
        largest(errors.iter().copied()),
        1e-3,
    );
    within(
        "error on the trajectory, rad",
        largest(errors.split_off(400)),
        5e-4,
    );
    within("speed, rad/s", largest(speeds), 2.5);
    assert_eq!(
        arm.control.reset(&arm.trajectory),
        Err(ResetError::NotStopped)
    );
}

#[test]
fn an_arm_far_from_its_reference_is_not_started_again() {
    let mut arm = stopped();
    arm.corrupt(0, 0);
    arm.rig.plant.state.q[4] += 0.2;
    arm.wires.publish(&arm.rig.plant.state.q);
    arm.run(5);
    assert_eq!(
        arm.control.reset(&arm.trajectory),
        Err(ResetError::TooFar { joint: 4 })
    );
    assert_eq!(arm.tick().status.mode, Mode::Stopped);
    arm.rig.plant.state.q[4] -= 0.2;
    arm.wires.publish(&arm.rig.plant.state.q);
    arm.run(5);
    assert_eq!(arm.control.reset(&arm.trajectory), Ok(()));
}

#[test]
fn encoders_are_started_before_the_first_tick() {
    let mut arm = Arm::new();
    let telemetry = arm.tick();
    assert_eq!((telemetry.status.fault, frame(&arm)), (None, None));
    let error = Arm::error(&telemetry.estimate, &arm.rig.plant.state.q);
    within("error of the estimate, rad", error, 2e-9);
}

/// A tick at the counts of a timer at its begin and its end, and whether it feeds the watchdog.
fn tick_at(arm: &mut Arm, counts: [u32; 2]) -> (Option<Fault>, bool) {
    let counts = RefCell::new(counts.into_iter());
    let timer = || counts.borrow_mut().next().expect("read twice");
    let trajectory = arm.trajectory;
    let (telemetry, completed) = arm
        .control
        .tick_at::<FullModel, _, ()>(&trajectory, &(), timer);
    arm.advance();
    (telemetry.status.fault, completed.is_some())
}

// Missed ticks are reported.
#[test]
fn only_a_tick_in_time_feeds_the_watchdog() {
    let mut arm = Arm::new();
    let mut now = 0;
    while now < FAST {
        assert_eq!(tick_at(&mut arm, [now; 2]), (None, true));
        now += 1;
    }
    // Four periods without a tick: the drives keep their torques, and the trajectory goes on.
    (0..4).for_each(|_| arm.advance());
    now += 4;
    assert_eq!(tick_at(&mut arm, [now; 2]), (None, true));
    assert_eq!(
        arm.control
            .tick::<FullModel, _, ()>(&arm.trajectory, &())
            .tick,
        now + 1
    );
    // A tick that ends a period later is a fault of the next one, which is ridden through.
    now += 2;
    assert_eq!(tick_at(&mut arm, [now, now + 1]), (None, false));
    assert_eq!(
        tick_at(&mut arm, [now + 1; 2]),
        (Some(Fault::Overrun), true)
    );
    assert_eq!(tick_at(&mut arm, [now + 2; 2]), (None, true));
    // Longer than a fault may last.
    let late = now + 4 + RIDE + HOLD;
    assert_eq!(tick_at(&mut arm, [late; 2]), (Some(Fault::Missed), true));
    assert!(arm.brake.0.0.get());
}

#[test]
fn category_1_brings_the_arm_to_rest_before_braking() {
    let mut arm = Arm::new();
    arm.run(FAST);
    arm.control
        .stop_by(Fault::External, StopCategory::ControlledOff);
    let modes: Vec<Mode> = (0..HOLD).map(|_| arm.tick().status.mode).collect();
    assert!(modes.iter().all(|&mode| mode == Mode::Hold));
    let speed = largest(arm.rig.plant.state.qd.map(f32::abs));
    within("speed when the brake closes, rad/s", speed, 0.3);
    assert_eq!(arm.tick().status.mode, Mode::Stopped);
    assert!(arm.brake.0.0.get());
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
