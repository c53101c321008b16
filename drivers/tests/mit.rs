//! The promises of the drives in MIT mode: golden frames of each maker's document, a typed error
//! for each wrong reply, and nothing beyond a scale.

use core::f32::consts::{PI, TAU};

use embedded_can::Frame;
use joint_drivers::can::{CanError, ClassicFrame, Component, FdFrame};
use joint_drivers::mit::cubemars::{self, CubeMars};
use joint_drivers::mit::damiao::{self, Damiao};
use joint_drivers::mit::robstride::{self, RobStride, RobStrideMit};
use joint_drivers::mit::{AnyDrive, DriveState, Reply, Scale, Setpoint, SetpointAt};
use joint_drivers::{
    CanJoint, CanJoints, Direction, DriveFault, DriveFaultKind, EncoderMapping, JointDrives,
    JointEncoders, JointError, JointMapping, JointRange, Outbox,
};

mod law;
pub(crate) mod makers;
mod turns;

use super::can::{classic, extended, standard};
pub(crate) use super::damiao_bus::{Drive, decoded};
use super::{identity, near_zero};

type Sent = Result<FdFrame, CanError>;

fn damiao() -> Damiao {
    Damiao::new(1, 0x11, damiao::DM4310, 10.0, identity()).unwrap()
}

fn robstride() -> RobStride {
    RobStride::new(0x7f, 0xfd, robstride::RS03, 60.0, identity()).unwrap()
}

fn robstride_mit() -> RobStrideMit {
    RobStrideMit::new(0x7f, 0xfd, robstride::RS02, 17.0, identity()).unwrap()
}

fn cubemars() -> CubeMars {
    CubeMars::new(3, 3, cubemars::AK80_64, 144.0, identity()).unwrap()
}

fn state(reply: Result<Reply, CanError>) -> DriveState {
    match reply {
        Ok(Reply::State(state)) => state,
        other => panic!("{other:?}"),
    }
}

fn near(a: f32, b: f32) -> bool {
    (a - b).abs() < 1e-5 * b.abs().max(1.0)
}

/// A setpoint of the drive.
const fn setpoint([position, velocity, kp, kd, torque]: [f32; 5]) -> Setpoint {
    Setpoint { position, velocity, kp, kd, torque }
}

const FF: u8 = 0xff;

#[test]
fn frames_without_quantities_are_golden() {
    let last = |id, last| Ok(standard(id, &[FF, FF, FF, FF, FF, FF, FF, last]));
    let unknown: Sent = Err(CanError::Unknown(0xfb));
    let (d, m, c, r) = (damiao(), robstride_mit(), cubemars(), robstride());
    let of = |kind: u32, first| Ok(extended(kind << 24 | 0xfd7f, &[first, 0, 0, 0, 0, 0, 0, 0]));
    let golden: [(Sent, Sent); 18] = [
        (d.clear_errors(), last(0x001, 0xfb)),
        (d.enable(), last(0x001, 0xfc)),
        (d.disable(), last(0x001, 0xfd)),
        (d.set_zero(), last(0x001, 0xfe)),
        (m.clear_errors(), last(0x07f, 0xfb)),
        (m.enable(), last(0x07f, 0xfc)),
        (m.disable(), last(0x07f, 0xfd)),
        (m.set_zero(), last(0x07f, 0xfe)),
        (m.read_faults(), Ok(standard(0x07f, &[FF, FF, FF, FF, FF, FF, 0, 0xfb]))),
        (c.clear_errors(), unknown),
        (c.enable(), last(0x003, 0xfc)),
        (c.disable(), last(0x003, 0xfd)),
        (c.set_zero(), last(0x003, 0xfe)),
        // Types 3, 4, 4 with a one, and 6.
        (r.enable(), of(3, 0)),
        (r.disable(), of(4, 0)),
        (r.clear_errors(), of(4, 1)),
        (r.set_zero(), of(6, 1)),
        (d.read_register(damiao::PMAX), Ok(standard(0x7ff, &[1, 0, 0x33, 21, 0, 0, 0, 0]))),
    ];
    for (place, (sent, expected)) in golden.into_iter().enumerate() {
        assert_eq!(sent, expected, "{place}");
    }
}

