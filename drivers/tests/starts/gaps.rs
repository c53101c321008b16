//! Gaps in the readings of encoders whose count wraps.

use std::rc::Rc;

use motion_control::limits::Fault;

use super::devices::{Count, GONE};
use super::*;

/// The motor turns by 0.3 rad in a tick at most: 9 readings may be missing, and after 10 it can
/// have turned by half a turn.
const STEP: f32 = 3e-3;
const ALLOWED: u32 = 9;

/// The calls that a test makes of an encoder.
#[derive(Clone, Copy)]
enum Do {
    Read,
    Miss(u32),
    Place(f32),
}

/// An encoder that reads a count which the test sets.
type Encoder = Box<dyn FnMut(Do) -> Result<f32, Fault>>;

/// An encoder by its functions; the result of what is not a reading does not matter.
fn encoder<E: EncoderType + 'static>(
    mut encoder: E,
    read: fn(&mut E) -> Result<f32, E::Error>,
    place: fn(&mut E, f32) -> Result<(), MappingError>,
) -> Encoder {
    Box::new(move |what| {
        match what {
            Do::Read => return read(&mut encoder).map_err(|error| E::fault(&error, 0)),
            Do::Miss(ticks) => encoder.missed(ticks),
            Do::Place(position) => place(&mut encoder, position).unwrap(),
        }
        Ok(0.0)
    })
}

/// Every driver of an absolute encoder in both forms, each with its counts per turn.
fn drivers(mapping: EncoderMapping) -> Vec<(i64, Count, Encoder)> {
    let mut all = Vec::new();
    let mut add = |counts, make: &dyn Fn(Count) -> Encoder| {
        let raw = count(0);
        all.push((counts, raw.clone(), make(raw)));
    };
    let spi = |raw| As5047p::new(Magnet(raw), mapping);
    add(16_384, &|raw| encoder(spi(raw), As5047p::read, As5047p::place_near));
    add(16_384, &|raw| {
        encoder(spi(raw), |encoder| ready(encoder.read_async()), As5047p::place_near)
    });
    let i2c = |raw| As5600::new(Magnet(raw), mapping);
    add(4096, &|raw| encoder(i2c(raw), As5600::read, As5600::place_near));
    add(4096, &|raw| encoder(i2c(raw), As5600::read_angle, As5600::place_near));
    add(4096, &|raw| encoder(i2c(raw), |encoder| ready(encoder.read_async()), As5600::place_near));
    add(4096, &|raw| {
        encoder(i2c(raw), |encoder| ready(encoder.read_angle_async()), As5600::place_near)
    });
    let servos = |count| {
        let bus = Bus { count, ..Bus::default() };
        Servos::new(bus, [1], [mapping]).unwrap()
    };
    add(4096, &|raw| {
        let read = |servos: &mut Servos<_, 1>| servos.positions().map(|[position]| position);
        encoder(servos(raw), read, |servos, position| servos.place_near(0, position))
    });
    add(4096, &|raw| {
        let read =
            |servos: &mut Servos<_, 1>| ready(servos.positions_async()).map(|[position]| position);
        encoder(servos(raw), read, |servos, position| servos.place_near(0, position))
    });
    all
}

/// A joint whose encoder is at its motor, and its position.
fn motor(range: JointRange) -> Start {
    Start { zero: 2.4, direction: Direction::Reverse, ratio: 100.0, range, truth: 0.5 }
}

fn mapping(start: &Start) -> EncoderMapping {
    let mapping = JointMapping::new(start.zero, start.direction, start.ratio).unwrap();
    mapping.with_range(start.range, STEP).unwrap()
}

/// The ways in which readings are missing.
const WAYS: [fn(&Count, &mut Encoder, u32); 2] = [
    |raw, encoder, readings| {
        raw.set(GONE);
        for _ in 0..readings {
            assert_eq!(encoder(Do::Read), Err(Fault::Encoder { joint: 0 }));
        }
    },
    |_, encoder, readings| {
        let _ = encoder(Do::Miss(readings));
    },
];

#[test]
fn after_half_a_turn_without_a_reading_the_position_is_unknown() {
    const LOST: Result<f32, Fault> = Err(Fault::LostTurn { joint: 0 });
    let start = motor(JointRange::Near(0.5));
    for way in WAYS {
        for (counts, raw, mut encoder) in drivers(mapping(&start)) {
            let at = |encoder: &mut Encoder, q| {
                raw.set(start.count(q, counts));
                encoder(Do::Read)
            };
            let is = |found: Result<f32, Fault>, q| {
                assert!(start.accepts(found.unwrap(), q, counts as f64), "{counts}: {found:?} {q}");
            };
            is(at(&mut encoder, 0.5), 0.5);
            // As far as it can have come in the allowed gap, in either direction.
            for q in [0.529, 0.5] {
                way(&raw, &mut encoder, ALLOWED);
                is(at(&mut encoder, q), q);
            }
            way(&raw, &mut encoder, ALLOWED + 1);
            for _ in 0..1000 {
                assert_eq!(at(&mut encoder, 0.533), LOST, "{counts}");
            }
            // A gap does not end it either.
            way(&raw, &mut encoder, 1);
            assert_eq!(at(&mut encoder, 0.533), LOST);
            encoder(Do::Place(1.2)).unwrap();
            is(at(&mut encoder, 1.21), 1.21);
            way(&raw, &mut encoder, ALLOWED);
            is(at(&mut encoder, 1.2), 1.2);
        }
    }
}

