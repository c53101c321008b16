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
use motion_control::{
    ConfigError, ConfigParameter, PayloadEstimator, PayloadEstimatorConfig, RejectedMeasurement,
};

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
    PayloadEstimator::try_new(PayloadEstimatorConfig {
        limit,
        ..config(0.0)
    })
    .expect("a good one")
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
        for tick in measure(&Run {
            seed,
            friction,
            ..GOOD
        }) {
            let _ = offer(&mut single, &tick);
        }
        assert!(!single.frozen() && single.consistency() < 6.0);
        let (mass, centre) = errors(&single, &LOAD);
        assert!(
            mass < 0.02 && centre < 5e-3,
            "{seed}: {mass:.1e} {centre:.1e}"
        );
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

#[test]
fn torques_of_the_wrong_sign_and_exchanged_axes_are_found() {
    let ticks = measure(&Run {
        ticks: 2000,
        ..GOOD
    });
    let of = |change: fn(&mut Tick)| {
        let mut single = estimator::<f32>(0.0);
        for mut tick in ticks.iter().copied() {
            change(&mut tick);
            add(&mut single, &tick);
        }
        errors(&single, &LOAD)
    };
    let (mass, _) = of(|(_, z)| *z = z.map(|z| -z));
    let (_, centre) = of(|(y, _)| y.iter_mut().for_each(|row| row.swap(1, 2)));
    let good = of(|_| ());
    assert!(mass > 1.0 && centre > 0.02, "{mass:.1e} {centre:.1e}");
    assert!(good.0 < 0.02 && good.1 < 5e-3, "{good:?}");
}

/// The solution of a x = b by elimination with pivots.
fn solved(mut a: [[f64; 10]; 10], mut b: [f64; 10]) -> [f64; 10] {
    for k in 0..10 {
        let best = (k..10).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()));
        let best = best.expect("a row");
        a.swap(k, best);
        b.swap(k, best);
        for i in 0..10 {
            if i != k {
                let (pivot, by) = (a[k], b[k]);
                let factor = a[i][k] / pivot[k];
                for (a, pivot) in a[i].iter_mut().zip(pivot) {
                    *a -= factor * pivot;
                }
                b[i] -= factor * by;
            }
        }
    }
    core::array::from_fn(|k| b[k] / a[k][k])
}

/// Least squares of all ticks at once, and the standard deviations, each tick counted with its
/// weight.
fn at_once(ticks: &[Tick]) -> ([f64; 10], [f64; 10]) {
    let (mut a, mut b) = ([[0.0; 10]; 10], [0.0; 10]);
    for (k, row) in a.iter_mut().enumerate() {
        row[k] = PRIOR[k].powi(-2);
    }
    for (y, z) in ticks {
        for i in 0..6 {
            for k in 0..10 {
                let weighted = y[i][k] / NOISE[i].powi(2);
                b[k] += weighted * z[i];
                for l in 0..10 {
                    a[k][l] += weighted * y[i][l];
                }
            }
        }
    }
    let variance = |k: usize| solved(a, core::array::from_fn(|i| f64::from(u8::from(i == k))))[k];
    (solved(a, b), core::array::from_fn(|k| variance(k).sqrt()))
}

// The estimate in f32 follows.
#[test]
fn the_estimate_and_deviations_are_those_of_least_squares() {
    let ticks = measure(&Run {
        ticks: 1000,
        ..GOOD
    });
    let (mut double, mut single) = (estimator::<f64>(0.0), estimator::<f32>(0.0));
    for tick in &ticks {
        add(&mut double, tick);
        add(&mut single, tick);
    }
    let (want, deviations) = at_once(&ticks);
    let got = double.inertia().parameters();
    let in_f32 = single.inertia().parameters();
    for k in 0..10 {
        assert!(
            (got[k] - want[k]).abs() < 5e-13 * PRIOR[k],
            "{k}: {got:?} {want:?}"
        );
        let ratio = double.deviations()[k] / deviations[k];
        assert!((ratio - 1.0).abs() < 1e-13, "{ratio}");
        // Far within what the noise leaves uncertain.
        let apart = (f64::from(in_f32[k]) - want[k]).abs() / deviations[k];
        assert!(apart < 5e-4, "{k}: {apart:.1e}");
    }
}

