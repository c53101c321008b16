//! Frames of drives in MIT mode: random ones, right ones of which bytes are replaced, and commands
//! of any numbers.

use super::bytes::Bytes;
use core::f64::consts::{PI, TAU};
use embedded_can::{ExtendedId, Frame, Id, StandardId};
use joint_drivers::can::{CanError, FdFrame};
use joint_drivers::mit::cubemars::{AK60_6, CubeMars};
use joint_drivers::mit::damiao::{DM4310, Damiao};
use joint_drivers::mit::robstride::{RS03, RobStride, RobStrideMit};
use joint_drivers::mit::{Reply, Scale, Setpoint, SetpointAt};
use joint_drivers::{JointMapping, JointRange, PdCanJoint};

/// The bytes of which [`can_frames`] makes one reply and one command.
pub const BYTES_PER_FRAME: usize = 24;

/// A protocol with right replies of drive 1 to host 2.
struct Case {
    seed: (u32, [u8; 8]),
    scale: Scale,
    most: f32,
    /// The last count of all quantities but the position.
    last: f64,
    /// The angle after which the count of positions begins again, rad.
    period: f64,
}

const CASES: [Case; 4] = [
    case(2, [17, 128, 18, 129, 40, 10, 40, 35], DM4310, [7.0, 4095.0, 25.0]),
    case(0x0280_0102, [128, 18, 128, 18, 128, 18, 1, 32], RS03, [40.0, 65535.0, 4.0 * TAU]),
    case(2, [1, 128, 18, 129, 40, 10, 1, 32], RS03, [40.0, 4095.0, 4.0 * TAU]),
    case(2, [1, 128, 18, 129, 40, 10, 70, 0], AK60_6, [9.0, 4095.0, 25.0]),
];

const fn case(id: u32, data: [u8; 8], scale: Scale, [most, last, period]: [f64; 3]) -> Case {
    Case { seed: (id, data), scale, most: most as f32, last, period }
}

/// The lengths of CAN FD.
const LENGTHS: [usize; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64];

/// Replies and commands of [`BYTES_PER_FRAME`] bytes each.
///
/// # Panics
/// If a reply of another sender is accepted, if one of another length or a remote frame has another
/// error, if a quantity of a reply is not finite or beyond its scale, if a position is not one of
/// its count, if a register is accepted that is none or has another scale, if a command is another
/// frame for its drive, or if its sum is beyond the greatest torque.
pub fn can_frames(bytes: &[u8]) {
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 3e-3);
    let mapping = mapping.expect("slower than its encoder");
    let made = "identity and limit are in their ranges";
    let mut damiao = Damiao::new(1, 2, DM4310, 7.0, mapping).expect(made);
    let mut own = RobStride::new(1, 2, RS03, 40.0, mapping).expect(made);
    let mut mit = RobStrideMit::new(1, 2, RS03, 40.0, mapping).expect(made);
    let mut cubemars = CubeMars::new(1, 2, AK60_6, 9.0, mapping).expect(made);
    let made = (damiao, own, mit, cubemars);
    let mut before = [None; 4];
    for chunk in bytes.chunks_exact(BYTES_PER_FRAME) {
        let from = &mut Bytes(chunk);
        let which = from.below(CASES.len());
        let (case, frame) = (&CASES[which], reply(&CASES[which], from));
        let setpoint = setpoint(&mut Bytes(chunk.get(1..).unwrap_or_default()));
        let (answer, command) = match which {
            0 => {
                let (answer, register) = (damiao.reply(&frame), damiao.register(&frame));
                assert!(answer.is_err() || register.is_err(), "{frame:?}");
                check_register(&frame, register, damiao.check_register(&frame));
                (answer, damiao.pd_command(&setpoint))
            }
            1 => (own.reply(&frame), own.pd_command(&setpoint)),
            2 => (mit.reply(&frame), mit.pd_command(&setpoint)),
            _ => (cubemars.reply(&frame), cubemars.pd_command(&setpoint)),
        };
        if answer == Err(CanError::LostTurn) {
            // Its count has jumped: it is made anew.
            before[which] = None;
            match which {
                0 => damiao = made.0,
                1 => own = made.1,
                2 => mit = made.2,
                _ => cubemars = made.3,
            }
            continue;
        }
        let command = command.expect("a frame of up to 64 bytes holds a command");
        // It is that of the turn of this reply.
        before[which] = check_reply(which, &frame, answer, before[which]);
        check_command(case, &command, &setpoint, before[which]);
    }
}

