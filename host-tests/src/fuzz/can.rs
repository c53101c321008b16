//! Frames of drives in MIT mode: random ones, right ones of which bytes are replaced, and commands
//! of any numbers.

use super::bytes::Bytes;
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
}

const CASES: [Case; 4] = [
    Case { seed: (2, [17, 128, 18, 129, 40, 10, 40, 35]), scale: DM4310, most: 7.0, last: 4095.0 },
    Case {
        seed: (0x0280_0102, [128, 18, 128, 18, 128, 18, 1, 32]),
        scale: RS03,
        most: 40.0,
        last: 65535.0,
    },
    Case { seed: (2, [1, 128, 18, 129, 40, 10, 1, 32]), scale: RS03, most: 40.0, last: 4095.0 },
    Case { seed: (2, [1, 128, 18, 129, 40, 10, 70, 0]), scale: AK60_6, most: 9.0, last: 4095.0 },
];

/// Replies and commands of [`BYTES_PER_FRAME`] bytes each.
///
/// # Panics
/// If a reply of another sender is accepted, if a quantity of a reply is not finite or beyond its
/// scale, if a command is another frame for its drive, or if its sum is beyond the greatest torque.
pub fn can_frames(bytes: &[u8]) {
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 3e-3);
    let mapping = mapping.expect("slower than its encoder");
    let made = "identity and limit are in their ranges";
    let mut damiao = Damiao::new(1, 2, DM4310, 7.0, mapping).expect(made);
    let mut own = RobStride::new(1, 2, RS03, 40.0, mapping).expect(made);
    let mut mit = RobStrideMit::new(1, 2, RS03, 40.0, mapping).expect(made);
    let mut cubemars = CubeMars::new(1, 2, AK60_6, 9.0, mapping).expect(made);
    let mut before = [None; 4];
    for chunk in bytes.chunks_exact(BYTES_PER_FRAME) {
        let from = &mut Bytes(chunk);
        let which = from.below(CASES.len());
        let (case, frame) = (&CASES[which], reply(&CASES[which], from));
        let setpoint = setpoint(&mut Bytes(chunk.get(1..).unwrap_or_default()));
        let (answer, command) = match which {
            0 => (damiao.reply(&frame), damiao.pd_command(&setpoint)),
            1 => (own.reply(&frame), own.pd_command(&setpoint)),
            2 => (mit.reply(&frame), mit.pd_command(&setpoint)),
            _ => (cubemars.reply(&frame), cubemars.pd_command(&setpoint)),
        };
        let command = command.expect("a frame of up to 64 bytes holds a command");
        // It is that of the turn of this reply.
        before[which] = check_reply(which, &frame, answer, before[which]);
        check_command(case, &command, &setpoint, before[which]);
    }
}

/// A reply of which some bits or bytes were replaced, or one of random bytes.
fn reply(case: &Case, from: &mut Bytes<'_>) -> FdFrame {
    let (mut raw, mut data) = case.seed;
    let mut length = 8;
    match from.below(4) {
        0 => data = core::array::from_fn(|_| from.byte()),
        1 => raw ^= 1 << from.below(29),
        2 => length = from.below(9),
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
    FdFrame::new(id, &data[..length]).expect("up to 8 bytes")
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
        Err(_) => return before,
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
    // The count goes on by less than half of its scale.
    let first = Place { joint: state.position, turns: turns(which, frame, state.position) };
    let Place { joint, turns } = before.unwrap_or(first);
    assert!((state.position - joint).abs() <= scale.position + 0.01, "{state:?} {joint}");
    Some(Place { joint: state.position, turns })
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

/// Whether drive 1 sent the frame to host 2.
fn is_sender(which: usize, frame: &FdFrame) -> bool {
    let first = frame.data()[0];
    let is_whole = frame.data().len() == 8;
    is_whole
        && match (which, frame.id()) {
            (0, Id::Standard(id)) => id.as_raw() == 2 && first & 0x0f == 1,
            (1, Id::Extended(id)) => {
                id.as_raw() & 0xffff == 0x0102 && [2, 21, 24].contains(&(id.as_raw() >> 24))
            }
            (2 | 3, Id::Standard(id)) => id.as_raw() == 2 && first == 1,
            _ => false,
        }
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
