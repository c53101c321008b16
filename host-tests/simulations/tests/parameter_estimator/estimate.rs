//! The torques that the estimate gives elsewhere, and the selection of its parameters.

use dynamics_core::state::State;
use motion_control::estimate::{ParameterEstimator, ParameterEstimatorConfig, SelectedParameters};

use crate::common::Rng;
use crate::parameter_estimator::arm::*;
use crate::parameter_estimator::learner::*;
use crate::parameter_estimator::stored::stored_of;

// They start 30 % off, and then give the torques of another path within 5 %.
#[test]
fn half_a_minute_of_motion_identifies_24_parameters() {
    for seed in 1..4 {
        let learner = learned(seed, FORGETTING);
        let mut stored = stored_of(&learner.nominal);
        stored.update(&learner.base, &learner.estimator.estimate());
        let (before, found) = (validation(&learner.nominal), validation(&learner.found()));
        let kept = validation(&stored.parameters().map(f64::from));
        assert!(before.0 > 0.2, "{before:?}");
        assert!(found.0 < 0.03 && found.1 < 0.05, "{found:?}");
        assert!(kept.0 < 0.03 && kept.1 < 0.05, "{kept:?}");
        assert_eq!(learner.estimator.frozen(), None);
        let levels = learner.estimator.consistency();
        assert!(levels.iter().all(|level| *level < 2.0), "{levels:?}");
    }
}

/// One of the first body and seven of each of the others, five of each joint, less the armatures of
/// the first two joints, whose columns are those of inertias about their axes.
const RANK: usize = 1 + 5 * 7 + 6 * OWN - 2;

#[test]
fn selected_base_parameters_give_the_torques_of_all_parameters() {
    let nominal = nominal(1);
    let rank = base_of::<f64, N>(&nominal).expect_err("more columns than are independent");
    assert_eq!(rank, RANK);
    let base = base_of::<f64, RANK>(&nominal).expect("all of them");
    let few = base_of::<f64, P>(&nominal).expect("a part of them");
    let (mut rng, mut worst, mut part) = (Rng::new(3), 0.0, 0.0);
    for k in 0..300 {
        let state = State { q: rng.vector(1.5), qd: rng.vector(3.0), qdd: rng.vector(10.0) };
        let row: Row<f64> = Row::of(k % 6, &state, 0.0).loaded(0.5);
        worst = f64::max(worst, contradiction(&base, &row, &mut rng));
        part = f64::max(part, contradiction(&few, &row, &mut rng));
    }
    assert!(worst < 2e-12, "{worst:.1e}");
    assert!(part > 1e-3, "{part:.1e}");
}

/// The smallest deviation of the prior is 4.3 · 10⁻⁷ kg·m², of a product of inertia of the jaw.
// They give the torques of another path.
#[test]
fn all_64_base_parameters_are_estimated_in_f32() {
    let mut learner = Learner::new(1, FORGETTING, LIMIT);
    let base = base_of::<f32, RANK>(&learner.nominal).expect("all of them");
    assert!(base.prior.iter().any(|prior| *prior < 1e-6));
    let mut all: Box<ParameterEstimator<f32, RANK, 6>> = Box::new(
        ParameterEstimator::try_new(ParameterEstimatorConfig {
            noise: STATED.map(|x| x as f32),
            prior: base.prior,
            own: base.own(6, OWN),
            forgetting: FORGETTING,
            limit: LIMIT,
        })
        .expect("a good one"),
    );
    for (_, row) in minute(1).iter().filter(|(k, _)| *k < LEARNED) {
        // The load of the gears by the estimate of 24.
        let (_, residual) = learner.row(row);
        let load = row.tau - residual;
        let _ = learner.add(row);
        let loaded = row.loaded(f64::from(load));
        let y = base.row(row.joint, &loaded.bodies, &loaded.own);
        let _ = all.update(row.joint, &y, residual);
    }
    let change = base.change(&all.estimate());
    let found = core::array::from_fn(|k| learner.nominal[k] + f64::from(change[k]));
    let error = validation(&found);
    assert!(error.0 < 0.05, "{error:?}");
    let deviations = all.deviations();
    let mut pairs = deviations.iter().zip(&base.prior);
    assert!(pairs.all(|(now, prior)| *now > 0.0 && now <= prior));
}

#[test]
fn an_estimator_of_24_parameters_takes_2768_bytes() {
    assert_eq!(size_of::<ParameterEstimator<f32, 24, 6>>(), 2768);
}

/// The torque of all parameters less that of the base parameters, for a change of these.
fn contradiction<const P: usize>(
    base: &SelectedParameters<f64, P, N>,
    row: &Row<f64>,
    rng: &mut Rng,
) -> f64 {
    let estimate: [f64; P] = base.prior.map(|prior| prior * rng.within(1.0));
    let y = base.row(row.joint, &row.bodies, &row.own);
    (row.torque(&base.change(&estimate)) - dot(&y, &estimate)).abs()
}
