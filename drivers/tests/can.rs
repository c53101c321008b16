//! The promises of the drivers on CAN: golden frames, and a typed error for each wrong reply.

use core::f32::consts::{PI, TAU};

use embedded_can::{ExtendedId, Frame, StandardId};
use joint_drivers::can::{CanError, ClassicFrame, FdFrame};
use joint_drivers::moteus::{Mode, Moteus};
use joint_drivers::odrive::{AxisState, ODrive, Reply};
use joint_drivers::{Direction, EncoderMapping, JointMapping, JointRange};

use super::{identity, near_zero};

pub(super) fn classic(frame: &FdFrame) -> ClassicFrame {
    ClassicFrame::new(frame.id(), frame.data()).unwrap()
}

pub(super) fn standard(id: u16, data: &[u8]) -> FdFrame {
    FdFrame::new(StandardId::new(id).unwrap(), data).unwrap()
}

pub(super) fn extended(id: u32, data: &[u8]) -> FdFrame {
    FdFrame::new(ExtendedId::new(id).unwrap(), data).unwrap()
}

fn geared() -> EncoderMapping {
    near_zero(JointMapping::new(1.0, Direction::Reverse, 2.0).unwrap())
}

fn near(a: f32, b: f32) -> bool {
    (a - b).abs() < 1e-5 * b.abs().max(1.0)
}

#[test]
fn odrive_commands_are_the_protocols_golden_frames() {
    let axis = ODrive::new(1, 100.0, identity()).unwrap();
    let closed_loop = AxisState::ClosedLoopControl;
    // The identifier of axis 1, command 0x0C, is 0x2C in the document: commands of axis 1 begin at
    // 0x20.
    let golden: [(Result<ClassicFrame, _>, u16, &[u8]); 7] = [
        (axis.set_torque(1.5), 0x2e, &[0x00, 0x00, 0xc0, 0x3f]),
        (axis.set_torque(-0.1), 0x2e, &[0xcd, 0xcc, 0xcc, 0xbd]),
        (axis.set_torque_mode(), 0x2b, &[1, 0, 0, 0, 1, 0, 0, 0]),
        (axis.set_state(closed_loop), 0x27, &[8, 0, 0, 0]),
        (axis.set_state(AxisState::Idle), 0x27, &[1, 0, 0, 0]),
        (axis.stop(), 0x22, &[]),
        (axis.clear_errors(), 0x38, &[0]),
    ];
    for (frame, id, data) in golden {
        assert_eq!(frame, Ok(classic(&standard(id, data))));
    }
    for (request, id) in [(axis.request_estimates(), 0x29), (axis.request_torques(), 0x3c)] {
        let remote: ClassicFrame = request.unwrap();
        assert!(remote.is_remote_frame());
        assert_eq!(remote.id(), StandardId::new(id).unwrap().into());
    }
}

#[test]
fn odrive_replies_are_mapped_to_the_joint() {
    // The motor's encoder says where it is within half a turn of the joint.
    let near_it = geared().mapping().with_range(JointRange::Near(-4.0), 1e-3);
    let mut axis = ODrive::new(0, 100.0, near_it.unwrap()).unwrap();
    // The heartbeat that the documentation of odrive-can encodes: error 1, state 11, homing.
    let heartbeat = standard(0x001, &[1, 0, 0, 0, 0x0b, 0, 0, 0]);
    let expected = Reply::Heartbeat { errors: 1, state: AxisState::Other(11) };
    assert_eq!(axis.reply(&heartbeat), Ok(expected));
    let running = Reply::Heartbeat { errors: 0x4000_0000, state: AxisState::ClosedLoopControl };
    let heartbeat = standard(0x001, &[0, 0, 0, 0x40, 8, 0, 1, 0]);
    assert_eq!(axis.reply(&heartbeat), Ok(running));
    // 1.5 rev and −0.25 rev/s.
    let estimates = standard(0x009, &[0, 0, 0xc0, 0x3f, 0, 0, 0x80, 0xbe]);
    let Ok(Reply::Estimates { position, velocity }) = axis.reply(&estimates) else {
        panic!("not estimates");
    };
    assert!(near(position, (1.0 - 1.5 * TAU) / 2.0) && near(velocity, PI / 4.0));
    // 2 N·m and −0.5 N·m at the motor.
    let torques = standard(0x01c, &[0, 0, 0, 0x40, 0, 0, 0, 0xbf]);
    let (target, estimate) = (-4.0, 1.0);
    let expected = Reply::Torques { target, estimate };
    assert_eq!(axis.reply(&torques), Ok(expected));
    let command: FdFrame = axis.set_torque(3.0).unwrap();
    assert_eq!(command.data(), (-1.5_f32).to_le_bytes());
}

