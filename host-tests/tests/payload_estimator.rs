//! Claims about the estimator of a load, on a simulated UR5e with encoders of 14 bits and noisy torques.

mod common;

use common::Rng;
use dynamics_core::Core;
use dynamics_core::control::{
    ConfigError, ConfigParameter, Observer, ObserverConfig, PayloadEstimator,
    PayloadEstimatorConfig, RejectedMeasurement,
};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Gravity, Inertia, Payload, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

const TICK: f64 = 1e-3;
const WRIST: usize = Ur5e::MODEL.body("wrist_3");
/// Standard deviations of the torques' noise, N·m.
const NOISE: [f64; 6] = [1.5, 1.5, 1.0, 0.3, 0.3, 0.3];
const PRIOR: [f64; 10] = [5.0, 0.5, 0.5, 0.5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05];
/// A load of 2.5 kg whose centre is 60 mm off.
const LOAD: BodyInertia<f64> = BodyInertia {
    mass: 2.5,
    com: [0.04, -0.02, 0.04],
    inertia: [0.008, 0.001, 0.0, 0.006, 0.0, 0.007],
};

type Tick = ([[f64; 10]; 6], [f64; 6]);

fn config<R: Real>(forgetting: f64) -> PayloadEstimatorConfig<R, 6> {
    PayloadEstimatorConfig {
        noise: NOISE.map(R::from_f64),
        prior: PRIOR.map(R::from_f64),
        forgetting: R::from_f64(forgetting),
    }
}

fn estimator<R: Real>(forgetting: f64) -> PayloadEstimator<R, 6> {
    PayloadEstimator::try_new(config(forgetting)).expect("a good one")
}

fn add<R: Real>(estimator: &mut PayloadEstimator<R, 6>, (y, z): &Tick) {
    let y = y.map(|row| row.map(R::from_f64));
    estimator.update(&y, &z.map(R::from_f64)).expect("finite");
}

/// A number of a normal distribution, nearly.
fn normal(rng: &mut Rng) -> f64 {
    (0..12).map(|_| 0.5 * rng.within(1.0)).sum()
}

type Friction = (Armature<f64, 6>, Viscous<f64, 6>, Coulomb<f64, 6>);

fn friction(share: f64) -> Friction {
    let coulomb = Coulomb {
        torque: [8.0, 8.0, 5.0, 2.0, 2.0, 2.0].map(|f| f * share),
        width: Width::new(0.05),
    };
    (
        Armature([2.0, 2.0, 2.0, 0.2, 0.2, 0.2]),
        Viscous([6.0, 6.0, 4.0, 1.0, 1.0, 1.0].map(|b| b * share)),
        coulomb,
    )
}

/// Each joint swings from rest; in half a minute no two of them are in phase twice.
fn reference(t: f64) -> State<f64, 6, 6> {
    const START: [f64; 6] = [0.0, -1.2, 1.3, -0.4, 0.5, 0.1];
    const SIZE: [f64; 6] = [0.5, 0.3, -0.4, 0.6, 0.7, 0.9];
    let rate = |i: usize| 2.0 + 0.43 * i as f64;
    let of = |f: fn(f64, f64) -> f64| core::array::from_fn(|i| SIZE[i] * f(rate(i), t));
    let swing: [f64; 6] = of(|w, t| 1.0 - (w * t).cos());
    State {
        q: core::array::from_fn(|i| START[i] + swing[i]),
        qd: of(|w, t| w * (w * t).sin()),
        qdd: of(|w, t| w * w * (w * t).cos()),
    }
}

/// A step of the classical Runge–Kutta method, by the load and friction.
fn advance(at: &mut State<f64, 6, 6>, tau: &[f64; 6], load: Payload<f64, WRIST>, h: f64) {
    let scene = (Gravity::EARTH, (Inertia, Coriolis), friction(1.0), load);
    let moved = |x: &[f64; 6], rate: &[f64; 6], h: f64| -> [f64; 6] {
        core::array::from_fn(|i| x[i] + h * rate[i])
    };
    let mut rates: Vec<([f64; 6], [f64; 6])> = Vec::new();
    for share in [0.0, 0.5, 0.5, 1.0] {
        let (v, a) = rates.last().copied().unwrap_or(([0.0; 6], [0.0; 6]));
        let (q, qd) = (moved(&at.q, &v, share * h), moved(&at.qd, &a, share * h));
        let qdd = [0.0; 6];
        let a = Core::<Ur5e>::aba(&State { q, qd, qdd }, tau, &scene).expect("an arm with mass");
        rates.push((qd, a));
    }
    for (weight, (v, a)) in [1.0, 2.0, 2.0, 1.0].into_iter().zip(rates) {
        at.q = moved(&at.q, &v, weight * h / 6.0);
        at.qd = moved(&at.qd, &a, weight * h / 6.0);
    }
}

