//! Stop categories.

use super::*;
use crate::safety::StopCategory;

const EXTERNAL: Option<Fault> = Some(Fault::External);

/// One that is stopped by a category, after a tick with a torque of 3.
fn stopped_by(category: StopCategory<f32, 2>) -> Supervisor<f32, 2> {
    let mut supervisor = riding(2);
    good(&mut supervisor, [3.0; 2]);
    supervisor.stop_by(Fault::External, category);
    supervisor
}

fn modes(supervisor: &mut Supervisor<f32, 2>, ticks: u32) -> Vec<Mode> {
    let tick = |_| good(supervisor, [3.0; 2]).status;
    let statuses = (0..ticks)
        .map(tick)
        .inspect(|status| assert_eq!(status.fault, EXTERNAL));
    statuses.map(|status| status.mode).collect()
}

#[test]
fn category_0_ends_a_controlled_stop_at_once() {
    let off = |supervisor: &mut Supervisor<f32, 2>| {
        let command = good(supervisor, [3.0; 2]);
        assert_eq!((command.torque, command.brake), ([0.0; 2], true));
        assert_eq!(command.status.fault, EXTERNAL);
    };
    off(&mut stopped_by(StopCategory::TorqueOff));
    let mut supervisor = stopped_by(StopCategory::ControlledHold);
    assert_eq!(modes(&mut supervisor, 1), [Mode::Hold]);
    supervisor.stop_by(Fault::Brake, StopCategory::TorqueOff);
    off(&mut supervisor);
}

#[test]
fn category_1_holds_then_switches_off_and_is_latched() {
    let mut supervisor = stopped_by(StopCategory::ControlledOff);
    assert_eq!(modes(&mut supervisor, HOLD), [Mode::Hold; HOLD as usize]);
    assert_eq!(modes(&mut supervisor, 20), [Mode::Stopped; 20]);
    supervisor.reset();
    assert_eq!(good(&mut supervisor, [3.0; 2]).status.fault, None);
    assert_eq!(good(&mut supervisor, [3.0; 2]).status.mode, Mode::Full);
}

#[test]
fn category_2_holds_until_it_is_released() {
    let mut supervisor = stopped_by(StopCategory::ControlledHold);
    assert_eq!(modes(&mut supervisor, 500), [Mode::Hold; 500]);
    assert!(supervisor.stands());
    // Its first reason stays.
    supervisor.stop_by(Fault::Brake, StopCategory::ControlledOff);
    assert_eq!(modes(&mut supervisor, 1), [Mode::Hold]);
    supervisor.release();
    let command = good(&mut supervisor, [3.0; 2]);
    assert_eq!((command.status.mode, command.brake), (Mode::Full, false));
    assert_eq!((command.status.fault, command.torque), (None, [3.0; 2]));
}

#[test]
fn category_2_without_measurements_ends_as_category_1() {
    let mut supervisor = stopped_by(StopCategory::ControlledHold);
    modes(&mut supervisor, 50);
    let lost = |supervisor: &mut _| bad(supervisor, [3.0; 2]).status.mode;
    let held = (0..)
        .take_while(|_| lost(&mut supervisor) == Mode::Hold)
        .count() as u32;
    assert_eq!(held, 2 + HOLD);
    assert!(good(&mut supervisor, [3.0; 2]).brake);
    // Single faults with REENTRY good ticks in between do not add up.
    let mut supervisor = stopped_by(StopCategory::ControlledHold);
    for _ in 0..100 {
        modes(&mut supervisor, REENTRY + 1);
        assert_eq!(lost(&mut supervisor), Mode::Hold);
    }
    // More of them do.
    for _ in 0..100 {
        modes(&mut supervisor, 1);
        if lost(&mut supervisor) == Mode::Stopped {
            return;
        }
    }
    panic!("every other measurement was lost, and the arm was held");
}

#[test]
fn a_standing_arm_with_a_lasting_fault_is_stopped() {
    for reentry_ticks in 0..3 {
        let mut config = CONFIG;
        config.reentry_ticks = reentry_ticks;
        let standing = || {
            let mut supervisor = Supervisor::new(config);
            good(&mut supervisor, [3.0; 2]);
            supervisor.stop_by(Fault::External, StopCategory::ControlledHold);
            modes(&mut supervisor, 20);
            supervisor
        };
        let mut fast = standing();
        for _ in 0..10 {
            let q = fast.last_good;
            fast.accept_measurement(Ok(&q));
            fast.check_speed(&[9.0; 2]);
            fast.gate(&[3.0; 2], &[9.0; 2]);
        }
        let mut lost = standing();
        for _ in 0..10 {
            bad(&mut lost, [3.0; 2]);
        }
        assert_eq!((fast.mode(), lost.mode()), (Mode::Stopped, Mode::Stopped));
    }
}

#[test]
fn the_configured_category_is_that_of_lasting_faults() {
    let after = |category| {
        let mut supervisor = riding(2).with_stop(category);
        good(&mut supervisor, [3.0; 2]);
        [(); 6].map(|()| bad(&mut supervisor, [3.0; 2]).status.mode)
    };
    let (full, held, stopped) = (Mode::Full, Mode::Hold, Mode::Stopped);
    let controlled = [full, full, held, held, held, stopped];
    assert_eq!(
        after(StopCategory::TorqueOff),
        [full, full, stopped, stopped, stopped, stopped]
    );
    assert_eq!(after(StopCategory::ControlledOff), controlled);
    assert_eq!(after(StopCategory::ControlledHold), controlled);
    assert_eq!(
        after(StopCategory::DampedLowering { damping: [1.0; 2] }),
        controlled
    );
}

