//! Starts at random zeros, directions, ratios, ranges and turns, through every encoder, blocking
//! and asynchronous.

use core::cell::Cell;
use core::convert::Infallible;
use core::f64::consts::TAU;
use std::collections::VecDeque;

use embedded_can::{ExtendedId, Frame, StandardId};

use joint_drivers::as5047p::As5047p;
use joint_drivers::as5600::As5600;
use joint_drivers::can::FdFrame;
use joint_drivers::feetech::{FeetechError, Servos};
use joint_drivers::incremental::{IncrementalEncoder, IncrementalError};
use joint_drivers::moteus::Moteus;
use joint_drivers::odrive::{ODrive, Reply};
use joint_drivers::{
    Direction, EncoderMapping, EncoderType, JointMapping, JointRange, MappingError,
    MultiTurnEncoder, Resolution,
};

use super::ready;

mod devices;
mod gaps;

use devices::{Bus, Magnet, count};

const STARTS: usize = 2000;

/// Marsaglia's xorshift32, 2003.
struct Random(u32);

impl Random {
    fn between(&mut self, lower: f64, upper: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        lower + (upper - lower) * f64::from(self.0) / 4_294_967_296.0
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.between(0.0, all.len() as f64) as usize]
    }
}

/// A joint at power-up.
#[derive(Clone, Copy, Debug)]
struct Start {
    zero: f32,
    direction: Direction,
    ratio: f32,
    range: JointRange,
    /// The position of the joint, rad.
    truth: f64,
}

impl Start {
    /// A start of one of the three kinds, of an encoder of at least this many counts per turn.
    fn random(random: &mut Random) -> Self {
        let kind = random.of(&[0, 1, 2]);
        let ratio = match kind {
            2 => random.of(&[1.0, 0.5, 0.25]),
            _ => random.of(&[1.0_f32, 0.5, 2.0, 7.5, 100.0]),
        };
        let turn = TAU / f64::from(ratio);
        let (range, truth) = match kind {
            0 => {
                let half = 0.5 * turn * random.between(0.0, 0.9995);
                let middle = random.between(-3.0, 3.0);
                let (lower, upper) = ((middle - half) as f32, (middle + half) as f32);
                let end = |part: f64| f64::from(lower) + part * f64::from(upper - lower);
                // The ends are tried more often than chance would.
                let part = random.between(-0.1, 1.1).clamp(0.0, 1.0);
                (JointRange::Within { lower, upper }, end(part))
            }
            1 => {
                let near = random.between(-100.0, 100.0) as f32;
                let off = random.between(-0.499, 0.499) * turn;
                (JointRange::Near(near), f64::from(near) + off)
            }
            _ => (JointRange::Continuous, random.between(-10_000.0, 10_000.0) * TAU),
        };
        Self {
            zero: random.between(-20.0, 20.0) as f32,
            direction: random.of(&[Direction::Forward, Direction::Reverse]),
            ratio,
            range,
            truth,
        }
    }

    fn mapping(&self) -> EncoderMapping {
        let mapping = JointMapping::new(self.zero, self.direction, self.ratio).unwrap();
        mapping.with_range(self.range, 1e-3).unwrap()
    }

    /// Turns of the shaft while the joint is at `q`.
    fn shaft(&self, q: f64) -> f64 {
        let sign = f64::from(self.direction.sign());
        (f64::from(self.zero) + sign * f64::from(self.ratio) * q) / TAU
    }

    /// The count of a turn of this many counts while the joint is at `q`.
    fn count(&self, q: f64, counts: i64) -> u16 {
        ((self.shaft(q) * counts as f64).round() as i64).rem_euclid(counts) as u16
    }

    /// Whether a reading is the joint's position, within half a count of the rounding of this many
    /// per turn.
    fn accepts(&self, read: f32, truth: f64, counts: f64) -> bool {
        let turn = TAU / f64::from(self.ratio);
        let mut off = f64::from(read) - truth;
        if matches!(self.range, JointRange::Continuous) {
            off -= (off / turn).round() * turn;
            if f64::from(read).abs() > 0.5001 * turn {
                return false;
            }
        }
        let half = 0.502 * turn / counts;
        let within = match self.range {
            JointRange::Within { lower, upper } => {
                f64::from(read) >= f64::from(lower) - half - 1e-6
                    && f64::from(read) <= f64::from(upper) + half + 1e-6
            }
            _ => true,
        };
        within && off.abs() <= half + 4e-7 * f64::from(read).abs().max(0.1)
    }
}

