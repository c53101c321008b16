//! Noise, an encoder, a friction model and a load that are not as stated.

use core::ops::Range;

use dynamics_core::model::BodyInertia;
use motion_control::estimate::{PayloadEstimator, RejectedMeasurement};

use crate::payload_estimator::arm::{GOOD, LOAD, Run, Tick, measure};
use crate::payload_estimator::{errors, estimator, limited, offer};

/// The ticks of a fault, of a run whose other ticks are good.
const FAULT: Range<usize> = 3000..5000;
const TICKS: usize = 8000;

fn with_fault(faulty: Run) -> Vec<Tick> {
    let run = |run: Run| measure(&Run { ticks: TICKS, ..run });
    let mut ticks = run(GOOD);
    ticks[FAULT].copy_from_slice(&run(faulty)[FAULT]);
    ticks
}

/// The trace of a fault in an estimator: the errors at its end, why the last of its ticks was
/// rejected, how many of them were accepted, and whether the estimate is frozen at the end of the
/// run.
struct Outcome {
    errors: (f64, f64),
    last: Option<RejectedMeasurement>,
    accepted: usize,
    frozen: bool,
}

fn after(mut single: PayloadEstimator<f32, 6>, ticks: &[Tick]) -> Outcome {
    let (mut accepted, mut last, mut errors_then) = (0, None, (0.0, 0.0));
    for (k, (y, z)) in ticks.iter().enumerate() {
        let y = y.map(|row| row.map(|x| x as f32));
        let result = single.update(&y, &z.map(|z| z as f32));
        if FAULT.contains(&k) {
            accepted += usize::from(result.is_ok());
            (last, errors_then) = (result.err(), errors(&single, &LOAD));
        }
    }
    Outcome { errors: errors_then, last, accepted, frozen: single.frozen() }
}

#[test]
fn bad_input_freezes_the_estimate_until_good_input() {
    let nan = || {
        let mut ticks = with_fault(GOOD);
        for (_, z) in &mut ticks[FAULT] {
            z[4] = f64::NAN;
        }
        ticks
    };
    // Eight deviations of the prior.
    let heavy = BodyInertia { mass: 40.0, ..LOAD };
    let frozen = RejectedMeasurement::Frozen;
    let cases = [
        ("noise", with_fault(Run { noise: 10.0, ..GOOD }), frozen),
        ("encoder", with_fault(Run { stuck: FAULT, ..GOOD }), frozen),
        ("friction", with_fault(Run { friction: -1.0, ..GOOD }), frozen),
        ("load", with_fault(Run { changed: Some((0, heavy)), ..GOOD }), frozen),
        ("NaN", nan(), RejectedMeasurement::NotFinite { joint: 4 }),
    ];
    for (name, ticks, reason) in cases {
        let [gated, free] = [limited(), estimator(0.0)].map(|single| after(single, &ticks));
        println!("{name}: {:?} of {:?}, {} accepted", gated.errors, free.errors, gated.accepted);
        assert!(gated.errors.0 < 0.02 && gated.errors.1 < 5e-3, "{name}: {:?}", gated.errors);
        assert_eq!((gated.last, gated.frozen), (Some(reason), false), "{name}");
        assert!(gated.accepted < 100, "{name}: {}", gated.accepted);
        let spoiled = free.errors.0 > 0.05 || free.errors.1 > 0.01;
        assert!(spoiled || matches!(name, "noise" | "NaN"), "{name}: {:?}", free.errors);
    }
}

#[test]
fn a_wrong_first_estimate_does_not_last() {
    let mut ticks = measure(&GOOD);
    for (_, z) in &mut ticks[..200] {
        *z = z.map(|z| -5.0 * z);
    }
    let mut single = limited::<f32>();
    for tick in &ticks {
        let _ = offer(&mut single, tick);
    }
    let (mass, centre) = errors(&single, &LOAD);
    assert!(mass < 0.02 && centre < 5e-3, "{mass:.1e} {centre:.1e}");
}
