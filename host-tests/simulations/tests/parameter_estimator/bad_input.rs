//! Torques, encoders, models and configurations that are wrong.

use motion_control::{
    ConfigError, ConfigParameter, ImpossibleParameters, ParameterEstimator,
    ParameterEstimatorConfig, PhysicalParameters, RejectedRow,
};

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
    let faults: [(&[_], Change); 4] = [
        (minute(1), nan),
        (minute(1), noise),
        (minute(1), wrong_friction),
        (&stuck, |_, _, _| ()),
    ];
    for (k, (rows, change)) in faults.into_iter().enumerate() {
        let (limited, free) = (
            after_fault(LIMIT, rows, change),
            after_fault(1000.0, rows, change),
        );
        assert!(
            limited.errors.iter().all(|error| *error < 0.03),
            "{:?}",
            limited.errors
        );
        assert!(
            limited.frozen[0].is_some() && limited.frozen[1].is_none(),
            "{:?}",
            limited.frozen
        );
        assert!(limited.accepted < 200, "{}", limited.accepted);
        match k {
            0 => assert_eq!(limited.frozen[0], Some(3)),
            1 => assert!(free.accepted > 4000 && free.frozen[0].is_none()),
            _ => assert!(free.errors[0] > 0.2, "{:?}", free.errors),
        }
    }
}

// Neither the estimate nor its deviations change.
#[test]
fn a_refused_row_has_a_reason_and_changes_nothing() {
    let mut learner = learned(1, FORGETTING);
    let (_, row) = minute(1)[LEARNED - 1000];
    let (y, residual) = learner.row(&row);
    let before = learner.estimator;
    let same = |now: &ParameterEstimator<f32, P, 6>| {
        now.estimate() == before.estimate() && now.deviations() == before.deviations()
    };
    let joint = row.joint;
    for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e30] {
        let reason = match bad.is_finite() {
            true => Err(RejectedRow::TooLarge { joint }),
            false => Err(RejectedRow::NotFinite { joint }),
        };
        let mut wrong = y;
        wrong[0] = bad;
        assert_eq!(learner.estimator.update(joint, &y, bad), reason);
        assert_eq!(learner.estimator.update(joint, &wrong, residual), reason);
    }
    let outlier = learner.estimator.update(joint, &y, residual + 1.0);
    assert_eq!(outlier, Err(RejectedRow::Outlier { joint }));
    assert!(same(&learner.estimator));
    assert_eq!(
        learner.estimator.rejected()[joint],
        before.rejected()[joint] + 9
    );
    assert_eq!(learner.estimator.update(6, &y, f32::NAN), Ok(())); // no such joint
    // Another twenty, and rows of every joint are refused because of this one.
    for _ in 0..20 {
        let _ = learner.estimator.update(joint, &y, f32::NAN);
    }
    let other = (joint + 1) % 6;
    let update = learner.estimator.update(other, &[0.0; P], 0.0);
    assert_eq!(update, Err(RejectedRow::Frozen { joint }));
    let update = learner.estimator.update(other, &y, residual);
    assert_eq!(update, Err(RejectedRow::OtherJoint { joint: other }));
    assert!(same(&learner.estimator));
    assert_eq!(
        learner.estimator.update(joint, &[0.0; P], 0.0),
        Err(RejectedRow::Frozen { joint })
    );
    learner.estimator.reopen();
    assert_eq!(learner.estimator.update(joint, &y, residual), Ok(()));
    assert!(!same(&learner.estimator));
}

/// Rows of good torques, but for those of joint 2.
fn others(learner: &Learner) -> impl Iterator<Item = (usize, [f32; P], f32)> {
    let rows = minute(1)
        .iter()
        .filter(|(k, row)| *k >= LEARNED && row.joint != 2);
    rows.map(|(_, row)| {
        let (y, residual) = learner.row(row);
        (row.joint, y, residual)
    })
}