#[test]
fn a_bus_takes_replies_in_any_order() {
    let numbered = |id: u8| Damiao::new(id, 0x10, damiao::DM4310, 5.0, identity()).unwrap();
    let joints = CanJoints::new(Outbox::<FdFrame, 3>::new(), [1, 2, 3].map(numbered));
    for order in [[1, 2, 3], [3, 2, 1], [2, 1, 3]] {
        for id in order {
            joints.receive(&standard(0x10, &[0x14, 0x90, 0, 0x80, 8, 0, 0, 0])); // a stranger's
            joints.receive(&standard(0x10, &[0x10 | id, 0x80 + id, 0, 0x80, 8, 0, 0, 0]));
        }
        let q = (&joints).read().unwrap();
        assert!(q[0] > 0.0 && q.is_sorted(), "{q:?}");
        let none = JointError { joint: 0, error: CanError::NoReply };
        assert_eq!((&joints).read(), Err(none));
    }
}

#[test]
fn a_bus_says_what_came_in_place_of_a_position() {
    let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [damiao()]);
    let data = [0x11, 0x80, 0, 0x80, 8, 0, 0, 0, 0, 0, 0, 0];
    let good = standard(0x11, &data[..8]);
    let at_the_end = standard(0x11, &[0x11, FF, FF, 0x80, 8, 0, 0, 0]);
    for (frame, error) in [
        (standard(0x12, &data[..8]), CanError::Identifier),
        (FdFrame::new_remote(good.id(), 8).unwrap(), CanError::Remote),
        (standard(0x11, &data[..7]), CanError::Short),
        (standard(0x11, &data), CanError::Length(12)),
        (at_the_end, CanError::Range),
    ] {
        joints.receive(&frame);
        assert_eq!((&joints).read(), Err(JointError { joint: 0, error }));
        // A position is worth more, before and after it.
        for frames in [[frame, good], [good, frame]] {
            frames.iter().for_each(|frame| joints.receive(frame));
            assert!((&joints).read().is_ok());
        }
    }
}

/// A drive's answer to a query: the registers of a DM4310, but for one.
fn answer(query: &FdFrame, other: Option<(u8, f32)>) -> FdFrame {
    let mut drive = Drive { host: 0x10, ..Drive::new(query.data()[0], damiao::DM4310) };
    match other {
        Some((damiao::MODE, mode)) => drive.mode = mode.to_bits(),
        Some((damiao::TMAX, torque)) => drive.scale.torque = torque,
        _ => {}
    }
    drive.take(query).expect("an answer")
}

#[test]
fn no_drive_of_a_bus_is_enabled_before_the_scales_and_modes_of_all_are_right() {
    use damiao::{MODE, PMAX, TMAX, VMAX};
    let numbered = |id: u8| Damiao::new(id, 0x10, damiao::DM4310, 5.0, identity()).unwrap();
    let drives = [numbered(1), numbered(2)].map(AnyDrive::from);
    let joints = CanJoints::new(Outbox::<FdFrame, 2>::new(), drives);
    let at = |joint, error| Err(JointError { joint, error });
    let missing = |register: u8| CanError::Missing(register.into());
    let queried = || match joints.commands() {
        [Some(query), None] => query,
        frames => panic!("{frames:?}"),
    };
    // Without an answer the same one again; one of another register does not count.
    for _ in 0..2 {
        assert_eq!(joints.enable(), at(0, missing(PMAX)));
        assert_eq!(queried(), numbered(1).read_register(PMAX).unwrap());
    }
    joints.receive(&standard(0x10, &[1, 0, 0x33, VMAX, 0, 0, 0xf0, 0x41]));
    // Velocity and position: the mode of a drive that was left in it.
    let left = (MODE, f32::from_bits(2));
    let registers = [PMAX, VMAX, TMAX, TMAX, MODE, MODE];
    let of_first = [PMAX, VMAX, TMAX, MODE].map(|register| (0, register));
    for (joint, register) in of_first.into_iter().chain(registers.map(|register| (1, register))) {
        let asked = joints.enable();
        // One that was wrong is asked for anew, and may have been set meanwhile.
        let wrong = [at(1, CanError::Scale(TMAX)), at(1, CanError::Mode(2))];
        let again = wrong.contains(&asked);
        assert!(again || asked == at(joint, missing(register)), "{asked:?}");
        let other = match (joint, register, again) {
            (1, TMAX, false) => Some((TMAX, 12.0)),
            (1, MODE, false) => Some(left),
            _ => None,
        };
        let answer = answer(&queried(), other);
        // Twice, as no drive does: it counts once.
        [answer; 2].iter().for_each(|answer| joints.receive(answer));
    }
    // An answer is no position, and no stranger's frame.
    let first = |error| JointError { joint: 0, error };
    assert_eq!((&joints).read(), Err(first(CanError::NoReply)));
    for (sent, last) in [(CanJoints::enable as fn(&_) -> _, 0xfc), (CanJoints::disable, 0xfd)] {
        sent(&joints).unwrap();
        // A second time there is no room.
        assert_eq!(sent(&joints), Err(first(CanError::Full)));
        for (id, frame) in [1, 2].into_iter().zip(joints.commands()) {
            let data = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, last];
            assert_eq!(frame, Some(standard(id, &data)));
        }
    }
}