#[test]
fn every_wrong_reply_of_an_odrive_is_a_typed_error() {
    let mut axis = ODrive::new(3, 100.0, identity()).unwrap();
    let nan = [[0, 0, 0xc0, 0x7f], [0; 4]].concat();
    let infinite = [[0; 4], [0, 0, 0x80, 0xff]].concat();
    let huge = [f32::MAX.to_le_bytes(), [0; 4]].concat();
    let cases = [
        (standard(0x009, &[0; 8]), CanError::Identifier), // node 0
        (standard(0x089, &[0; 8]), CanError::Identifier), // node 4
        (standard(0x06e, &[0; 8]), CanError::Identifier), // a command, not a reply
        (extended(0x069, &[0; 8]), CanError::Identifier),
        (standard(0x069, &[0; 7]), CanError::Short),
        (standard(0x069, &[0; 4]), CanError::Short),
        (standard(0x061, &[0; 5]), CanError::Short),
        (standard(0x07c, &[]), CanError::Short),
        (standard(0x069, &nan), CanError::NotFinite),
        (standard(0x069, &infinite), CanError::NotFinite),
        (standard(0x069, &huge), CanError::NotFinite), // not finite in rad
        (standard(0x07c, &nan), CanError::NotFinite),
    ];
    let remote = FdFrame::new_remote(StandardId::new(0x069).unwrap(), 8).unwrap();
    for (frame, error) in cases.into_iter().chain([(remote, CanError::Remote)]) {
        assert_eq!(axis.reply(&frame), Err(error), "{frame:?}");
    }
}

#[test]
fn torques_are_limited_and_nan_becomes_zero() {
    let axis = ODrive::new(3, 2.0, identity()).unwrap();
    let joint = Moteus::new(3, 0, 2.0, identity()).unwrap();
    for (torque, sent) in [(f32::NAN, 0.0_f32), (9.0, 2.0), (f32::NEG_INFINITY, -2.0)] {
        let frame: FdFrame = axis.set_torque(torque).unwrap();
        assert_eq!(frame.data(), sent.to_le_bytes());
        let frame: FdFrame = joint.set_torque(torque).unwrap();
        assert_eq!(frame.data()[9..13], sent.to_le_bytes());
    }
}

#[test]
fn nodes_and_limits_outside_their_ranges_are_refused() {
    assert_eq!(ODrive::new(0x40, 1.0, identity()), Err(CanError::Node));
    for node in [0, 0x3f] {
        assert!(ODrive::new(node, 1.0, identity()).is_ok());
    }
    for (id, host) in [(1, 0), (127, 0), (1, 127)] {
        assert!(Moteus::new(id, host, 1.0, identity()).is_ok());
    }
    for (id, host) in [(0, 0), (128, 0), (1, 128)] {
        assert_eq!(Moteus::new(id, host, 1.0, identity()), Err(CanError::Node));
    }
    for most in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(ODrive::new(1, most, identity()), Err(CanError::Torque));
        assert_eq!(Moteus::new(1, 0, most, identity()), Err(CanError::Torque));
    }
}

