//! Torques, encoders, models and configurations that are wrong.

use crate::common::Rng;
use crate::parameter_estimator::arm::*;
use crate::parameter_estimator::learner::*;

/// The effect of ten seconds of a fault on a learner: the error of its torques and the joint that
/// has frozen it at their end and 20 s later, and how many rows were accepted meanwhile.
struct Outcome {
    errors: [f64; 2],
    frozen: [Option<usize>; 2],
    accepted: usize,
}

const FAULTY: core::ops::Range<usize> = LEARNED..LEARNED + 5000;

type Change = fn(&mut Row, &mut [f64; N], &mut Rng);

fn after_fault(limit: f32, rows: &[(usize, Row)], change: Change) -> Outcome {
    let (mut rng, mut learner) = (Rng::new(5), Learner::new(1, FORGETTING, limit));
    let (nominal, mut accepted, mut at_end) = (learner.nominal, 0, None);
    for (k, mut row) in rows.iter().copied() {
        if FAULTY.contains(&k) {
            change(&mut row, &mut learner.nominal, &mut rng);
            accepted += usize::from(learner.add(&row).is_ok());
            learner.nominal = nominal;
        } else {
            if k >= FAULTY.end && at_end.is_none() {
                at_end = Some((validation(&learner.found()).0, learner.estimator.frozen()));
            }
            let _ = learner.add(&row);
        }
    }
    let (error, frozen) = at_end.expect("rows after the fault");
    Outcome {
        errors: [error, validation(&learner.found()).0],
        frozen: [frozen, learner.estimator.frozen()],
        accepted,
    }
}

pub fn noise(row: &mut Row, _: &mut [f64; N], rng: &mut Rng) {
    row.tau += (10.0 * STATED[row.joint] * normal(rng)) as f32;
}

fn wrong_friction(_: &mut Row, nominal: &mut [f64; N], _: &mut Rng) {
    for joint in nominal[60..].as_chunks_mut::<OWN>().0 {
        (joint[0], joint[1]) = (-joint[0], -joint[1]);
    }
}

fn nan(row: &mut Row, _: &mut [f64; N], _: &mut Rng) {
    if row.joint == 3 {
        row.tau = f32::NAN;
    }
}

/// Without the limit, friction of the wrong sign and an encoder that sticks spoil the estimate, and
/// noise passes.
// Twenty seconds later the estimation goes on.
#[test]
fn bad_input_freezes_the_estimate_and_names_the_joint() {
    let stuck = run(&nominal(1), 2 * LEARNED, FAULTY);
    let faults: [(&[_], Change); 4] =
        [(minute(1), nan), (minute(1), noise), (minute(1), wrong_friction), (&stuck, |_, _, _| ())];
    for (k, (rows, change)) in faults.into_iter().enumerate() {
        let (limited, free) = (after_fault(LIMIT, rows, change), after_fault(1000.0, rows, change));
        assert!(limited.errors.iter().all(|error| *error < 0.03), "{:?}", limited.errors);
        assert!(limited.frozen[0].is_some() && limited.frozen[1].is_none(), "{:?}", limited.frozen);
        assert!(limited.accepted < 200, "{}", limited.accepted);
        match k {
            0 => assert_eq!(limited.frozen[0], Some(3)),
            1 => assert!(free.accepted > 4000 && free.frozen[0].is_none()),
            _ => assert!(free.errors[0] > 0.2, "{:?}", free.errors),
        }
    }
}