/// Every start through a driver, which reads the joint as it is.
fn all_starts(counts: f64, read: impl Fn(&Start) -> f32) {
    let mut random = Random(0x5eed_0001);
    for number in 0..STARTS {
        let start = Start::random(&mut random);
        let found = read(&start);
        assert!(start.accepts(found, start.truth, counts), "{number}: {found} {start:?}");
    }
}

#[test]
fn every_start_of_an_as5047p_is_where_the_joint_is() {
    let encoder = |start: &Start| {
        let magnet = Magnet(count(start.count(start.truth, 16_384)));
        As5047p::new(magnet, start.mapping())
    };
    all_starts(16_384.0, |start| encoder(start).read().unwrap());
    all_starts(16_384.0, |start| ready(encoder(start).read_async()).unwrap());
}

#[test]
fn every_start_of_an_as5600_is_where_the_joint_is() {
    let encoder = |start: &Start| {
        let magnet = Magnet(count(start.count(start.truth, 4096)));
        As5600::new(magnet, start.mapping())
    };
    all_starts(4096.0, |start| encoder(start).read().unwrap());
    all_starts(4096.0, |start| ready(encoder(start).read_async()).unwrap());
}

#[test]
fn every_start_of_a_multi_turn_encoder_is_where_the_joint_is() {
    fn read<const BITS: u32>(start: &Start) -> f32 {
        let mut encoder = MultiTurnEncoder::<BITS>::new(start.mapping());
        encoder.update(start.count(start.truth, 1 << BITS)).unwrap();
        encoder.position()
    }
    all_starts(4096.0, read::<12>);
    all_starts(16_384.0, read::<14>);
    all_starts(65_536.0, read::<16>);
}

#[test]
fn every_start_of_a_servo_is_where_the_joint_is() {
    let servo = |start: &Start| {
        let bus = Bus::at(start.count(start.truth, 4096));
        Servos::new(bus, [1], [start.mapping()]).unwrap()
    };
    all_starts(4096.0, |start| servo(start).positions().unwrap()[0]);
    all_starts(4096.0, |start| ready(servo(start).positions_async()).unwrap()[0]);
}

/// The goal in the last packet to a servo.
fn goal(bus: &Bus) -> u16 {
    let [.., low, high, _] = bus.sent[..] else {
        panic!("nothing was sent");
    };
    u16::from_le_bytes([low, high])
}

#[test]
fn every_goal_of_a_servo_is_its_place_without_the_seam() {
    let (mut random, mut refused) = (Random(7), 0);
    for number in 0..STARTS {
        let start = Start::random(&mut random);
        let (lower, upper) = match start.range {
            JointRange::Within { lower, upper } => (f64::from(lower), f64::from(upper)),
            _ => (start.truth - 0.5, start.truth + 0.5),
        };
        let wanted = random.between(lower, upper) as f32;
        let mut servos =
            Servos::new(Bus::at(start.count(start.truth, 4096)), [1], [start.mapping()]).unwrap();
        servos.positions().unwrap();
        let sent = match number % 2 {
            0 => servos.set_positions(&[wanted]),
            _ => ready(servos.set_positions_async(&[wanted])),
        };
        // The servo goes along its counts, from the one of now.
        let turn = |q: f64| (start.shaft(q) * 4096.0).round().div_euclid(4096.0);
        let exact = start.shaft(f64::from(wanted)) * 4096.0;
        let near_seam = (exact + 2.0).rem_euclid(4096.0) < 4.0;
        if matches!(start.range, JointRange::Continuous)
            || turn(f64::from(wanted)) == turn(start.truth)
        {
            if near_seam && sent.is_err() {
                continue;
            }
            assert_eq!(sent, Ok(()), "{number}: {wanted} {start:?}");
            let goal = goal(&servos.release());
            assert!(goal < 4096, "{number}: {goal} {start:?}");
            // A goal beyond 10,000 turns has an f32's steps of many counts.
            let off = (f64::from(goal) - exact + 2048.0).rem_euclid(4096.0) - 2048.0;
            let step = f64::from(wanted.abs().next_up() - wanted.abs());
            let steps = 4.0 * step * f64::from(start.ratio) * 4096.0 / TAU;
            assert!(off.abs() <= 0.51 + steps, "{number}: {goal} {exact} {start:?}");
        } else if !near_seam {
            refused += 1;
            assert_eq!(sent, Err(FeetechError::Goal { joint: 0 }), "{number}: {start:?}");
        }
    }
    assert!((100..1500).contains(&refused), "{refused}");
}

