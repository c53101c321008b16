//! The promises of the incremental encoder.

use embedded_hal::digital::InputPin;
use embedded_hal_mock::eh1::digital::{Mock, State, Transaction};
use joint_drivers::incremental::{
    IncrementalEncoder, IncrementalError, InvalidTransition, QuadratureCounter, QuadratureDecoder,
};
use joint_drivers::{Direction, EncoderMapping, JointMapping, JointRange, Resolution};

use super::identity;

/// Counts per turn of the simulated encoder.
const TURN: i32 = 40;

/// The levels of A, B and Z at a count: the index is high in one state per turn.
fn levels(count: i32) -> (bool, bool, bool) {
    let phase = count.rem_euclid(4);
    let a = matches!(phase, 1 | 2);
    (a, phase >= 2, count.rem_euclid(TURN) == 2)
}

fn joint(mapping: EncoderMapping) -> IncrementalEncoder<QuadratureDecoder> {
    let resolution = Resolution::new(TURN as u32).unwrap();
    IncrementalEncoder::new(QuadratureDecoder::new(), resolution, mapping).unwrap()
}

/// The mapping of a joint whose encoder reads its own angle.
fn at(range: JointRange) -> EncoderMapping {
    JointMapping::IDENTITY.with_range(range, 1e-3).unwrap()
}

/// Turns the shaft from one count to another, one edge after the other.
fn turn(joint: &mut IncrementalEncoder<QuadratureDecoder>, from: i32, to: i32) {
    let step = (to - from).signum();
    for moved in 1..=(to - from).abs() {
        let (a, b, z) = levels(from + step * moved);
        joint.counter().update(a, b, z).unwrap();
    }
}

/// The angle of a count, from the index at count 2.
fn angle(count: i32) -> f32 {
    Resolution::new(TURN as u32).unwrap().angle(count - 2)
}

// From then on it is known in both directions.
#[test]
fn the_position_is_known_once_the_index_is_passed() {
    for start in [-30, 10] {
        // The position at the first reading says in which turn the index is passed.
        let mut encoder = joint(at(JointRange::Near(angle(start))));
        *encoder.counter() = QuadratureDecoder::at(levels(start).0, levels(start).1, false);
        assert_eq!(encoder.read(), Err(IncrementalError::NotReferenced));
        assert_eq!(encoder.position(), None);
        turn(&mut encoder, start, 3 - 4 * start.signum());
        assert_eq!(encoder.read(), Ok(angle(3 - 4 * start.signum())));
        turn(&mut encoder, 3 - 4 * start.signum(), 90);
        assert_eq!(encoder.read(), Ok(angle(90)));
        turn(&mut encoder, 90, -200);
        assert_eq!(encoder.read(), Ok(angle(-200)));
    }
}

#[test]
fn the_joint_mapping_applies_from_the_index() {
    let mapping = JointMapping::new(0.25, Direction::Reverse, 3.0).unwrap();
    let range = JointRange::Near(-1.5);
    let mut encoder = joint(mapping.with_range(range, 1e-3).unwrap());
    turn(&mut encoder, 0, 33);
    let position = encoder.read().unwrap();
    assert!((position - (0.25 - angle(33)) / 3.0).abs() < 1e-6);
    assert_eq!(encoder.position(), Some(position));
}

#[test]
fn the_count_is_followed_across_the_wrap_of_16_bits() {
    let mut encoder = joint(identity());
    // Whole turns are counted from the first index that was read.
    turn(&mut encoder, 0, 20);
    assert_eq!(encoder.read(), Ok(angle(20)));
    let mut at = 20;
    for to in [100_000, -70_000, 0, 150_000] {
        while at != to {
            let next = to.clamp(at - 30_000, at + 30_000);
            turn(&mut encoder, at, next);
            at = next;
            assert_eq!(encoder.read(), Ok(angle(at)));
        }
    }
}

// The transition is counted, and the next index makes the position known again.
#[test]
fn after_an_invalid_transition_the_position_is_unknown() {
    let mut encoder = joint(at(JointRange::Continuous));
    turn(&mut encoder, 0, 8);
    assert_eq!(encoder.read(), Ok(angle(8)));
    let (a, b, z) = levels(10);
    let lost: InvalidTransition = encoder.counter().update(a, b, z).unwrap_err();
    assert_eq!(lost.total, 1);
    assert_eq!(encoder.counter().invalid_transitions(), 1);
    assert_eq!(encoder.read(), Err(IncrementalError::Counter(lost)));
    turn(&mut encoder, 10, 41);
    assert_eq!(encoder.read(), Err(IncrementalError::NotReferenced));
    turn(&mut encoder, 41, 50);
    assert_eq!(encoder.read(), Ok(angle(10)));
}