#[test]
fn commands_of_the_moteus_are_golden_frames_of_registers() {
    let joint = Moteus::new(1, 0, 100.0, identity()).unwrap();
    let command = [
        0x01, 0x00, 0x0a, // write 1 int8: mode = position
        0x02, 0x20, 0x80, 0x00, // write 2 int8: position = the present one, velocity = 0
        0x0d, 0x22, 0x00, 0x00, 0xc0, 0x3f, // write 1 f32: feed-forward torque = 1.5 N·m
        0x02, 0x23, 0x00, 0x00, // write 2 int8: scales of kp and kd = 0
        0x11, 0x00, 0x1f, 0x01, 0x11, 0x0f, // read mode; position, velocity, torque; fault
        0x50, // padding
    ];
    assert_eq!(joint.set_torque(1.5), Ok(extended(0x8001, &command)));
    let stop = [1, 0, 0, 0x11, 0, 0x1f, 1, 0x11, 0x0f, 0x50, 0x50, 0x50];
    assert_eq!(joint.stop(), Ok(extended(0x8001, &stop)));
    let other = Moteus::new(0x7f, 0x12, 100.0, geared()).unwrap();
    let query = [0x11, 0x00, 0x1f, 0x01, 0x11, 0x0f];
    assert_eq!(other.query(), Ok(extended(0x927f, &query)));
    let mapped: FdFrame = other.set_torque(3.0).unwrap();
    assert_eq!(mapped.data()[9..13], (-1.5_f32).to_le_bytes());
}

#[test]
fn moteus_commands_are_too_long_for_classic_can() {
    let joint = Moteus::new(1, 0, 100.0, identity()).unwrap();
    let torque = joint.set_torque::<ClassicFrame>(1.0);
    assert_eq!(torque, Err(CanError::Length(24)));
    assert_eq!(joint.stop::<ClassicFrame>(), Err(CanError::Length(12)));
    assert!(joint.query::<ClassicFrame>().is_ok());
}

/// The reply to a query: mode and fault as int8, three f32.
fn moteus_reply(mode: u8, values: [f32; 3], fault: u8) -> Vec<u8> {
    let values = values.map(f32::to_le_bytes).concat();
    [&[0x21, 0x00, mode, 0x2f, 0x01][..], &values, &[0x21, 0x0f, fault]].concat()
}

#[test]
fn moteus_replies_of_every_type_are_mapped_to_the_joint() {
    let mut joint = Moteus::new(1, 0, 100.0, identity()).unwrap();
    // The document's example: position 2.88°, velocity 23.04°/s, torque −1.44 N·m, as int16.
    let golden = [0x24, 4, 0, 0x0a, 0, 0x50, 0, 0, 1, 0x70, 0xff, 0x23, 0x0d, 0x18, 0x14, 0];
    // The same as int32, with the count in the type, and as int8 where the resolution allows it.
    let mut wide = vec![0x2b, 1, 0x20, 3, 0, 0, 0, 0x19, 0, 0, 0x60, 0xfa, 0xff, 0xff];
    wide.extend([0x50, 0x21, 0, 10, 0x20, 1, 0x0f, 0]);
    wide.resize(24, 0x50);
    for data in [&golden[..], &wide] {
        for frame in [standard(0x100, data), extended(0x100, data)] {
            let state = joint.reply(&frame).unwrap();
            assert_eq!((state.mode, state.fault), (Mode::Position, 0));
            assert!(near(state.position.to_degrees(), 2.88));
            assert!(near(state.velocity.to_degrees(), 23.04));
            assert!(near(state.torque, -1.44));
        }
    }
    // Registers that were not queried are skipped, whatever their type.
    for (kind, size) in [(0x21, 1), (0x25, 2), (0x29, 4), (0x2d, 4)] {
        let mut data =
            [&[kind, 0x0d][..], &vec![0x30; size], &moteus_reply(10, [0.5; 3], 0)].concat();
        data.resize(32, 0x50);
        let state = joint.reply(&standard(0x100, &data)).unwrap();
        assert!(near(state.position, PI));
    }
    let mut geared = Moteus::new(1, 0, 100.0, geared()).unwrap();
    let data = moteus_reply(1, [0.25, -0.5, 2.0], 33);
    let state = geared.reply(&standard(0x100, &data)).unwrap();
    assert!(near(state.position, (1.0 - 0.25 * TAU) / 2.0));
    assert!(near(state.velocity, PI / 2.0) && near(state.torque, -4.0));
    assert_eq!((state.mode, state.fault), (Mode::Fault, 33));
}

