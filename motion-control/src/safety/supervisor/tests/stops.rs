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