// It ends after 1024 good rows of other joints, and the next row of its own joint renews it.
#[test]
fn a_freeze_by_a_resting_joint_ends() {
    let mut learner = learned(1, FORGETTING);
    let frozen = Err(RejectedRow::Frozen { joint: 2 });
    let hit = |learner: &mut Learner| {
        for _ in 0..100 {
            let _ = learner.estimator.update(2, &[0.0; P], 100.0);
        }
        assert_eq!(learner.estimator.frozen(), Some(2));
    };
    hit(&mut learner);
    let rows: Vec<_> = others(&learner).collect();
    let until = |learner: &mut Learner, change: fn(usize, f32) -> f32| {
        let mut updates = rows.iter().map(|(joint, y, residual)| {
            learner
                .estimator
                .update(*joint, y, change(*joint, *residual))
        });
        updates.position(|update| update.is_ok())
    };
    // The row that ends the freeze is the first one that is added; a few are beyond the limit, and
    // not counted.
    let count = until(&mut learner, |_, residual| residual).expect("an end");
    assert!((1023..1040).contains(&count), "{count}");
    let (joint, y, residual) = rows[0];
    assert_eq!(learner.estimator.frozen(), None);
    assert_eq!(learner.estimator.update(2, &[0.0; P], 0.0), frozen);
    assert_eq!(learner.estimator.update(joint, &y, residual), frozen);
    let own = (0..200).position(|_| learner.estimator.update(2, &[0.0; P], 0.0).is_ok());
    assert!(own.is_some_and(|own| own > 64), "{own:?}");
    assert_eq!(learner.estimator.update(joint, &y, residual), Ok(()));
    // Neither while another joint contradicts the estimate too, nor while the joint itself has
    // rows.
    hit(&mut learner);
    let other = |joint, residual: f32| if joint == 3 { residual + 1.0 } else { residual };
    assert_eq!(until(&mut learner, other), None);
    hit(&mut learner);
    for (k, (joint, y, residual)) in rows.iter().enumerate() {
        if k % 1000 == 0 {
            assert_eq!(learner.estimator.update(2, &[0.0; P], 100.0).ok(), None);
        }
        assert_eq!(learner.estimator.update(*joint, y, *residual).ok(), None);
    }
}

#[test]
fn invalid_configurations_and_impossible_arms_are_refused() {
    let good = config(&Learner::new(1, 0.0, 5.0).base, 0.0, 5.0);
    let refused = |config| ParameterEstimator::<f32, P, 6>::try_new(config).err();
    let named = |parameter| Some(ConfigError::OutOfRange { parameter });
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY, 9e-13, 1e7] {
        let (mut noisy, mut prior) = (good, good);
        (noisy.noise[5], prior.prior[P - 1]) = (bad, bad);
        assert_eq!(refused(noisy), named(ConfigParameter::TorqueNoise));
        assert_eq!(refused(prior), named(ConfigParameter::ParameterDeviation));
    }
    for bad in [-0.1, 1.0, f32::NAN] {
        let wrong = ParameterEstimatorConfig {
            forgetting: bad,
            ..good
        };
        assert_eq!(refused(wrong), named(ConfigParameter::Forgetting));
    }
    let more = ParameterEstimatorConfig {
        own: [5, 5, 5, 5, 5, 0],
        ..good
    };
    assert_eq!(refused(more), named(ConfigParameter::OwnParameters));
    for bad in [2.9, 1001.0, f32::NAN] {
        let wrong = ParameterEstimatorConfig { limit: bad, ..good };
        assert_eq!(refused(wrong), named(ConfigParameter::InnovationLimit));
    }
    assert_eq!(refused(good), None);
    let refused = |change: fn(&mut [f64; N])| {
        let mut all = nominal(1);
        change(&mut all);
        PhysicalParameters::<f64, 6, N>::try_new(all).err()
    };
    let body = |body| Some(ImpossibleParameters::Body { body });
    assert_eq!(refused(|_| ()), None);
    assert_eq!(refused(|all| all[20] = -all[20]), body(2));
    assert_eq!(refused(|all| all[59] += 2.0 * (all[54] + all[56])), body(5));
    assert_eq!(refused(|all| all[30] = f64::NAN), body(3));
    let infinite =
        |all: &mut [f64; N]| all[30..34].copy_from_slice(&[f64::INFINITY, 0.0, 0.0, 0.0]);
    assert_eq!(refused(infinite), body(3));
    for place in [10, 11, 14, 15, 19] {
        let mut all = nominal(1);
        all[place] = f64::INFINITY;
        let error = PhysicalParameters::<f64, 6, N>::try_new(all).err();
        assert_eq!(error, body(1), "{place}");
    }
    let joint = Some(ImpossibleParameters::Joint { parameter: 1 });
    assert_eq!(refused(|all| all[61] = -0.1), joint);
}