/// Counts of commands by hand: (x + most) × last / (2 most), and gain × last / most.
#[test]
fn commands_are_golden() {
    // 12 bits: −10, 5 and 10 of 10 N·m are 0, 3071.25 and 4095; zero is half a count above 2047.5.
    for (torque, [high, low]) in
        [(0.0, [8, 0]), (5.0, [0x0b, FF]), (10.0, [0x0f, FF]), (-10.0, [0, 0])]
    {
        let frame: ClassicFrame = damiao().set_torque(torque).unwrap();
        assert_eq!(frame, classic(&standard(1, &[0x80, 0, 0x80, 0, 0, 0, high, low])));
    }
    let mut drive = damiao();
    drive.reply(&standard(0x11, &[0x11, 0x80, 0, 0x80, 0x08, 0, 30, 30])).unwrap();
    // 49151.25, 1023.75, 819, 1638, 1535.625.
    let frame: Sent = drive.command(&setpoint([6.25, -15.0, 100.0, 2.0, -2.5]));
    assert_eq!(frame, Ok(standard(1, &[0xbf, FF, 0x40, 0x03, 0x33, 0x66, 0x66, 0x00])));
    let mut drive = cubemars();
    drive.reply(&standard(3, &[3, 0x80, 0, 0x80, 0x08, 0, 70, 0])).unwrap();
    // 16383.75, 3071.25, 4095, 409.5 with its neighbour below, 2559.375.
    let frame: Sent = drive.command(&setpoint([-6.25, 4.0, 500.0, 0.4999, 36.0]));
    assert_eq!(frame, Ok(standard(3, &[0x40, 0x00, 0xbf, FF, FF, 0x19, 0x99, 0xff])));
    let mut drive = robstride_mit();
    drive.reply(&standard(0xfd, &[0x7f, 0x80, 0, 0x80, 0x08, 0, 1, 44])).unwrap();
    // 49151.25 of ±12.57, 1023.75 of ±44, 1638 of 500, 2457 of 5, 3071.25 of ±17.
    let frame: Sent = drive.command(&setpoint([6.285, -22.0, 200.0, 3.0, 8.5]));
    assert_eq!(frame, Ok(standard(0x7f, &[0xbf, FF, 0x40, 0x06, 0x66, 0x99, 0x9b, 0xff])));
    let mut drive = robstride();
    drive.reply(&extended(0x0280_7ffd, &[0x80, 0, 0x80, 0, 0x80, 0, 1, 44])).unwrap();
    // 16 bits: 16383.75, 49151.25, 6553.5 with its neighbour above, 13107, and 16383.75 in the
    // identifier.
    let frame: Sent = drive.command(&setpoint([-6.285, 10.0, 500.01, 20.0, -30.0]));
    let data = [0x40, 0x00, 0xbf, FF, 0x19, 0x9a, 0x33, 0x33];
    assert_eq!(frame, Ok(extended(0x0140_007f, &data)));
}