#[test]
fn a_goal_before_the_first_reading_needs_a_range_without_the_seam() {
    let servo = |zero, range| {
        let mapping = JointMapping::new(zero, Direction::Forward, 1.0).unwrap();
        let mapping = mapping.with_range(range, 1e-3).unwrap();
        Servos::new(Bus::default(), [1], [mapping]).unwrap()
    };
    let range = JointRange::Within { lower: -0.8, upper: 0.8 };
    let mut middle = servo(3.0 + 2.0 * core::f32::consts::TAU, range);
    assert_eq!(middle.set_positions(&[0.6]), Ok(()));
    assert_eq!(goal(&middle.release()), 2347);
    let unknown = Err(FeetechError::Goal { joint: 0 });
    assert_eq!(servo(5.9, range).set_positions(&[0.6]), unknown);
    assert_eq!(servo(3.0, JointRange::Near(0.0)).set_positions(&[0.6]), unknown);
    // Both ways round a circle lead to the goal.
    let mut circle = servo(5.9, JointRange::Continuous);
    assert_eq!(circle.set_positions(&[0.6]), Ok(()));
    assert_eq!(goal(&circle.release()), 141);
}

#[test]
fn a_servo_that_counts_turns_goes_on_from_its_count() {
    let mapping = JointMapping::new(1.0, Direction::Reverse, 2.0).unwrap();
    let mapping = mapping.with_range(JointRange::Near(2.0), 1e-3).unwrap();
    let mut servos = Servos::new(Bus::at(0x8000 | 100), [1], [mapping]).unwrap();
    servos = servos.with_turns();
    let here = servos.positions().unwrap()[0];
    assert!((f64::from(here) - (1.0 + 100.0 * TAU / 4096.0) / 2.0).abs() < 1e-6);
    for (turns, wanted) in [(0.25, 0x8000 | 2148_u16), (-3.0, 24_476)] {
        servos.set_positions(&[here + turns * core::f32::consts::TAU]).unwrap();
        let bus = servos.release();
        assert_eq!(goal(&bus), wanted, "{turns}");
        servos = Servos::new(bus, [1], [mapping]).unwrap().with_turns();
        servos.positions().unwrap();
    }
    let far = here - 4.5 * core::f32::consts::TAU;
    assert_eq!(servos.set_positions(&[far]), Err(FeetechError::Goal { joint: 0 }));
}

/// The position after an index of an encoder of 2000 counts, which the joint passes within a half
/// turn from its start.
fn after_index(start: &Start) -> Option<(f32, f64)> {
    const TURN: f64 = 2000.0;
    let sign = f64::from(start.direction.sign());
    let first = (start.shaft(start.truth) * TURN).round();
    let index = (first / TURN).round() * TURN;
    let last = index + 3.0;
    let joint =
        |count: f64| (count / TURN * TAU - f64::from(start.zero)) * sign / f64::from(start.ratio);
    if let JointRange::Within { lower, upper } = start.range {
        // The joint does not leave its range in search of the index.
        let outside = |q| q < f64::from(lower) || q > f64::from(upper);
        if outside(joint(index)) || outside(joint(last)) {
            return None;
        }
    }
    let steps = [first, last].map(|count| (count - first) as i64 as u16);
    let (mut counts, mut indices) =
        (steps.into_iter(), [None, Some((index - first) as i64 as u16)].into_iter());
    let timer = (|| counts.next().unwrap(), || indices.next().unwrap());
    let resolution = Resolution::new(2000).unwrap();
    let mut encoder = IncrementalEncoder::new(timer, resolution, start.mapping()).unwrap();
    assert_eq!(encoder.read(), Err(IncrementalError::NotReferenced));
    Some((encoder.read().unwrap(), joint(last)))
}