#[test]
fn every_wrong_reply_of_a_moteus_is_a_typed_error() {
    let mut joint = Moteus::new(1, 2, 100.0, identity()).unwrap();
    let good = moteus_reply(10, [0.0; 3], 0);
    assert!(joint.reply(&standard(0x102, &good)).is_ok());
    for id in [0x100, 0x202, 0x201, 0x002] {
        assert_eq!(joint.reply(&standard(id, &good)), Err(CanError::Identifier));
    }
    let other = joint.reply(&extended(0x1_0102, &good));
    assert_eq!(other, Err(CanError::Identifier));
    for (at, error) in [
        (4, CanError::Short),
        (8, CanError::Short),
        (3, CanError::Missing(1)),
        (0, CanError::Missing(1)),
    ] {
        let cut = joint.reply(&standard(0x102, &good[..at]));
        assert_eq!(cut, Err(error), "{at}");
    }
    for place in 0..3 {
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut values = [0.0; 3];
            values[place] = value;
            let frame = standard(0x102, &moteus_reply(10, values, 0));
            assert_eq!(joint.reply(&frame), Err(CanError::NotFinite));
        }
    }
    let refused = |register, code| CanError::Register { register, code };
    let cases: [(&[u8], CanError); 9] = [
        (&[0x25, 0x02, 0x00, 0x80], CanError::NotFinite),
        (&[0x29, 0x03, 0, 0, 0, 0x80], CanError::NotFinite),
        (&[0x2d, 0x00, 0, 0, 0xc0, 0x7f], CanError::NotFinite),
        (&[0x21, 0x01, 0x80], CanError::NotFinite),
        (&[0x31, 0x05, 0x03], refused(5, 3)),
        (&[0x30, 0x82, 0x01, 0x04], refused(0x82, 4)),
        (&[0x40], CanError::Unknown(0x40)),
        (&[0x20, 255, 255, 255, 255, 255], CanError::Unknown(0x80)),
        (&[0x2c, 0xff, 0xff, 0xff, 0x7f, 0x40], CanError::Short),
    ];
    for (data, error) in cases {
        assert_eq!(joint.reply(&standard(0x102, data)), Err(error), "{data:x?}");
    }
    let remote = FdFrame::new_remote(StandardId::new(0x102).unwrap(), 8).unwrap();
    assert_eq!(joint.reply(&remote), Err(CanError::Remote));
}

#[test]
fn no_reply_bytes_panic_or_give_nonfinite_quantities() {
    let (axis, joint) =
        (ODrive::new(1, 1.0, identity()).unwrap(), Moteus::new(1, 0, 1.0, identity()).unwrap());
    let mut random = 7_u32;
    let mut next = || {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        random >> 16
    };
    let mut decoded = 0;
    for _ in 0..200_000 {
        // Anew each time: a position that is random does not go on from the one before.
        let (mut axis, mut joint) = (axis, joint);
        let length = [8, 12, 20, 24][next() as usize % 4];
        let mut data: Vec<u8> = (0..length).map(|_| next() as u8).collect();
        match next() % 3 {
            0 => data.iter_mut().for_each(|byte| *byte &= 0x2f),
            1 => {
                let changed = next() as usize % 20;
                data = moteus_reply(10, [1.0; 3], 0);
                data[changed] = next() as u8;
            }
            _ => {}
        }
        if let Ok(state) = joint.reply(&standard(0x100, &data)) {
            let values = [state.position, state.velocity, state.torque];
            assert!(values.iter().all(|value| value.is_finite()));
            decoded += 1;
        }
        data.truncate(8);
        if let Ok(Reply::Estimates { position, velocity }) = axis.reply(&standard(0x029, &data)) {
            assert!(position.is_finite() && velocity.is_finite());
        }
    }
    assert!(decoded > 10_000);
}