#[test]
fn replies_are_mapped_to_the_joint() {
    // The shaft turns twice for the joint, the other way round; it is at 1 rad where that is at 0.
    let geared = JointMapping::new(1.0, Direction::Reverse, 2.0).unwrap();
    let mut drive = Damiao::new(2, 0, damiao::DM8009, 80.0, near_zero(geared)).unwrap();
    // Counts 0xC000 = 49152, 0x400 = 1024, 0xC00 = 3072 of ±12.5, ±45, ±54.
    let feedback = [0x12, 0xc0, 0x00, 0x40, 0x0c, 0x00, 55, 41];
    let read = state(drive.reply(&standard(0, &feedback)));
    let [position, velocity, torque] = [
        49152.0 / 65535.0 * 25.0 - 12.5,
        1024.0 / 4095.0 * 90.0 - 45.0,
        3072.0 / 4095.0 * 108.0 - 54.0,
    ];
    // Within half a turn of the shaft from zero.
    assert!(near(read.position, (position - 1.0) / -2.0 + PI), "{read:?}");
    assert!(near(read.velocity, velocity / -2.0) && near(read.torque, torque * -2.0));
    assert_eq!((read.motor_temperature, read.drive_temperature), (Some(41.0), Some(55.0)));
    assert_eq!(read.status, Some(Ok(())));
    let sent: FdFrame = drive.set_torque(-54.0).unwrap();
    // +27 of ±54 at the shaft: 3071.25.
    assert_eq!(sent.data()[6..], [0x0b, 0xff]);
    // 16 bits, the private protocol: 25.7 °C, running.
    let feedback = [0xc0, 0x00, 0x40, 0x00, 0xc0, 0x00, 0x01, 0x01];
    let read = state(robstride().reply(&extended(0x0280_7ffd, &feedback)));
    assert!(near(read.position, 49152.0 / 65535.0 * 25.14 - 12.57 - TAU));
    assert!(near(read.velocity, 16384.0 / 65535.0 * 40.0 - 20.0));
    assert!(near(read.torque, 49152.0 / 65535.0 * 120.0 - 60.0));
    assert!(near(read.motor_temperature.unwrap(), 25.7) && read.drive_temperature.is_none());
    let active = robstride().reply(&extended(0x1880_7ffd, &feedback));
    assert_eq!(state(active), read);
    let feedback = [0x7f, 0xc0, 0x00, 0x40, 0x0c, 0x00, 0x01, 0x01];
    let read = state(robstride_mit().reply(&standard(0xfd, &feedback)));
    assert!(near(read.velocity, 1024.0 / 4095.0 * 88.0 - 44.0) && read.status.is_none());
    // −40 °C is the first count.
    let read = state(cubemars().reply(&standard(3, &[3, 0xc0, 0, 0x40, 0x0c, 0, 65, 0])));
    assert!(near(read.torque, 3072.0 / 4095.0 * 288.0 - 144.0));
    assert_eq!(read.motor_temperature, Some(25.0));
}

#[test]
fn every_fault_of_a_drive_is_typed_and_sorted() {
    use CanError::*;
    let [motor, drive] = [Component::Motor, Component::Drive].map(OverTemperature);
    let damiao_codes = [
        (0x0, Err(NotReady)),
        (0x1, Ok(())),
        (0x2, Err(Fault(2))),
        (0x8, Err(OverVoltage)),
        (0x9, Err(UnderVoltage)),
        (0xa, Err(OverCurrent)),
        (0xb, Err(drive)),
        (0xc, Err(motor)),
        (0xd, Err(LostCommunication)),
        (0xe, Err(Overload)),
        (0xf, Err(Fault(15))),
    ];
    for (code, status) in damiao_codes {
        let reply = damiao().reply(&standard(0x11, &[code << 4 | 1, 0x80, 0, 0x80, 8, 0, 30, 30]));
        assert_eq!(state(reply).status, Some(status), "{code:#x}");
        let failed = !matches!(status, Ok(()) | Err(NotReady));
        let kind = status.err().map(|error| error.kind());
        assert_eq!(kind == Some(DriveFaultKind::Failed), failed, "{code:#x}");
    }
    let codes = [Ok(()), Err(motor), Err(OverCurrent), Err(OverVoltage), Err(UnderVoltage)];
    let codes = codes.into_iter().chain([Err(Encoder), Err(drive), Err(Overload), Err(Fault(8))]);
    for (code, status) in codes.enumerate() {
        let reply = cubemars().reply(&standard(3, &[3, 0x80, 0, 0x80, 8, 0, 70, code as u8]));
        assert_eq!(state(reply).status, Some(status), "{code}");
    }
    // Bits 16 to 21 and the mode in bits 22 and 23 of a RobStride's identifier.
    let bits = [UnderVoltage, OverCurrent, motor, Encoder, Overload, Encoder].map(Err);
    let statuses = bits.into_iter().enumerate().map(|(bit, status)| (1 << bit | 2 << 6, status));
    let modes =
        [(0, Err(NotReady)), (1 << 6, Err(NotReady)), (2 << 6, Ok(())), (3 << 6, Err(NotReady))];
    for (bits, status) in statuses.chain(modes).chain([(0x87, Err(motor))]) {
        let id = 2 << 24 | bits << 16 | 0x7ffd;
        let reply = robstride().reply(&extended(id, &[0x80, 0, 0x80, 0, 0x80, 0, 1, 0]));
        assert_eq!(state(reply).status, Some(status), "{bits:#x}");
    }
    let words = [
        (0, Ok(())),
        (1 << 0, Err(motor)),
        (1 << 1, Err(Fault(2))),
        (1 << 2, Err(UnderVoltage)),
        (1 << 3, Err(OverVoltage)),
        (1 << 7, Err(Encoder)),
        (1 << 14, Err(Overload)),
        (1 << 4, Err(OverCurrent)),
        (1 << 9, Err(Encoder)),
        (1 << 16, Err(OverCurrent)),
        (1 << 16 | 1 << 14, Err(OverCurrent)),
        (1 << 31, Err(Fault(1 << 31))),
    ];
    for (word, status) in words {
        let [b0, b1, b2, b3] = u32::to_le_bytes(word);
        let reply = robstride().reply(&extended(0x1500_7ffd, &[b0, b1, b2, b3, 0, 0, 0, 0]));
        assert_eq!(reply, Ok(Reply::Status(status)), "{word:#x}");
        // A word with the last byte could be a feedback at 0.0 °C.
        if b3 == 0 {
            let reply = robstride_mit().reply(&standard(0xfd, &[0x7f, b0, b1, b2, b3, 0, 0, 0]));
            assert_eq!(reply, Ok(Reply::Status(status)), "{word:#x}");
        }
    }
}