/// What an estimator gets in each tick of a run in closed loop: the controller has the model of friction of this share, and
/// none of the load, which is another one after `changed` ticks.
fn run(
    ticks: usize,
    seed: u64,
    share: f64,
    changed: Option<(usize, BodyInertia<f64>)>,
) -> Vec<Tick> {
    const KP: [f64; 6] = [4000.0, 4000.0, 3000.0, 600.0, 600.0, 400.0];
    const KD: [f64; 6] = [200.0, 200.0, 150.0, 20.0, 20.0, 15.0];
    let (mut rng, mut at) = (Rng::new(seed), reference(0.0));
    let model = (RIGID_BODY, friction(share));
    let observed = ObserverConfig {
        bandwidth: 150.0,
        tick: TICK,
    };
    let mut observer: Observer<f64, 6> = Observer::try_new(observed).expect("a good one");
    let mut found = Vec::new();
    for k in 0..ticks {
        let wanted = reference(TICK * k as f64);
        let counts = 16384.0 / core::f64::consts::TAU;
        let encoders = at.q.map(|q| (q * counts).round() / counts);
        let estimate = observer.update(&encoders, &wanted.qdd);
        let ahead = Core::<Ur5e>::rnea(&wanted, &model);
        let tau: [f64; 6] = core::array::from_fn(|i| {
            ahead[i]
                + KP[i] * (wanted.q[i] - estimate.q[i])
                + KD[i] * (wanted.qd[i] - estimate.qd[i])
        });
        let measured = State {
            q: estimate.q,
            qd: estimate.qd,
            qdd: wanted.qdd,
        };
        let modelled = Core::<Ur5e>::rnea(&measured, &model);
        let y = Core::<Ur5e>::regressor_columns(&measured, &RIGID_BODY, WRIST);
        let z = core::array::from_fn(|i| tau[i] + NOISE[i] * normal(&mut rng) - modelled[i]);
        found.push((y, z));
        let load = match changed {
            Some((from, load)) if k >= from => load,
            _ => LOAD,
        };
        for _ in 0..4 {
            advance(&mut at, &tau, Payload::from_inertia(load), TICK / 4.0);
        }
    }
    found
}

/// The relative error of the mass, and the distance of the centres, m.
fn errors<R: Real>(estimator: &PayloadEstimator<R, 6>, truth: &BodyInertia<f64>) -> (f64, f64) {
    let found = BodyInertia::about_com(&estimator.inertia());
    let apart = |i: usize| found.com[i].to_f64() - truth.com[i];
    let distance = (0..3).map(|i| apart(i) * apart(i)).sum::<f64>().sqrt();
    ((found.mass.to_f64() / truth.mass - 1.0).abs(), distance)
}

#[test]
fn in_5_s_of_motion_the_mass_is_within_2_percent_and_the_centre_within_5_mm_in_f32() {
    for (seed, share) in [(1, 1.0), (2, 1.0), (3, 1.0), (1, 0.9), (1, 1.1)] {
        let mut single = estimator::<f32>(0.0);
        for tick in run(5000, seed, share, None) {
            add(&mut single, &tick);
        }
        let (mass, centre) = errors(&single, &LOAD);
        assert!(
            mass < 0.02 && centre < 5e-3,
            "{seed}: {mass:.1e} {centre:.1e}"
        );
    }
}

/// Torques of the other sign, and two components exchanged, miss the bars that the same run meets.
#[test]
fn half_of_the_joints_in_each_tick_in_turn_meet_the_same_bars() {
    let mut single = estimator::<f32>(0.0);
    for (k, (y, z)) in run(5000, 1, 1.0, None).into_iter().enumerate() {
        let joints = [k % 2, 2 + k % 2, 4 + k % 2];
        let (y, z) = (y.map(|row| row.map(|x| x as f32)), z.map(|z| z as f32));
        single.update_joints(joints, &y, &z).expect("finite");
    }
    let (mass, centre) = errors(&single, &LOAD);
    assert!(mass < 0.02 && centre < 5e-3, "{mass:.1e} {centre:.1e}");
    // The numbers of other joints do not count, nor does a joint that the robot does not have.
    let before = single;
    let mut y = [[0.0; 10]; 6];
    y[3][2] = f32::NAN;
    assert_eq!(single.update_joints([0, 9], &y, &[0.0; 6]), Ok(()));
    assert_eq!(single, before);
    let refused = Err(RejectedMeasurement::NotFinite { joint: 3 });
    assert_eq!(single.update_joints([0, 3], &y, &[0.0; 6]), refused);
}

#[test]
fn torques_of_the_wrong_sign_and_exchanged_axes_are_found() {
    let ticks = run(2000, 1, 1.0, None);
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

/// Least squares of all ticks at once, and the standard deviations, each tick counted with its weight.
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

#[test]
fn the_estimate_and_its_deviations_are_those_of_least_squares_and_f32_follows() {
    let ticks = run(1000, 1, 1.0, None);
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
    let ticks = run(6000, 1, 1.0, Some((3000, other)));
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

/// Recursive least squares with the same forgetting in all directions, by the covariance; σ of the torques is 1.
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
fn what_the_motion_does_not_show_neither_drifts_nor_is_forgotten() {
    const FORGETTING: f64 = 1e-3;
    let mut single = estimator::<f32>(FORGETTING);
    for tick in run(5000, 1, 1.0, None) {
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
fn a_tick_that_is_not_finite_or_too_large_is_refused_with_its_reason_and_leaves_no_trace() {
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

#[test]
fn a_tick_without_information_changes_no_bit_even_if_the_estimator_forgets() {
    let mut single = estimator::<f32>(0.5);
    single.update(&[[0.3; 10]; 6], &[0.7; 6]).expect("finite");
    let before = single;
    for _ in 0..1000 {
        single.update(&[[0.0; 10]; 6], &[5.0; 6]).expect("finite");
    }
    assert_eq!(single, before);
}

#[test]
fn a_configuration_that_is_no_deviation_or_no_share_is_refused() {
    let refused = |config| PayloadEstimator::<f64, 6>::try_new(config).err();
    let named = |parameter| Some(ConfigError::OutOfRange { parameter });
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-10] {
        let (mut noisy, mut prior) = (config(0.0), config(0.0));
        (noisy.noise[5], prior.prior[9]) = (bad, bad);
        assert_eq!(refused(noisy), named(ConfigParameter::TorqueNoise));
        assert_eq!(refused(prior), named(ConfigParameter::PriorDeviation));
    }
    for bad in [-0.1, 1.0, f64::NAN] {
        assert_eq!(refused(config(bad)), named(ConfigParameter::Forgetting));
    }
}