#[test]
fn every_start_of_an_incremental_encoder_is_where_the_joint_is() {
    let (mut random, mut tried) = (Random(3), 0);
    while tried < STARTS {
        let start = Start::random(&mut random);
        if let Some((found, truth)) = after_index(&start) {
            tried += 1;
            assert!(start.accepts(found, truth, 2000.0), "{found} {truth} {start:?}");
        }
    }
}

/// The turns that a controller with an absolute encoder reports after power-up.
fn reported(start: &Start) -> f32 {
    let turns = start.shaft(start.truth);
    (turns - turns.round()) as f32
}

#[test]
fn every_start_of_a_controller_on_can_is_where_the_joint_is() {
    // f32 of a turn has more than these counts.
    const COUNTS: f64 = 1e6;
    all_starts(COUNTS, |start| {
        let mut joint = Moteus::new(1, 0, 1.0, start.mapping()).unwrap();
        let [q0, q1, q2, q3] = reported(start).to_le_bytes();
        let data = [0x21, 0, 10, 0x2f, 1, q0, q1, q2, q3, 0, 0, 0, 0, 0, 0, 0, 0, 0x21, 0x0f, 0];
        let frame = FdFrame::new(ExtendedId::new(0x100).unwrap(), &data).unwrap();
        joint.reply(&frame).unwrap().position
    });
    all_starts(COUNTS, |start| {
        let mut axis = ODrive::new(1, 1.0, start.mapping()).unwrap();
        let [q0, q1, q2, q3] = reported(start).to_le_bytes();
        let data = [q0, q1, q2, q3, 0, 0, 0, 0];
        let frame = FdFrame::new(StandardId::new(0x29).unwrap(), &data).unwrap();
        let Ok(Reply::Estimates { position, .. }) = axis.reply(&frame) else {
            panic!("no estimates");
        };
        position
    });
}

#[test]
fn steps_after_ten_thousand_turns_are_those_of_the_first() {
    let circle = JointMapping::new(0.7, Direction::Reverse, 1.0).unwrap();
    let circle = circle.with_range(JointRange::Continuous, 0.1).unwrap();
    let mut encoder = MultiTurnEncoder::<14>::new(circle);
    let mut steps = |from: i64| {
        [0, 40, 80, 120].map(|count| {
            encoder.update((from + count).rem_euclid(16_384) as u16).unwrap();
            encoder.position()
        })
    };
    assert_eq!(steps(0), steps(10_000 * 16_384));
    // A motor's count grows: the relative error of its joint's position stays that of one rounding.
    let geared = JointMapping::new(0.7, Direction::Forward, 100.0).unwrap();
    for turns in [0.0, 100.0, 10_000.0] {
        let near = JointRange::Near((turns * TAU / 100.0) as f32);
        let mut encoder = MultiTurnEncoder::<14>::new(geared.with_range(near, 1e-3).unwrap());
        encoder.update(3000).unwrap();
        let exact = ((turns + 3000.0 / 16_384.0) * TAU - f64::from(0.7_f32)) / 100.0;
        let error = (f64::from(encoder.position()) - exact) / exact.abs();
        assert!(error.abs() < 4e-7, "{turns}: {error}");
    }
}