#[test]
fn faults_that_a_drive_is_asked_for_stay_until_it_has_none() {
    let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [robstride_mit()]);
    let at = |joint, error| Err(JointError { joint, error });
    assert_eq!(joints.read_faults(1), at(1, CanError::Node));
    for (faults, expected) in [(1 << 3, at(0, CanError::OverVoltage)), (0, Ok(()))] {
        joints.read_faults(0).unwrap();
        // The one command of this outbox has no room beside it.
        assert_eq!(joints.read_faults(0), at(0, CanError::Full));
        assert_eq!(joints.commands(), [Some(robstride_mit().read_faults().unwrap())]);
        joints.receive(&standard(0xfd, &[0x7f, faults, 0, 0, 0, 0, 0, 0]));
        // A feedback says nothing of them.
        joints.receive(&standard(0xfd, &[0x7f, 0x90, 0, 0x80, 0x08, 0, 1, 44]));
        assert_eq!((&joints).set_torques(&[0.0]), expected);
        assert!(joints.commands()[0].is_some());
    }
}

/// Replies that a drive must refuse, of one that it must not.
fn refused(
    good: FdFrame,
    others: &[FdFrame],
    mut reply: impl FnMut(&FdFrame) -> Result<Reply, CanError>,
) {
    assert!(reply(&good).is_ok());
    let id = good.id();
    for other in others {
        assert_eq!(reply(other), Err(CanError::Identifier), "{other:?}");
    }
    for length in 0..8 {
        let cut = FdFrame::new(id, &good.data()[..length]).unwrap();
        assert_eq!(reply(&cut), Err(CanError::Short));
    }
    let long = [good.data(), &[0; 4]].concat();
    assert_eq!(reply(&FdFrame::new(id, &long).unwrap()), Err(CanError::Length(12)));
    assert_eq!(reply(&FdFrame::new_remote(id, 8).unwrap()), Err(CanError::Remote));
}