/// A reply of which some bits or bytes were replaced, of another length, one of random bytes, a
/// register or a remote frame.
fn reply(case: &Case, from: &mut Bytes<'_>) -> FdFrame {
    let (mut raw, seed) = case.seed;
    let (mut length, mut is_remote) = (8, false);
    let mut data = [0; 64];
    data[..8].copy_from_slice(&seed);
    match from.below(8) {
        0 | 1 => data[..8].fill_with(|| from.byte()),
        2 => raw ^= 1 << from.below(29),
        3 => length = LENGTHS[from.below(16)],
        4 => (length, is_remote) = (from.below(9), true),
        5 => {
            let register = [10, 20, 21, 22, 23, 24][from.below(6)];
            let [a, b, c, d] =
                f32::to_le_bytes([12.5, 30.0, 10.0, f32::from_bits(1)][from.below(4)]);
            data[..8].copy_from_slice(&[1, 0, 0x33, register, a, b, c, d]);
        }
        _ => {}
    }
    for _ in 0..from.below(4) {
        let (place, byte) = (from.below(8), from.byte());
        data[place] = byte;
    }
    let id: Id = if raw > 0x7ff {
        ExtendedId::new(raw).expect("29 bits").into()
    } else {
        StandardId::new(raw as u16).expect("11 bits").into()
    };
    let frame =
        if is_remote { FdFrame::new_remote(id, length) } else { FdFrame::new(id, &data[..length]) };
    frame.expect("one of the lengths")
}

fn check_register(
    frame: &FdFrame,
    register: Result<(u8, [u8; 4]), CanError>,
    checked: Result<u8, CanError>,
) {
    let data = frame.data();
    let is_one = matches!(data, [1, 0, 0x33, ..]) && data.len() == 8 && is_addressed(0, frame.id());
    let Ok((register, value)) = register else {
        assert!(!is_one && checked == register.map(|(register, _)| register), "{frame:?}");
        return;
    };
    assert!(is_one && register == data[3] && value == data[4..], "{frame:?}");
    let scale = [(21, DM4310.position), (22, DM4310.velocity), (23, DM4310.torque)];
    let scale = scale.into_iter().find(|(of, _)| *of == register);
    let off = scale.map(|(_, most)| (f32::from_le_bytes(value) - most).abs() / most);
    // The register of the mode is 1.
    let is_right = (register == 10 && value == [1, 0, 0, 0]) || off.is_some_and(|off| off <= 1e-6);
    assert_eq!(checked.is_ok(), is_right, "{frame:?}");
}

fn setpoint(from: &mut Bytes<'_>) -> SetpointAt {
    let mut number = || from.number() as f32;
    let [position, velocity, torque] = [number(), number(), number()];
    let [kp, kd] = [number() * 20.0, number()];
    let sum = Setpoint { position, velocity, kp, kd, torque };
    // Near the setpoint, where the rest is within the scale, more often than anywhere.
    let away = [number(), number()];
    SetpointAt { sum, position: position + 0.1 * away[0], velocity: velocity + away[1] }
}

/// A joint and its drive.
#[derive(Clone, Copy, Debug)]
struct Place {
    joint: f32,
    /// The angle of the joint less that of the drive, in the drive's first scale.
    turns: f64,
}

/// The place in an accepted reply, else the last one.
fn check_reply(
    which: usize,
    frame: &FdFrame,
    answer: Result<Reply, CanError>,
    before: Option<Place>,
) -> Option<Place> {
    let state = match answer {
        Err(CanError::Bus(_) | CanError::Full | CanError::NoReply | CanError::NotReady) => {
            panic!("{answer:?} is not an error of a frame")
        }
        Err(error) => {
            let wrong = match (frame.is_remote_frame(), frame.data().len()) {
                (true, _) => Some(CanError::Remote),
                (false, 0..8) => Some(CanError::Short),
                (false, 8) => None,
                (false, length) => Some(CanError::Length(length)),
            };
            let of_us = is_addressed(which, frame.id());
            assert!(!of_us || wrong.is_none_or(|wrong| wrong == error), "{frame:?} {error}");
            return before;
        }
        Ok(reply) => {
            assert!(is_sender(which, frame), "{frame:?}");
            let Reply::State(state) = reply else { return before };
            state
        }
    };
    let scale = &CASES[which].scale;
    let within = |quantity: f32, most: f32| quantity.abs() <= most * (1.0 + 1e-6);
    assert!(within(state.velocity, scale.velocity), "{state:?}");
    assert!(within(state.torque, scale.torque), "{state:?}");
    let temperatures = [state.motor_temperature, state.drive_temperature];
    assert!(temperatures.into_iter().flatten().all(f32::is_finite));
    // At first it is within half a turn of zero, whole turns from its count; later it goes on by
    // less than half a turn, and is whole scales from there. All but the rounding in f32.
    let (joint, turns) = (state.position, turns(which, frame, state.position));
    let free = 1e-5 + 1e-6 * f64::from(joint.abs());
    let off = |angle: f64, whole: f64| (angle - whole * (angle / whole).round()).abs();
    let Some(before) = before else {
        assert!(f64::from(joint.abs()) <= PI + free && off(turns, TAU) <= free, "{state:?}");
        return Some(Place { joint, turns });
    };
    assert!((joint - before.joint).abs() <= 3.15, "{state:?} {before:?}");
    let off = off(turns - before.turns, CASES[which].period);
    assert!(off <= free, "{off} {state:?} {before:?}");
    Some(Place { joint, ..before })
}

