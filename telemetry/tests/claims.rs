//! The claims of the crate about its queue, its frames and its decoder.

use dynamics_core::model::JointLimits;
use machine_link::{
    Axis, Counts, Decoder, EncodeError, FrameError, Joint, Machine, Message, Queue, Slots, Tick,
    VERSION, capacity, encode, split,
};
use motion_control::limits::{Fault, Mode, Status};

const JOINTS: usize = 6;
type Found = Result<Message<JOINTS>, FrameError>;

/// A tick whose bytes are of all kinds, zeros among them.
fn tick(number: u32) -> Tick<JOINTS> {
    let joint = |j: usize| Joint {
        reference: 0.5 * j as f32,
        estimate: 0.1 * j as f32 + 1e-3 * number as f32,
        torque: -12.5 + j as f32,
    };
    Tick {
        number,
        dropped: 0,
        tick: number / 3,
        status: Status { mode: Mode::Hold, fault: Some(Fault::Jump { joint: 4 }), limited: true },
        joints: (0..JOINTS).map(joint).collect(),
        cost: [80, 0, 90_000, 4, 5],
    }
}

fn machine() -> Machine<JOINTS> {
    let limits = JointLimits { lower: -6.3, upper: 6.3, velocity: 3.1, torque: 150.0 };
    let axis = Axis { limits, prismatic: false };
    Machine {
        name: "sixteen letters.".try_into().expect("short enough"),
        tick_us: u32::MAX,
        timer_hz: u32::MAX,
        joints: [const { 0 }; JOINTS].map(|_| axis.clone()).into_iter().collect(),
    }
}

fn frame(message: &Message<JOINTS>) -> Vec<u8> {
    let mut buffer = [0; capacity(JOINTS)];
    encode(message, &mut buffer).expect("it fits").to_vec()
}

fn decoded(bytes: &[u8]) -> (Vec<Found>, Counts) {
    let mut decoder = Decoder::new();
    let found = bytes.iter().filter_map(|&byte| decoder.push(byte));
    let found: Vec<_> = found.collect();
    (found, decoder.counts())
}

/// The numbers of the ticks that arrive.
fn numbers(bytes: &[u8]) -> Vec<u32> {
    let (found, _) = decoded(bytes);
    let ticks = found.iter().filter_map(|found| match found {
        Ok(Message::Tick(tick)) => Some(tick.number),
        _ => None,
    });
    ticks.collect()
}

#[test]
fn a_frame_comes_back_as_it_was() {
    for message in [Message::Tick(tick(7)), Message::Machine(machine())] {
        assert_eq!(decoded(&frame(&message)).0, [Ok(message)]);
    }
}

#[test]
fn any_corrupted_byte_is_found() {
    for message in [Message::Tick(tick(7)), Message::Machine(machine())] {
        let good = frame(&message);
        for at in 0..good.len() {
            for wrong in (0..=255).filter(|&wrong| wrong != good[at]) {
                let mut bytes = [&[0][..], &good, &[0]].concat();
                bytes[1 + at] = wrong;
                let (found, counts) = decoded(&bytes);
                let accepted = found.iter().any(Result::is_ok);
                assert!(!accepted, "byte {at} as {wrong}");
                assert!(counts.bad > 0, "byte {at} as {wrong}");
            }
        }
    }
}

#[test]
fn each_corrupted_pair_of_neighbours_is_found() {
    let good = frame(&Message::Tick(tick(7)));
    for at in 1..good.len() - 2 {
        for wrong in (1..=u16::MAX).step_by(127) {
            let mut bytes = good.clone();
            bytes[at] ^= wrong as u8;
            bytes[at + 1] ^= (wrong >> 8) as u8;
            assert!(decoded(&bytes).0.iter().all(Result::is_err), "{at} {wrong}");
        }
    }
}

#[test]
fn a_lost_byte_costs_one_frame_at_most() {
    let frames: Vec<u8> = (0..3).flat_map(|n| frame(&Message::Tick(tick(n)))).collect();
    let length = frames.len() / 3;
    for lost in 0..frames.len() {
        let mut bytes = [&[0][..], &frames, &[0]].concat();
        bytes.remove(1 + lost);
        let left = numbers(&bytes);
        let hit = (lost / length) as u32;
        let without: Vec<u32> = (0..3).filter(|&n| n != hit).collect();
        let is_all_but_one = left == without;
        // One of two zeros in a row is enough.
        assert!(is_all_but_one || left == [0, 1, 2], "byte {lost}: {left:?}");
        let is_zero = frames[lost] == 0;
        assert_eq!(is_all_but_one, !is_zero, "byte {lost}: {left:?}");
    }
}

#[test]
fn a_gap_costs_only_the_frames_it_touches() {
    let frames: Vec<u8> = (0..4).flat_map(|n| frame(&Message::Tick(tick(n)))).collect();
    let length = frames.len() / 4;
    for from in 0..2 * length {
        for gap in 1..length {
            let bytes = [&frames[..from], &frames[from + gap..]].concat();
            let left = numbers(&bytes);
            assert!(left.len() >= 2 && left.ends_with(&[3]), "{from} {gap}: {left:?}");
        }
    }
}