#[test]
fn every_wrong_reply_is_a_typed_error() {
    let data = [0x11, 0x80, 0, 0x80, 8, 0, 30, 30];
    let others = [
        standard(0x12, &data),
        standard(0x01, &data),
        extended(0x11, &data),
        standard(0x11, &[0x12, 0x80, 0, 0x80, 8, 0, 30, 30]), // of drive 2
        standard(0x11, &[1, 0, 0x33, 21, 0, 0, 0x48, 0x41]),  // a register
    ];
    let mut drive = damiao();
    refused(standard(0x11, &data), &others, |frame| drive.reply(frame));
    let data = [0x80, 0, 0x80, 0, 0x80, 0, 1, 0];
    let others = [0x0280_7efd, 0x0280_7ffc, 0x0180_7ffd, 0x0380_7ffd, 0x1180_7ffd, 0x1f80_7ffd];
    let others = others.map(|id| extended(id, &data));
    let others = [&others[..], &[standard(0x7fd, &data), standard(0xfd, &data)]].concat();
    let mut drive = robstride();
    refused(extended(0x0280_7ffd, &data), &others, |frame| drive.reply(frame));
    let data = [0x7f, 0x80, 0, 0x80, 8, 0, 1, 0];
    let other = [0x7e, 0x80, 0, 0x80, 8, 0, 1, 0];
    let others = [standard(0x7f, &data), extended(0xfd, &data), standard(0xfd, &other)];
    let mut drive = robstride_mit();
    refused(standard(0xfd, &data), &others, |frame| drive.reply(frame));
    let data = [3, 0x80, 0, 0x80, 8, 0, 70, 0];
    let other = [4, 0x80, 0, 0x80, 8, 0, 70, 0];
    let others = [standard(0, &data), extended(3, &data), standard(3, &other)];
    let mut drive = cubemars();
    refused(standard(3, &data), &others, |frame| drive.reply(frame));
}

#[test]
fn a_drive_of_other_scales_is_refused() {
    let drive = damiao();
    let of = |register: u8, value: f32| {
        let [b0, b1, b2, b3] = value.to_le_bytes();
        drive.check_register(&standard(0x11, &[1, 0, 0x33, register, b0, b1, b2, b3]))
    };
    for (register, value) in [(damiao::PMAX, 12.5), (damiao::VMAX, 30.0), (damiao::TMAX, 10.0)] {
        assert_eq!(of(register, value), Ok(register));
        for other in [value * 1.001, -value, f32::NAN, f32::INFINITY, 0.0] {
            assert_eq!(of(register, other), Err(CanError::Scale(register)));
        }
    }
    assert_eq!(of(damiao::TIMEOUT, 0.0), Err(CanError::Missing(9)));
    for data in
        [[2, 0, 0x33, 21, 0, 0, 0, 0], [1, 1, 0x33, 21, 0, 0, 0, 0], [1, 0, 0x55, 21, 0, 0, 0, 0]]
    {
        assert_eq!(drive.register(&standard(0x11, &data)), Err(CanError::Identifier));
    }
    assert_eq!(
        drive.register(&standard(0x12, &[1, 0, 0x33, 9, 0, 0, 0, 0])),
        Err(CanError::Identifier)
    );
}

#[test]
fn identities_limits_and_scales_outside_their_ranges_are_refused() {
    let new = |id, host| Damiao::new(id, host, damiao::DM4310, 10.0, identity()).err();
    assert_eq!([(1, 0), (15, 0x7ff)].map(|(id, host)| new(id, host)), [None; 2]);
    let node = Some(CanError::Node);
    assert_eq!([(0, 0), (16, 0), (1, 0x800)].map(|(id, host)| new(id, host)), [node; 3]);
    let new = |id, host| CubeMars::new(id, host, cubemars::AK60_6, 9.0, identity()).err();
    assert_eq!([(255, 0), (0, 0), (1, 0x800)].map(|(id, host)| new(id, host)), [None, node, node]);
    let new = |id, host| RobStride::new(id, host, robstride::RS05, 5.5, identity()).err();
    assert_eq!([(127, 255), (0, 1), (128, 1)].map(|(id, host)| new(id, host)), [None, node, node]);
    assert_eq!(new(1, 256), node);
    for most in [0.0, -1.0, f32::NAN, f32::INFINITY, 10.01] {
        let new = Damiao::new(1, 0, damiao::DM4310, most, identity());
        assert_eq!(new.err(), Some(CanError::Torque), "{most}");
    }
    for wrong in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        for scale in
            [Scale { kd: wrong, ..damiao::DM4310 }, Scale { position: wrong, ..damiao::DM4310 }]
        {
            assert_eq!(Damiao::new(1, 0, scale, 1.0, identity()).err(), Some(CanError::NotFinite));
        }
    }
}