/// The whole turns between a joint and the count of its drive.
fn turns(which: usize, frame: &FdFrame, joint: f32) -> f64 {
    let [d0, d1, d2, ..] = frame.data() else { panic!("accepted {frame:?}") };
    let count = if which == 1 { [*d0, *d1] } else { [*d1, *d2] };
    let count = f64::from(u16::from_be_bytes(count));
    f64::from(joint) - signed(count, CASES[which].scale.position, 65535.0)
}

fn signed(count: f64, most: f32, last: f64) -> f64 {
    (2.0 * count / last - 1.0) * f64::from(most)
}

/// Whether an identifier is that of a reply to host 2, and by its own protocol of drive 1.
fn is_addressed(which: usize, id: Id) -> bool {
    match (which, id) {
        (1, Id::Extended(id)) => {
            id.as_raw() & 0xffff == 0x0102 && [2, 21, 24].contains(&(id.as_raw() >> 24))
        }
        (0 | 2 | 3, Id::Standard(id)) => id.as_raw() == 2,
        _ => false,
    }
}

/// Whether drive 1 sent the frame to host 2.
fn is_sender(which: usize, frame: &FdFrame) -> bool {
    let data = frame.data();
    let names_it = match which {
        0 => data.first().is_some_and(|first| first & 0x0f == 1),
        1 => true,
        _ => data.first() == Some(&1),
    };
    data.len() == 8 && names_it && is_addressed(which, frame.id())
}

fn check_command(case: &Case, frame: &FdFrame, setpoint: &SetpointAt, place: Option<Place>) {
    let data: [u8; 8] = frame.data().try_into().expect("8 bytes");
    let all = u64::from_be_bytes(data);
    let counts = match frame.id() {
        Id::Standard(id) => {
            assert_eq!(id.as_raw(), 1);
            [all >> 48, all >> 36 & 0xfff, all >> 24 & 0xfff, all >> 12 & 0xfff, all & 0xfff]
        }
        Id::Extended(id) => {
            let id = u64::from(id.as_raw());
            assert_eq!(id & 0x1f00_00ff, 0x0100_0001);
            [all >> 48, all >> 32 & 0xffff, all >> 16 & 0xffff, all & 0xffff, id >> 8 & 0xffff]
        }
    };
    // Frames without quantities begin with the last count.
    assert!(counts[0] != 0 && counts[0] != 0xffff);
    let [position, velocity, kp, kd, torque] = counts.map(|count| count as f64);
    let torque = signed(torque, case.scale.torque, case.last);
    let kp = kp / case.last * f64::from(case.scale.kp);
    let kd = kd / case.last * f64::from(case.scale.kd);
    let mut sum = torque;
    if kp + kd > 0.0 {
        let [q, qd] = [setpoint.position, setpoint.velocity].map(f64::from);
        let Place { turns, .. } = place.expect("gains before the first reply");
        sum += kp * (signed(position, case.scale.position, 65535.0) + turns - q);
        sum += kd * (signed(velocity, case.scale.velocity, case.last) - qd);
    }
    // Half a count, and the rounding in f32 of the angle that the joint has come to.
    let angle = 1e-5 + 1e-6 * place.map_or(0.0, |place| f64::from(place.joint.abs()));
    let free = f64::from(case.scale.torque) * (1.0 / case.last + 1e-6) + angle * (kp + kd);
    let wanted = f64::from(setpoint.sum.torque.clamp(-case.most, case.most));
    let wanted = if wanted.is_nan() { 0.0 } else { wanted };
    assert!((sum - wanted).abs() <= free + 1e-5 * wanted.abs(), "{sum} {setpoint:?} {frame:?}");
}