#[test]
fn an_index_before_lost_counts_gives_no_position() {
    let mut encoder = joint(identity());
    turn(&mut encoder, 0, 8);
    let (a, b, z) = levels(10);
    encoder.counter().update(a, b, z).unwrap_err();
    assert!(matches!(encoder.read(), Err(IncrementalError::Counter(_))));
    assert_eq!(encoder.read(), Err(IncrementalError::NotReferenced));
}

#[test]
fn lost_or_added_counts_are_found_at_the_index() {
    // Two invalid transitions would be seen by the decoder; noise on a timer's input is not.
    // Half of 40 counts is the short way.
    for excess in [-19, -14, -3, -1, 1, 5, 14, 19] {
        let counts = [0_u16, 7, 47_u16.wrapping_add_signed(excess), 60];
        let last = 42_u16.wrapping_add_signed(excess);
        let indices = [None, Some(2), Some(last), None];
        let (mut counts, mut indices) = (counts.into_iter(), indices.into_iter());
        let timer = (|| counts.next().unwrap(), || indices.next().unwrap());
        let resolution = Resolution::new(TURN as u32).unwrap();
        let mut encoder = IncrementalEncoder::new(timer, resolution, identity()).unwrap();
        assert_eq!(encoder.read(), Err(IncrementalError::NotReferenced));
        assert_eq!(encoder.read(), Ok(resolution.angle(5)));
        let excess = i32::from(excess);
        assert_eq!(encoder.read(), Err(IncrementalError::Index { excess }));
        assert_eq!(encoder.read(), Ok(resolution.angle(58 - excess)));
    }
}

#[test]
fn a_wide_index_is_tolerated_within_its_width() {
    let wide = |excess: u16, width| {
        let (mut counts, mut indices) = ([5, 50].into_iter(), [2, 42 + excess].into_iter());
        let timer = (move || counts.next().unwrap(), move || indices.next());
        let resolution = Resolution::new(TURN as u32).unwrap();
        let mut encoder =
            IncrementalEncoder::new(timer, resolution, identity()).unwrap().with_index_width(width);
        encoder.read().unwrap();
        encoder.read()
    };
    assert_eq!(wide(2, 2), Ok(angle(50)));
    assert_eq!(wide(3, 2), Err(IncrementalError::Index { excess: 3 }));
}

#[test]
fn the_decoder_follows_levels_that_pins_return() {
    let path: Vec<i32> = (1..=5).chain((1..5).rev()).collect();
    let pin = |level: fn((bool, bool, bool)) -> bool| {
        let state = |high| if high { State::High } else { State::Low };
        let reads = path.iter().map(|count| Transaction::get(state(level(levels(*count)))));
        Mock::new(&reads.collect::<Vec<_>>())
    };
    let mut pins = [pin(|(a, _, _)| a), pin(|(_, b, _)| b), pin(|(_, _, z)| z)];
    let mut decoder = QuadratureDecoder::new();
    for count in &path {
        let [a, b, z] = pins.each_mut().map(|pin| pin.is_high().unwrap());
        decoder.update(a, b, z).unwrap();
        assert_eq!(decoder.count(), Ok(*count as u16));
    }
    assert_eq!(decoder.index(), Some(2));
    assert_eq!(decoder.index(), None);
    pins.iter_mut().for_each(Mock::done);
}

#[test]
fn no_level_sequence_panics_or_gives_nonfinite_positions() {
    let (mut random, mut positions) = (1_u32, 0);
    let mut encoder = joint(at(JointRange::Continuous));
    for _ in 0..100_000 {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let bit = |shift: u32| random >> shift & 1 != 0;
        let _ = encoder.counter().update(bit(31), bit(30), bit(29));
        if let (true, Ok(position)) = (bit(28), encoder.read()) {
            assert!(position.is_finite());
            positions += 1;
        }
    }
    assert!(positions > 100);
    assert!(encoder.counter().invalid_transitions() > 10_000);
}
