//! Claims about the estimator of a load, on a simulated UR5e with encoders of 14 bits and noisy
//! torques.

mod arm;
mod bad_input;

use self::arm::{GOOD, LOAD, NOISE, PRIOR, Run, Tick, WRIST, measure, normal, reference};
use crate::common::Rng;
use dynamics_core::Core;
use dynamics_core::effects::{Payload, RIGID_BODY};
use dynamics_core::model::BodyInertia;
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use motion_control::estimate::{PayloadEstimator, PayloadEstimatorConfig, RejectedMeasurement};

/// Limit of the innovations of a tick.
const LIMIT: f64 = 5.0;

fn config<R: Real>(forgetting: f64) -> PayloadEstimatorConfig<R, 6> {
    PayloadEstimatorConfig {
        noise: NOISE.map(R::from_f64),
        prior: PRIOR.map(R::from_f64),
        forgetting: R::from_f64(forgetting),
        limit: R::from_f64(1000.0),
    }
}

fn estimator<R: Real>(forgetting: f64) -> PayloadEstimator<R, 6> {
    PayloadEstimator::try_new(config(forgetting)).expect("a good one")
}

/// An estimator that rejects ticks.
fn limited<R: Real>() -> PayloadEstimator<R, 6> {
    let limit = R::from_f64(LIMIT);
    PayloadEstimator::try_new(PayloadEstimatorConfig { limit, ..config(0.0) }).expect("a good one")
}

fn estimated<R: Real>(single: &PayloadEstimator<R, 6>) -> (SpatialInertia<R>, [R; 10]) {
    (single.inertia(), single.deviations())
}

/// A tick that may be rejected: at the start the feedback has not yet found the load.
fn offer<R: Real>(
    estimator: &mut PayloadEstimator<R, 6>,
    (y, z): &Tick,
) -> Result<(), RejectedMeasurement> {
    let y = y.map(|row| row.map(R::from_f64));
    estimator.update(&y, &z.map(R::from_f64))
}

fn add<R: Real>(estimator: &mut PayloadEstimator<R, 6>, tick: &Tick) {
    offer(estimator, tick).expect("finite");
}

/// The relative error of the mass, and the distance of the centres, m.
fn errors<R: Real>(estimator: &PayloadEstimator<R, 6>, truth: &BodyInertia<f64>) -> (f64, f64) {
    let found = BodyInertia::about_com(&estimator.inertia());
    let apart = |i: usize| found.com[i].to_f64() - truth.com[i];
    let distance = (0..3).map(|i| apart(i) * apart(i)).sum::<f64>().sqrt();
    ((found.mass.to_f64() / truth.mass - 1.0).abs(), distance)
}

// The mass is within 2 % and the centre of mass within 5 mm, in f32.
#[test]
fn five_seconds_of_motion_identify_the_payload() {
    for (seed, friction) in [(1, 1.0), (2, 1.0), (3, 1.0), (1, 0.9), (1, 1.1)] {
        let mut single = limited::<f32>();
        for tick in measure(&Run { seed, friction, ..GOOD }) {
            let _ = offer(&mut single, &tick);
        }
        assert!(!single.frozen() && single.consistency() < 6.0);
        let (mass, centre) = errors(&single, &LOAD);
        assert!(mass < 0.02 && centre < 5e-3, "{seed}: {mass:.1e} {centre:.1e}");
    }
}

/// Torques of the other sign, and two components exchanged, miss the bars that the same run meets.
#[test]
fn half_the_joints_in_turn_meet_the_same_bars() {
    let mut single = estimator::<f32>(0.0);
    for (k, (y, z)) in measure(&GOOD).into_iter().enumerate() {
        let joints = [k % 2, 2 + k % 2, 4 + k % 2];
        let (y, z) = (y.map(|row| row.map(|x| x as f32)), z.map(|z| z as f32));
        single.update_joints(joints, &y, &z).expect("finite");
    }
    let (mass, centre) = errors(&single, &LOAD);
    assert!(mass < 0.02 && centre < 5e-3, "{mass:.1e} {centre:.1e}");
    // The numbers of other joints do not count, nor does a joint that the robot does not have.
    let before = estimated(&single);
    let mut y = [[0.0; 10]; 6];
    y[3][2] = f32::NAN;
    assert_eq!(single.update_joints([0, 9], &y, &[0.0; 6]), Ok(()));
    assert_eq!(estimated(&single), before);
    let refused = Err(RejectedMeasurement::NotFinite { joint: 3 });
    assert_eq!(single.update_joints([0, 3], &y, &[0.0; 6]), refused);
}

/// Recursive least squares with the same forgetting in all directions, by the covariance; σ of the
/// torques is 1.
struct Plain {
    phi: [f64; 10],
    p: [[f64; 10]; 10],
}

impl Plain {
    fn add(&mut self, y: &[f64; 10], z: f64, forgetting: f64) {
        let dot =
            |a: &[f64; 10], b: &[f64; 10]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let p_y = self.p.map(|row| dot(&row, y));
        let gain = p_y.map(|x| x / (1.0 - forgetting + dot(y, &p_y)));
        let error = z - dot(y, &self.phi);
        for ((phi, row), gain) in self.phi.iter_mut().zip(&mut self.p).zip(gain) {
            *phi += gain * error;
            for (p, p_y) in row.iter_mut().zip(p_y) {
                *p = (*p - gain * p_y) / (1.0 - forgetting);
            }
        }
    }
}

#[test]
fn unexcited_parameters_neither_drift_nor_are_forgotten() {
    const FORGETTING: f64 = 1e-3;
    let mut single = estimator::<f32>(FORGETTING);
    for tick in measure(&GOOD) {
        add(&mut single, &tick);
    }
    // The arm then stands, and its encoders flicker.
    let mut rng = Rng::new(9);
    let stands: Vec<[[f64; 10]; 6]> = (0..16)
        .map(|_| {
            let mut at = State::at(reference(5.0).q);
            at.q = at.q.map(|q| q + 2e-4 * rng.within(1.0));
            Core::<Ur5e>::regressor_columns(&at, &RIGID_BODY, WRIST)
        })
        .collect();
    let truth = Payload::<f64, WRIST>::from_inertia(LOAD).0.parameters();
    let torque = |row: &[f64; 10]| -> f64 { row.iter().zip(truth).map(|(y, phi)| y * phi).sum() };
    let before = single.inertia().parameters().map(f64::from);
    let mut plain = Plain {
        phi: before,
        p: core::array::from_fn(|i| {
            core::array::from_fn(|j| if i == j { 1e-4 * PRIOR[i].powi(2) } else { 0.0 })
        }),
    };
    let drift = |phi: [f64; 10]| {
        let moved = (0..10).map(|k| (phi[k] - before[k]).abs() / PRIOR[k]);
        moved.fold(0.0, f64::max)
    };
    for k in 0..400_000 {
        let y = stands[rng.below(16)];
        let z = core::array::from_fn(|i| torque(&y[i]) + NOISE[i] * normal(&mut rng));
        add(&mut single, &(y, z));
        if k < 20_000 {
            let i = k % 6;
            plain.add(&y[i].map(|x| x / NOISE[i]), z[i] / NOISE[i], FORGETTING);
        }
    }
    let (after, without) = (single.inertia().parameters().map(f64::from), drift(plain.phi));
    assert!(drift(after) < 0.02, "{:.1e}", drift(after));
    assert!(without > 1.0, "{without:.1e}");
    let (mass, centre) = errors(&single, &LOAD);
    assert!(mass < 0.01 && centre < 5e-3, "{mass:.1e} {centre:.1e}");
}
