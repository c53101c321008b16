//! The recursion against least squares of all rows at once, and its forgetting.

use motion_control::{ParameterEstimator, ParameterEstimatorConfig};

use crate::parameter_estimator::arm::*;
use crate::parameter_estimator::learner::*;

/// The solution of a x = b by elimination with pivots on the diagonal, of a positive definite
/// matrix.
fn solved(mut a: Vec<[f64; P]>, mut b: [f64; P]) -> [f64; P] {
    for k in 0..P {
        for i in 0..P {
            if i != k {
                let (pivot, factor) = (a[k], a[i][k] / a[k][k]);
                a[i].iter_mut()
                    .zip(pivot)
                    .for_each(|(a, p)| *a -= factor * p);
                b[i] -= factor * b[k];
            }
        }
    }
    core::array::from_fn(|k| b[k] / a[k][k])
}

// The estimate in f32 follows.
#[test]
fn the_estimate_and_deviations_are_those_of_least_squares() {
    let learner = Learner::new(2, 0.0, 1000.0);
    let ParameterEstimatorConfig { noise, prior, .. } = config(&learner.base, 0.0, 1000.0);
    let config = ParameterEstimatorConfig {
        noise: noise.map(f64::from),
        prior: prior.map(f64::from),
        own: learner.base.own(6, OWN),
        forgetting: 0.0,
        limit: 1000.0,
    };
    let mut double = ParameterEstimator::try_new(config).expect("a good one");
    let mut single = learner.estimator;
    let (mut a, mut b) = (vec![[0.0; P]; P], [0.0; P]);
    for (k, row) in a.iter_mut().enumerate() {
        row[k] = config.prior[k].powi(-2);
    }
    for (_, row) in &minute(2)[..5000] {
        let (y, z) = learner.row(row);
        single.update(row.joint, &y, z).expect("a good row");
        let (y, z) = (y.map(f64::from), f64::from(z));
        double.update(row.joint, &y, z).expect("a good row");
        let weight = config.noise[row.joint].powi(-2);
        for k in 0..P {
            b[k] += weight * y[k] * z;
            (0..P).for_each(|l| a[k][l] += weight * y[k] * y[l]);
        }
    }
    let want = solved(a.clone(), b);
    for (k, want) in want.into_iter().enumerate() {
        let unit = core::array::from_fn(|i| f64::from(u8::from(i == k)));
        let deviation = solved(a.clone(), unit)[k].sqrt();
        let apart = (double.estimate()[k] - want).abs() / deviation;
        let ratio = double.deviations()[k] / deviation - 1.0;
        assert!(
            apart < 1e-7 && ratio.abs() < 1e-7,
            "{k}: {apart:.1e} {ratio:.1e}"
        );
        // Far within what the noise leaves uncertain.
        let apart = (f64::from(single.estimate()[k]) - want).abs() / deviation;
        let ratio = f64::from(single.deviations()[k]) / deviation - 1.0;
        assert!(
            apart < 1e-3 && ratio.abs() < 4e-5,
            "{k}: {apart:.1e} {ratio:.1e}"
        );
    }
}

/// One of them processes all 24 places of each row.
// Own parameters are of one joint alone, and declaring them changes only the work of a row.
#[test]
fn declaring_own_parameters_does_not_change_the_estimate() {
    let learner = Learner::new(3, FORGETTING, LIMIT);
    let given = config(&learner.base, FORGETTING, LIMIT);
    assert!(given.own.iter().all(|own| *own > 0), "{:?}", given.own);
    let of = |own| {
        let config = ParameterEstimatorConfig {
            noise: given.noise.map(f64::from),
            prior: given.prior.map(f64::from),
            own,
            forgetting: f64::from(FORGETTING),
            limit: f64::from(LIMIT),
        };
        ParameterEstimator::try_new(config).expect("a good one")
    };
    let (mut all, mut apart): (ParameterEstimator<f64, P, 6>, _) = (of([0; 6]), of(given.own));
    let mut rejected = 0;
    for (_, row) in &minute(3)[..5000] {
        let (y, z) = learner.row(row);
        let (y, z) = (y.map(f64::from), f64::from(z));
        let explained = [&all, &apart].map(|one| one.explained(row.joint, &y));
        assert!((explained[0] - explained[1]).abs() < 1e-9, "{explained:?}");
        let updates = [&mut all, &mut apart].map(|one| one.update(row.joint, &y, z));
        assert_eq!(updates[0], updates[1]);
        rejected += usize::from(updates[0].is_err());
    }
    assert!((1..2500).contains(&rejected), "{rejected}");
    let (dense, sparse) = (all.estimate(), apart.estimate());
    let pairs = all.deviations().into_iter().zip(apart.deviations());
    for (k, (deviation, other)) in pairs.enumerate() {
        let distance = (dense[k] - sparse[k]).abs() / deviation;
        let ratio = other / deviation - 1.0;
        assert!(
            distance < 1e-8 && ratio.abs() < 1e-8,
            "{k}: {distance:.1e} {ratio:.1e}"
        );
    }
}

// No parameter becomes less certain.
#[test]
fn a_forgetting_estimator_follows_changing_friction() {
    let of = |forgetting| {
        let mut learner = Learner::new(1, forgetting, 100.0);
        let mut deviations = learner.estimator.deviations();
        for (k, row) in minute(1) {
            let mut row = *row;
            if *k >= LEARNED {
                row.tau += 0.05 * row.own[1];
            }
            let _ = learner.add(&row);
            let now = learner.estimator.deviations();
            let grown = now
                .iter()
                .zip(deviations)
                .any(|(now, before)| *now > 1.0001 * before);
            assert!(!grown, "{now:?} {deviations:?}");
            deviations = now;
        }
        let coulomb = truth()[60 + 1];
        (learner.found()[60 + 1] - coulomb) / 0.05
    };
    let (forgets, remembers) = (of(2e-3), of(0.0));
    assert!((forgets - 1.0).abs() < 0.25, "{forgets:.2}");
    assert!(remembers < 0.65, "{remembers:.2}");
}