#[test]
fn an_estimator_that_forgets_finds_another_load() {
    let other = BodyInertia {
        mass: 1.0,
        com: [0.0, 0.02, 0.03],
        ..LOAD
    };
    let ticks = measure(&Run {
        ticks: 6000,
        changed: Some((3000, other)),
        ..GOOD
    });
    let of = |forgetting| {
        let mut single = estimator::<f32>(forgetting);
        for tick in &ticks {
            add(&mut single, tick);
        }
        errors(&single, &other)
    };
    let (forgets, remembers) = (of(2e-3), of(0.0));
    assert!(forgets.0 < 0.04 && forgets.1 < 0.03, "{forgets:?}");
    assert!(remembers.0 > 0.2, "{remembers:?}");
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
    let (after, without) = (
        single.inertia().parameters().map(f64::from),
        drift(plain.phi),
    );
    assert!(drift(after) < 0.02, "{:.1e}", drift(after));
    assert!(without > 1.0, "{without:.1e}");
    let (mass, centre) = errors(&single, &LOAD);
    assert!(mass < 0.01 && centre < 5e-3, "{mass:.1e} {centre:.1e}");
}

#[test]
fn a_nonfinite_or_huge_tick_is_refused_without_trace() {
    let mut single = estimator::<f32>(1e-3);
    let mut other = single;
    let y = [[1.0_f32; 10]; 6];
    for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e30] {
        let reason = |joint| match bad.is_finite() {
            true => Err(RejectedMeasurement::TooLarge),
            false => Err(RejectedMeasurement::NotFinite { joint }),
        };
        let mut z = [0.5; 6];
        z[3] = bad;
        assert_eq!(single.update(&y, &z), reason(3));
        let mut wrong = y;
        wrong[1][9] = bad;
        assert_eq!(single.update(&wrong, &[0.5; 6]), reason(1));
        for estimator in [&mut single, &mut other] {
            assert_eq!(estimator.update(&y, &[0.5; 6]), Ok(()));
        }
        assert_eq!(single, other);
    }
    single.restart();
    assert_eq!(single, estimator(1e-3));
}

// This holds although the estimator forgets.
#[test]
fn a_tick_without_information_changes_no_bit() {
    let mut single = estimator::<f32>(0.5);
    single.update(&[[0.3; 10]; 6], &[0.7; 6]).expect("finite");
    let before = estimated(&single);
    for _ in 0..1000 {
        single.update(&[[0.0; 10]; 6], &[5.0; 6]).expect("finite");
    }
    assert_eq!(estimated(&single), before);
}

#[test]
fn configurations_out_of_range_are_refused() {
    let refused = |config| PayloadEstimator::<f64, 6>::try_new(config).err();
    let named = |parameter| Some(ConfigError::OutOfRange { parameter });
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-10] {
        let (mut noisy, mut prior) = (config(0.0), config(0.0));
        (noisy.noise[5], prior.prior[9]) = (bad, bad);
        assert_eq!(refused(noisy), named(ConfigParameter::TorqueNoise));
        assert_eq!(refused(prior), named(ConfigParameter::PriorDeviation));
    }
    for end in [1e-6, 1e6] {
        let (mut noisy, mut prior) = (config(0.0), config(0.0));
        (noisy.noise[5], prior.prior[9]) = (end, end);
        assert_eq!((refused(noisy), refused(prior)), (None, None));
    }
    for bad in [-0.1, 1.0, f64::NAN] {
        assert_eq!(refused(config(bad)), named(ConfigParameter::Forgetting));
    }
    for limit in [2.9, 1001.0, f64::NAN, f64::INFINITY] {
        let config = PayloadEstimatorConfig {
            limit,
            ..config(0.0)
        };
        assert_eq!(refused(config), named(ConfigParameter::InnovationLimit));
    }
}