#[test]
fn a_listener_that_comes_late_counts_nothing_bad() {
    let frames: Vec<u8> = (0..3).flat_map(|n| frame(&Message::Tick(tick(n)))).collect();
    for start in 0..frames.len() / 3 {
        assert_eq!(decoded(&frames[start..]).1.bad, 0, "{start}");
    }
}

#[test]
fn a_full_queue_drops_counts_and_never_blocks() {
    let mut slots = Slots::<JOINTS, 4>::default();
    let mut queue = Queue::new();
    let (mut interrupt, mut main) = split(&mut slots, &mut queue, 0);
    let kept: Vec<bool> = (0..10).map(|_| interrupt.push()).collect();
    assert_eq!(kept.iter().filter(|&&kept| kept).count(), 3);
    assert_eq!(interrupt.dropped(), 7);
    assert_eq!(main.pop().map(|tick| (tick.number, tick.dropped)), Some((0, 0)));
    assert!(interrupt.push());
    let rest: Vec<_> = std::iter::from_fn(|| main.pop()).collect();
    let last = rest.last().expect("the one after the drops");
    assert_eq!((rest.len(), last.number, last.dropped), (3, 10, 7));
}

// Its slot may have been used any number of times.
#[test]
fn each_tick_arrives_as_written() {
    let mut slots = Slots::<JOINTS, 4>::default();
    let mut queue = Queue::new();
    let (mut interrupt, mut main) = split(&mut slots, &mut queue, 0);
    let mut arrived = Vec::new();
    for tick in 0..100 {
        interrupt.sample().tick = tick;
        interrupt.sample().torque = [tick as f32; JOINTS];
        interrupt.push();
        // The main loop is slower at times: full, then empty.
        if tick % 7 > 3 {
            arrived.extend(std::iter::from_fn(|| main.pop()));
        }
    }
    assert!(interrupt.dropped() > 0);
    let expected = |tick: &Tick<JOINTS>| {
        let torques = tick.joints.iter().map(|joint| joint.torque);
        tick.number == tick.tick && torques.eq([tick.tick as f32; JOINTS])
    };
    assert!(arrived.iter().all(expected));
    assert!(arrived.is_sorted_by(|one, next| one.number < next.number));
    assert_eq!(
        arrived.len() as u32 + interrupt.dropped(),
        100 - std::iter::from_fn(|| main.pop()).count() as u32
    );
}

#[test]
fn queue_drops_and_line_losses_are_counted_apart() {
    let mut sent = Vec::new();
    for (number, dropped) in [(0, 0), (1, 0), (6, 4), (9, 4)] {
        let tick = Tick { dropped, ..tick(number) };
        sent.extend(frame(&Message::Tick(tick)));
    }
    let counts = decoded(&sent).1;
    assert_eq!((counts.missing, counts.dropped, counts.lost()), (6, 4, 2));
}

#[test]
fn a_restart_of_the_machine_is_no_gap() {
    let sent = [900, 901, 0, 1].map(|number| frame(&Message::Tick(tick(number))));
    let counts = decoded(&sent.concat()).1;
    assert_eq!((counts.restarts, counts.missing, counts.frames), (1, 0, 4));
    let wrapped = [u32::MAX, 0].map(|number| frame(&Message::Tick(tick(number))));
    let counts = decoded(&wrapped.concat()).1;
    assert_eq!((counts.restarts, counts.missing), (0, 0));
}

#[test]
fn another_version_is_refused_and_not_misread() {
    let other = postcard::to_allocvec(&(VERSION + 1, Message::Tick(tick(1)))).expect("encoded");
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISCSI).checksum(&other);
    let mut frame = cobs::encode_vec(&[&other[..], &crc.to_le_bytes()].concat());
    frame.insert(0, 0);
    frame.push(0);
    let found = VERSION + 1;
    assert_eq!(decoded(&frame).0, [Err(FrameError::Version { found })]);
}

#[test]
fn more_joints_than_there_is_room_for_are_refused() {
    let bytes = frame(&Message::Tick(tick(1)));
    let mut small = Decoder::<{ JOINTS - 1 }>::new();
    let found: Vec<_> = bytes.iter().filter_map(|&byte| small.push(byte)).collect();
    assert_eq!(found, [Err(FrameError::Contents)]);
}

#[test]
fn endless_noise_without_a_zero_is_one_bad_frame() {
    let noise = [&[0][..], &[9; 5000], &[0], &frame(&Message::Tick(tick(1)))].concat();
    let (found, counts) = decoded(&noise);
    assert_eq!((found[0].clone(), counts.frames), (Err(FrameError::Long), 1));
}

// It is less than twice as long as the frame.
#[test]
fn the_buffer_fits_the_longest_frame_without_waste() {
    let mut worst = tick(u32::MAX);
    (worst.dropped, worst.tick) = (u32::MAX, u32::MAX);
    worst.cost = [u32::MAX; 5];
    worst.status.fault = Some(Fault::Drive { joint: usize::MAX });
    for message in [Message::Tick(worst), Message::Machine(machine())] {
        let length = frame(&message).len();
        assert!(capacity(JOINTS) < 2 * length, "{length}");
        let mut short = vec![0; length - 1];
        assert_eq!(encode(&message, &mut short), Err(EncodeError::Full));
    }
}