#[test]
fn a_joint_within_its_range_is_known_after_any_gap() {
    let range = JointRange::Within { lower: -1.2, upper: 1.2 };
    for (ratio, range) in [(1.0, range), (1.0, JointRange::Continuous)] {
        let start = Start { ratio, ..motor(range) };
        for way in WAYS {
            for (counts, raw, mut encoder) in drivers(mapping(&start)) {
                for q in [0.5, -1.2, 1.2, -1.19, 0.0] {
                    raw.set(start.count(q, counts));
                    let found = encoder(Do::Read).unwrap();
                    assert!(start.accepts(found, q, counts as f64), "{found} {q}");
                    way(&raw, &mut encoder, 100_000);
                }
            }
        }
    }
}

#[test]
fn a_servo_behind_one_that_is_silent_has_a_gap_too() {
    let start = motor(JointRange::Near(0.5));
    let bus = Bus::at(start.count(0.5, 4096));
    let here = bus.count.clone();
    // Servo 2 never replies: no reading of servo 3 either.
    let mut servos = Servos::new(bus, [1, 2, 3], [mapping(&start); 3]).unwrap();
    for _ in 0..100 {
        assert_eq!(servos.positions(), Err(FeetechError::NoReply { id: 2 }));
        assert_eq!(ready(servos.positions_async()), Err(FeetechError::NoReply { id: 2 }));
    }
    here.set(GONE);
    for _ in 0..=ALLOWED {
        assert_eq!(servos.positions(), Err(FeetechError::NoReply { id: 1 }));
    }
    here.set(start.count(0.5, 4096));
    assert_eq!(servos.positions(), Err(FeetechError::LostTurn { joint: 0 }));
    assert_eq!(servos.set_positions(&[0.5; 3]), Err(FeetechError::Goal { joint: 0 }));
}

/// An incremental encoder of 400,000 counts per turn, whose counter wraps in a sixth of a turn, at
/// a count and an index.
fn incremental(range: JointRange) -> (Count, Rc<Cell<Option<u16>>>, Encoder) {
    let (raw, index) = (count(0), Rc::new(Cell::new(None)));
    let (counts, indices) = (raw.clone(), index.clone());
    let timer = (move || counts.get(), move || indices.take());
    let mapping = JointMapping::IDENTITY.with_range(range, 0.05).unwrap();
    let resolution = Resolution::new(400_000).unwrap();
    let joint = IncrementalEncoder::new(timer, resolution, mapping).unwrap();
    let all = encoder(joint, IncrementalEncoder::read, IncrementalEncoder::place_near);
    (raw, index, all)
}

#[test]
fn a_counter_that_can_have_wrapped_needs_its_index_or_its_place() {
    // 2¹⁵ counts are 0.515 rad: ten ticks of 0.05 rad fit, eleven do not.
    let unknown = Err(Fault::Encoder { joint: 0 });
    let within = JointRange::Within { lower: -1.0, upper: 1.0 };
    for (range, after) in
        [(within, unknown), (JointRange::Near(0.1), Err(Fault::LostTurn { joint: 0 }))]
    {
        let (raw, index, mut encoder) = incremental(range);
        assert_eq!(encoder(Do::Read), unknown);
        index.set(Some(65_000));
        let is = |found: Result<f32, Fault>, counts: f64| {
            let off = f64::from(found.unwrap()) - counts * TAU / 400_000.0;
            assert!(off.abs() < 1e-6, "{range:?}: {found:?} {counts}");
        };
        is(encoder(Do::Read), 536.0);
        encoder(Do::Miss(9)).unwrap();
        raw.set(30_000);
        is(encoder(Do::Read), 30_536.0);
        encoder(Do::Miss(10)).unwrap();
        assert_eq!(encoder(Do::Read), after);
        index.set(Some(29_000));
        let Err(Fault::LostTurn { .. }) = after else {
            is(encoder(Do::Read), 1000.0);
            continue;
        };
        for _ in 0..100 {
            assert_eq!(encoder(Do::Read), after);
        }
        encoder(Do::Place(7.0)).unwrap();
        assert_eq!(encoder(Do::Read), unknown);
        index.set(Some(29_000));
        is(encoder(Do::Read), 401_000.0);
    }
}