/// A sinking arm: a tick with a measurement and a velocity.
fn sinks(supervisor: &mut Supervisor<f32, 2>, qd: [f32; 2]) -> [f32; 2] {
    let q = supervisor.last_good;
    supervisor.accept_measurement(Ok(&q));
    supervisor.check_speed(&qd);
    let command = supervisor.gate(&[f32::NAN; 2], &qd);
    assert!(command.brake);
    assert_eq!(command.status.mode, Mode::Stopped);
    command.torque
}

// Its torque and the rate of the torque are limited.
#[test]
fn damping_is_limited_and_never_drives() {
    let damping = [2.0, f32::NAN];
    let mut supervisor = supervisor().with_stop(StopCategory::DampedLowering { damping });
    good(&mut supervisor, [4.0; 2]);
    supervisor.stop(Fault::Drive { joint: 1 });
    // 4 N·m a tick, up to 10 N·m; and 2 N·m·s/rad.
    for (qd, torque) in [
        (-9.0, 8.0),
        (-9.0, 10.0),
        (-9.0, 10.0),
        (-4.0, 8.0),
        (1.0, 4.0),
        (1.0, 0.0),
        (1.0, -2.0),
        (f32::NAN, 0.0),
        (f32::INFINITY, 0.0),
        (-1.0, 2.0),
    ] {
        assert_eq!(sinks(&mut supervisor, [qd, 1.0]), [torque, 0.0], "{qd}");
    }
    // The power that it adds is never positive once the rate allows it.
    supervisor.stop_by(Fault::External, StopCategory::TorqueOff);
    assert_eq!(
        sinks(&mut supervisor, [-1.0, 1.0]),
        [2.0, 0.0],
        "the arm is stopped already"
    );
}

#[test]
fn category_0_takes_the_torque_of_a_sinking_arm() {
    let sinking = StopCategory::DampedLowering { damping: [2.0; 2] };
    let mut supervisor = supervisor().with_stop(sinking);
    good(&mut supervisor, [4.0; 2]);
    supervisor.stop_by(Fault::External, StopCategory::TorqueOff);
    assert_eq!(sinks(&mut supervisor, [-1.0; 2]), [0.0; 2]);
    supervisor.reset();
    good(&mut supervisor, [0.0; 2]);
    supervisor.stop(Fault::External);
    assert_eq!(sinks(&mut supervisor, [-1.0; 2]), [2.0; 2]);
}

#[test]
fn a_restart_ramps_from_the_sinking_arms_torque() {
    let sinking = StopCategory::DampedLowering { damping: [2.0; 2] };
    let mut supervisor = supervisor().with_stop(sinking);
    good(&mut supervisor, [4.0; 2]);
    supervisor.stop(Fault::External);
    assert_eq!(sinks(&mut supervisor, [-1.5; 2]), [3.0; 2]);
    supervisor.reset();
    // 4 N·m a tick.
    assert_eq!(good(&mut supervisor, [-4.0; 2]).torque, [-1.0; 2]);
}

#[test]
fn a_controlled_reaction_stops_by_the_configured_category() {
    let (held, stopped) = (Mode::Hold, Mode::Stopped);
    for (category, wanted) in [
        (StopCategory::TorqueOff, [stopped; 5]),
        (
            StopCategory::ControlledOff,
            [held, held, held, stopped, stopped],
        ),
        (StopCategory::ControlledHold, [held; 5]),
    ] {
        let mut supervisor = riding(2).with_stop(category);
        good(&mut supervisor, [3.0; 2]);
        supervisor.react(Fault::External);
        assert_eq!(modes(&mut supervisor, 5), wanted);
        // One that is stopped already keeps its reason.
        supervisor.react(Fault::Reference { joint: 0 });
        assert_eq!(good(&mut supervisor, [3.0; 2]).status.fault, EXTERNAL);
    }
}

#[test]
fn after_category_2_the_full_law_returns_gradually() {
    let mut supervisor = stopped_by(StopCategory::ControlledHold);
    modes(&mut supervisor, 2 * HOLD);
    supervisor.release();
    for share in [0.25, 0.5, 0.75, 1.0, 1.0] {
        supervisor.accept_measurement(Ok(&[0.0; 2]));
        assert_eq!(supervisor.authority(), share);
        supervisor.gate(&[3.0; 2], &[0.0; 2]);
    }
}

#[test]
fn an_arm_rests_when_each_joint_rests() {
    let supervisor = supervisor();
    // A hundredth of 2 rad/s, and 1 mrad/s.
    for (qd, rests) in [
        ([0.0, 0.0], true),
        ([0.0209, -0.0209], true),
        ([0.0, 0.0211], false),
        ([-0.0211, 0.0], false),
        ([0.0, f32::NAN], false),
    ] {
        assert_eq!(supervisor.at_rest(&qd), rests, "{qd:?}");
    }
}

#[test]
fn a_stop_within_a_tick_acts_in_it() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [3.0; 2]);
    supervisor.accept_measurement(Ok(&[0.0; 2]));
    supervisor.stop_by(Fault::External, StopCategory::ControlledHold);
    let status = supervisor.gate(&[3.0; 2], &[0.0; 2]).status;
    assert_eq!((status.mode, status.fault), (Mode::Hold, EXTERNAL));
}

#[test]
fn without_a_choice_a_stop_is_of_category_1() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [3.0; 2]);
    supervisor.react(Fault::External);
    let wanted = [Mode::Hold, Mode::Hold, Mode::Hold, Mode::Stopped];
    assert_eq!(modes(&mut supervisor, 4), wanted);
    // It has no damping either.
    assert_eq!(good(&mut supervisor, [3.0; 2]).torque, [0.0; 2]);
}