#[test]
fn what_is_not_a_number_or_beyond_a_scale_is_never_sent() {
    let scale = damiao::DM4310;
    let mut drive = Damiao::new(1, 0x11, scale, 7.0, identity()).unwrap();
    let good = setpoint([1.0, 2.0, 50.0, 1.0, 3.0]);
    let send =
        |drive: &Damiao, setpoint: &Setpoint| decoded(&drive.command(setpoint).unwrap(), &scale);
    let gains = |[_, _, kp, kd, _]: [f64; 5]| (kp, kd);
    // Before the first reply the turn of the joint is not known.
    assert_eq!(gains(send(&drive, &good)), (0.0, 0.0));
    drive.reply(&standard(0x11, &[0x11, 0x80, 0, 0x80, 0x08, 0, 30, 30])).unwrap();
    let [_, _, kp, kd, torque] = send(&drive, &good);
    assert!((kp - 50.0).abs() < 0.07 && (kd - 1.0).abs() < 7e-4 && (torque - 3.0).abs() < 2.5e-3);
    let not_sent = [
        Setpoint { position: f32::NAN, ..good },
        Setpoint { position: f32::INFINITY, ..good },
        Setpoint { position: 12.6, ..good },
        Setpoint { position: -12.5, ..good },
        Setpoint { position: 1e30, ..good },
        Setpoint { velocity: f32::NAN, ..good },
        Setpoint { kp: f32::NAN, ..good },
        Setpoint { kp: -1.0, ..good },
        Setpoint { kd: f32::INFINITY, ..good },
        Setpoint { kd: -1.0, ..good },
    ];
    for setpoint in not_sent {
        let sent = send(&drive, &setpoint);
        assert_eq!(gains(sent), (0.0, 0.0), "{setpoint:?}");
        assert!((sent[4] - 3.0).abs() < 2.5e-3, "{setpoint:?}");
    }
    let nan = send(&drive, &Setpoint { torque: f32::NAN, ..good });
    assert!(gains(nan) == (0.0, 0.0) && nan[4].abs() < 2.5e-3);
    // Limits: the torque, and the ends of the scales.
    for (torque, most) in [(9.0, 7.0), (f32::INFINITY, 7.0), (-1e30, -7.0)] {
        assert!((send(&drive, &Setpoint { torque, ..good })[4] - most).abs() < 2.5e-3);
    }
    let fast = send(&drive, &Setpoint { velocity: -99.0, kp: 900.0, kd: 9.0, ..good });
    assert_eq!(fast[1..4], [-30.0, 500.0, 5.0]);
}

#[test]
fn the_sum_of_the_drive_is_the_torque_that_was_asked_for() {
    let scale = robstride::RS02;
    // A joint that the drive's shaft turns the other way round, 1.5 times.
    let mapping = JointMapping::new(0.3, Direction::Reverse, 1.5).unwrap();
    let mut drive = RobStrideMit::new(0x7f, 0xfd, scale, 20.0, near_zero(mapping)).unwrap();
    drive.reply(&standard(0xfd, &[0x7f, 0x90, 0, 0x80, 0x08, 0, 1, 44])).unwrap();
    let (mut with_gains, mut worst) = (0, 0.0_f64);
    for step in 0..20_000_u16 {
        let wave = |rate: f32| (f32::from(step) * rate).sin();
        let wanted = SetpointAt {
            sum: setpoint([
                wave(0.7),
                3.0 * wave(0.3),
                150.0 * wave(0.1).abs(),
                4.0,
                24.0 * wave(0.05),
            ]),
            position: 0.9 * wave(0.71),
            velocity: 4.0 * wave(0.9),
        };
        let [p, v, kp, kd, torque] = decoded(&drive.command_at(&wanted).unwrap(), &scale);
        let [q, qd] = [wanted.position * -1.5 + 0.3, wanted.velocity * -1.5].map(f64::from);
        let at_shaft = f64::from(wanted.sum.torque.clamp(-20.0, 20.0)) / -1.5;
        let sum = kp * (p - q) + kd * (v - qd) + torque;
        worst = worst.max((sum - at_shaft).abs());
        with_gains += usize::from(kp + kd > 0.0);
    }
    // Half a count of ±17 N·m is 4.15 mN·m.
    assert!(worst < 4.2e-3, "{worst}");
    // The gains are zero where the rest is beyond the scale.
    assert!((3_000..12_000).contains(&with_gains), "{with_gains}");
}
