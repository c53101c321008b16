//! Stop categories.

use super::*;
use crate::safety::StopCategory;

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
    // The arm is stopped already.
    assert_eq!(sinks(&mut supervisor, [-1.0, 1.0]), [2.0, 0.0]);
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
fn without_a_choice_a_stop_is_of_category_1() {
    let chosen = supervisor().with_stop(StopCategory::ControlledOff);
    assert_eq!(supervisor(), chosen);
}
