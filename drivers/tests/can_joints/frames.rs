//! Which frames a tick takes, and what is made of them.

use super::identity;
use super::*;

fn scripted(frames: &[nb::Result<FdFrame, ErrorKind>]) -> CanJoints<Bus, Moteus, 2> {
    joints(Bus { received: frames.iter().cloned().collect(), ..Bus::default() })
}

#[test]
fn a_tick_takes_what_has_come_and_no_more() {
    let [first, second] = [1, 2].map(|node| Ok(reply(node, 10, 0.0, 0)));
    let later = Ok(reply(1, 10, 0.25, 0));
    // Frames after a pause belong to the next tick.
    let pause = Err(nb::Error::WouldBlock);
    let joints = scripted(&[first, second, pause, later]);
    assert_eq!((&joints).read(), Ok([0.0; 2]));
    assert_eq!((&joints).read(), Err(at(1, CanError::NoReply)));
    assert_eq!(joints.unread(), [Ok(()), Err(CanError::NoReply)]);
    // The last of several replies counts.
    let all = [vec![first; 6], vec![second; 1], vec![later; 2]].concat();
    let joints = scripted(&all);
    assert_eq!((&joints).read(), Ok([core::f32::consts::FRAC_PI_2, 0.0]));
    assert_eq!((&joints).read(), Err(at(0, CanError::NoReply)));
    // A tick takes 64 frames and four of each joint: if there are more, its positions may be old.
    let joints = scripted(&[vec![first, second], vec![first; 71]].concat());
    let overrun = CanError::Bus(ErrorKind::Overrun);
    assert_eq!((&joints).read(), Err(at(0, overrun)));
    // The last one was left for the next tick, and was taken in it.
    assert_eq!((&joints).read(), Err(at(1, CanError::NoReply)));
    let left = joints.release().received;
    assert_eq!(left.len(), 0);
}

#[test]
fn a_bus_that_fails_gives_no_positions() {
    let error = ErrorKind::Acknowledge;
    let joints = scripted(&[Ok(reply(1, 10, 0.0, 0)), Err(nb::Error::Other(error))]);
    assert_eq!((&joints).read(), Err(at(0, CanError::Bus(error))));
    assert_eq!(joints.unread(), [Err(CanError::Bus(error)); 2]);
    // The position that had come before the error is not that of the next tick.
    assert_eq!((&joints).read(), Err(at(0, CanError::NoReply)));
}

#[test]
fn the_start_commands_zero_torque() {
    let joints = joints(Bus::default());
    (&joints).start();
    let sent = joints.release().sent;
    assert_eq!(sent, [torque_frame(1, 0.0), torque_frame(2, 0.0)]);
}

#[test]
fn the_first_joint_that_failed_is_named_else_the_first_not_ready() {
    assert_eq!(CanError::Fault(33).kind(), DriveFaultKind::Failed);
    assert_eq!(CanError::NotReady.kind(), DriveFaultKind::NotReady);
    let (ready, waiting, fault) = ((10, 0), (0, 0), (1, 33));
    let failed = |joint| Err(at(joint, CanError::Fault(33)));
    for (states, expected) in [
        ([ready, ready], Ok(())),
        ([waiting, waiting], Err(at(0, CanError::NotReady))),
        ([ready, waiting], Err(at(1, CanError::NotReady))),
        ([waiting, fault], failed(1)),
        ([fault, waiting], failed(0)),
        ([fault, fault], failed(0)),
        ([ready, fault], failed(1)),
    ] {
        let frame = |joint: usize| {
            let (mode, fault) = states[joint];
            Ok(reply(joint as u32 + 1, mode, 0.0, fault))
        };
        let joints = scripted(&[frame(0), frame(1)]);
        (&joints).read().unwrap();
        assert_eq!((&joints).set_torques(&[0.0; 2]), expected, "{states:?}");
    }
}

#[test]
fn a_frame_without_a_position_keeps_the_one_before() {
    let half = odrive_frame(0x09, HALF_A_TURN);
    let heartbeat = odrive_frame(0x01, [0, 0, 0, 0, 1, 0, 0, 0]);
    // The target and the torque of the axis: neither a position nor a state.
    let torques = odrive_frame(0x1c, [0; 8]);
    let waiting = Err(at(0, CanError::NotReady));
    // A bus hands out its last frame first.
    for frames in [
        [half, heartbeat, torques],
        [half, torques, heartbeat],
        [heartbeat, half, torques],
        [torques, half, heartbeat],
        [heartbeat, torques, half],
        [torques, heartbeat, half],
    ] {
        let axis = ODrive::new(3, 10.0, identity()).unwrap();
        let joints = CanJoints::new(heard(&frames), [axis]);
        assert_eq!((&joints).read(), Ok([core::f32::consts::PI]));
        assert_eq!((&joints).set_torques(&[0.0]), waiting);
        // The state is known until another is reported, the position in its tick alone.
        assert_eq!((&joints).read(), Err(at(0, CanError::NoReply)));
        assert_eq!((&joints).set_torques(&[0.0]), waiting);
    }
}
