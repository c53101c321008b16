//! An arm that stands.

use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach as so101;

use crate::common::Rng;
use crate::parameter_estimator::arm::*;
use crate::parameter_estimator::learner::*;

/// Rows of an arm that stands while its encoders flicker, with the torque of the estimate or of all
/// parameters that it implies.
fn standing(learner: &Learner, by_all: bool) -> Vec<(usize, [f32; P], f32)> {
    let mut rng = Rng::new(9);
    let (found, step) = (learner.found(), f64::from(so101::RESOLUTION));
    let rows = (0..96).map(|k| {
        let at = State {
            q: [0.1, -0.5, 0.6, 0.4, 0.3, 0.7].map(|q| q + step * rng.within(0.5)),
            qd: rng.vector(0.01),
            qdd: [0.0; 6],
        };
        let mut row = Row::of(k % 6, &at, 0.0);
        row.tau = row.loaded(row.torque(&found)).torque(&found) as f32;
        let (y, residual) = learner.row(&row);
        let explained = learner.estimator.explained(row.joint, &y);
        (row.joint, y, if by_all { residual } else { explained })
    });
    rows.collect()
}

#[test]
fn without_excitation_nothing_drifts() {
    let rows = if cfg!(feature = "full") { 1_800_000 } else { 90_000 };
    let start = learned(1, 1e-3);
    let deviations = start.estimator.deviations().map(f64::from);
    let drift = |after: [f64; P]| {
        let before = start.estimator.estimate();
        let moved = (0..P).map(|k| (after[k] - f64::from(before[k])).abs() / deviations[k]);
        moved.fold(0.0, f64::max)
    };
    for by_all in [false, true] {
        let (mut rng, stands) = (Rng::new(8), standing(&start, by_all));
        let (mut learner, mut plain) = (start.clone(), Plain::of(&start));
        for k in 0..rows {
            let (joint, y, residual) = stands[rng.below(stands.len())];
            let sigma = STATED[joint];
            let residual = residual + (sigma * normal(&mut rng)) as f32;
            let _ = learner.estimator.update(joint, &y, residual);
            if k < 30_000 {
                plain.add(&y.map(|y| f64::from(y) / sigma), f64::from(residual) / sigma);
            }
        }
        let after = learner.estimator.estimate().map(f64::from);
        assert!(drift(plain.theta) > 1e3, "{:.1e}", drift(plain.theta));
        // White noise spreads the estimate by at most half of its variance: of 24 parameters the
        // worst is within two deviations.
        assert!(by_all || drift(after) < 2.0, "{:.1e}", drift(after));
        // The unexplained part of a posture moves the 24 parameters, but not their torques
        // elsewhere.
        let error = validation(&learner.found());
        assert!(error.0 < 0.03 && error.1 < 0.05, "{error:?}");
    }
}

/// Recursive least squares with the same forgetting in all directions, by the covariance; σ of the
/// torques is 1.
struct Plain {
    theta: [f64; P],
    p: [[f64; P]; P],
}

impl Plain {
    fn of(learner: &Learner) -> Self {
        let deviations = learner.estimator.deviations().map(f64::from);
        Self {
            theta: learner.estimator.estimate().map(f64::from),
            p: core::array::from_fn(|i| {
                core::array::from_fn(|j| if i == j { deviations[i].powi(2) } else { 0.0 })
            }),
        }
    }

    fn add(&mut self, y: &[f64; P], z: f64) {
        let kept = 1.0 - 1e-3;
        let p_y = self.p.map(|row| dot(&row, y));
        let gain = p_y.map(|x| x / (kept + dot(y, &p_y)));
        let error = z - dot(y, &self.theta);
        for ((theta, row), gain) in self.theta.iter_mut().zip(&mut self.p).zip(gain) {
            *theta += gain * error;
            for (p, p_y) in row.iter_mut().zip(p_y) {
                *p = (*p - gain * p_y) / kept;
            }
        }
    }
}