#[test]
fn a_geared_joint_without_an_end_is_as_exact_after_a_hundred_thousand_turns() {
    let endless = |ratio| {
        let mapping = JointMapping::new(0.7, Direction::Reverse, ratio).unwrap();
        mapping.with_range(JointRange::ContinuousNear(0.3), 0.1).unwrap()
    };
    for ratio in [1.0_f32, 2.0, 7.0] {
        let mut encoder = MultiTurnEncoder::<14>::new(endless(ratio));
        let joint =
            |counts: i64| -(counts as f64 * TAU / 16_384.0 - f64::from(0.7_f32)) / f64::from(ratio);
        let mut at = 900_i64;
        let mut read = |encoder: &mut MultiTurnEncoder<14>, to: i64| {
            while at != to {
                at += (to - at).clamp(-8000, 8000);
                encoder.update(at.rem_euclid(16_384) as u16).unwrap();
            }
            encoder.position()
        };
        let counts = [0, 40, 80, 120].map(|step| 1000 + step);
        let first = counts.map(|counts| read(&mut encoder, counts));
        let turns = (1e5 * ratio) as i64 * 16_384;
        for direction in [1, -1] {
            let later = counts.map(|counts| read(&mut encoder, counts + direction * turns));
            assert_eq!(later, first, "{ratio}");
        }
        for (counts, position) in counts.into_iter().zip(first) {
            let off = (f64::from(position) - joint(counts)) / TAU;
            let within = position.abs() < core::f32::consts::PI + 1e-5;
            assert!((off - off.round()).abs() < 1e-6 && within, "{position}");
        }
        // Half a turn of the encoder in a gap is still the end of what is known.
        encoder.missed(1000);
        assert!(encoder.update(0).is_err() && encoder.update(0).is_err());
        encoder.place_near(1.0).unwrap();
        encoder.update(0).unwrap();
    }
    // Not a whole number; no turns of a circle are counted by its edges.
    let ninth = JointMapping::new(0.7, Direction::Reverse, 7.5).unwrap();
    let refused = ninth.with_range(JointRange::ContinuousNear(0.0), 1e-3);
    assert_eq!(refused, Err(MappingError::Circle));
    let timer = (|| 0_u16, || None);
    let made = IncrementalEncoder::new(timer, Resolution::new(2000).unwrap(), endless(2.0));
    assert_eq!(made.map(|_| ()), Err(MappingError::Circle));
}

#[test]
fn a_range_that_an_encoder_does_not_resolve_is_refused() {
    let of = |ratio, range, step| {
        let mapping = JointMapping::new(1.0, Direction::Forward, ratio).unwrap();
        mapping.with_range(range, step).map(|_| ())
    };
    let within = |lower, upper| JointRange::Within { lower, upper };
    for (lower, upper) in [(1.0, -1.0), (f32::NAN, 1.0), (f32::NEG_INFINITY, 1.0)] {
        assert_eq!(of(1.0, within(lower, upper), 1e-3), Err(MappingError::Range));
    }
    assert_eq!(of(1.0, within(-3.139, 3.139), 1e-3), Ok(()));
    assert_eq!(of(1.0, within(-3.141_52, 3.141_52), 1e-3), Err(MappingError::Turns));
    assert_eq!(of(2.0, within(-3.0, 3.0), 1e-3), Err(MappingError::Turns));
    assert_eq!(of(0.5, within(-6.279, 6.279), 1e-3), Ok(()));
    assert_eq!(of(1.0, JointRange::Near(f32::NAN), 1e-3), Err(MappingError::Range));
    assert_eq!(of(100.0, JointRange::Near(1100.0), 1e-3), Err(MappingError::Range));
    for ratio in [2.0, 0.7, 100.0] {
        assert_eq!(of(ratio, JointRange::Continuous, 1e-3), Err(MappingError::Circle));
    }
    for step in [0.0, -1.0, f32::NAN, f32::INFINITY, 0.032] {
        assert_eq!(of(100.0, JointRange::Near(0.0), step), Err(MappingError::Step));
    }
    // A counter of 16 bits and 2²⁴ counts per turn goes round in a 512th of a turn.
    let fine = Resolution::new(1 << 24).unwrap();
    let timer = || (|| 0_u16, || None);
    for (step, fits) in [(0.005, true), (0.02, false)] {
        let mapping = JointMapping::IDENTITY.with_range(within(-1.0, 1.0), step).unwrap();
        let made = IncrementalEncoder::new(timer(), fine, mapping).map(|_| ());
        assert_eq!(made, if fits { Ok(()) } else { Err(MappingError::Step) });
    }
}
