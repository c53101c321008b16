//! Another arm: a UR5e with encoders of 14 bits that follows its reference, and noise of 1 % of its
//! torques.

use dynamics_core::Core;
use dynamics_core::algorithms::{friction_regressor, inertial_parameters};
use dynamics_core::effects::{RIGID_BODY, Width};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use motion_control::{
    Excitation, Observer, ObserverConfig, ParameterEstimator, ParameterEstimatorConfig,
    PhysicalParameters, SelectedParameters,
};

use crate::common::Rng;
use crate::parameter_estimator::arm::{dot, normal, off_by_30_percent};

/// Viscous and Coulomb friction, and armature.
const OWN: usize = 3;
const N: usize = 60 + 6 * OWN;
const P: usize = 32;
const TICK: f64 = 2e-3;
const FULL_SCALE: [f64; 6] = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];

type At = State<f64, 6, 6>;

/// Each joint swings at two frequencies about this centre.
fn motion(centre: [f64; 6], rate: f64, t: f64) -> At {
    let of = |f: fn(f64, f64) -> f64| -> [f64; 6] {
        core::array::from_fn(|i| {
            let at = |rate: f64| 0.45 * f(rate, t);
            at(rate * (0.7 + 0.17 * i as f64)) + at(rate * (1.6 + 0.29 * i as f64))
        })
    };
    let swing = of(|w, t| (w * t).sin());
    State {
        q: core::array::from_fn(|i| centre[i] + swing[i]),
        qd: of(|w, t| w * (w * t).cos()),
        qdd: of(|w, t| -w * w * (w * t).sin()),
    }
}

fn learning(t: f64) -> At {
    motion([0.0, -1.3, 1.2, -0.5, 0.6, 0.0], 1.5, t)
}

fn columns(state: &At, joint: usize) -> ([[f64; 10]; 6], [f64; OWN]) {
    let bodies = Core::<Ur5e>::regressor_row(state, &RIGID_BODY, joint);
    let [viscous, sign] = friction_regressor(&state.qd, Width::new(0.05))[joint];
    (bodies, [viscous, sign, state.qdd[joint]])
}

fn torque(all: &[f64; N], state: &At, joint: usize) -> f64 {
    let (bodies, own) = columns(state, joint);
    dot(&Excitation::<N>::row(joint, &bodies, &own), all)
}

/// The greatest root of a joint's mean square error on another path, relative to its full scale.
fn validation(all: &[f64; N], truth: &[f64; N]) -> f64 {
    let error = |joint: usize| {
        let errors = (0..300).map(|k| {
            let state = motion([0.8, -1.0, 0.9, -1.2, -0.7, 0.5], 1.9, 0.1 * f64::from(k));
            torque(all, &state, joint) - torque(truth, &state, joint)
        });
        (errors.map(|x| x * x).sum::<f64>() / 300.0).sqrt() / FULL_SCALE[joint]
    };
    (0..6).map(error).fold(0.0, f64::max)
}

/// All parameters, with the bodies and each of the others times a number of `of`.
fn parameters(bodies: &[[f64; 10]; 6], mut of: impl FnMut() -> f64) -> [f64; N] {
    let size = |joint: usize| if joint < 3 { 1.0 } else { 0.2 };
    core::array::from_fn(|k| match k.checked_sub(60) {
        None => bodies[k / 10][k % 10],
        Some(k) => [7.0, 8.0, 2.0][k % OWN] * size(k / OWN) * of(),
    })
}

// The error is a share of full scale.
#[test]
fn half_a_minute_brings_ur5e_torques_within_1_percent() {
    let bodies = inertial_parameters(&Ur5e::MODEL, &());
    let truth = parameters(&bodies, || 1.0);
    let mut rng = Rng::new(4);
    let mut factor = || if rng.below(2) == 0 { 0.7 } else { 1.3 };
    let off = off_by_30_percent(&bodies, &mut factor);
    let nominal = parameters(&off, factor);
    let noise = FULL_SCALE.map(|torque| 0.01 * torque);
    let mut excitation: Box<Excitation<N>> = Box::default();
    for k in 0..300 {
        let state = learning(0.1 * f64::from(k));
        for (joint, noise) in noise.into_iter().enumerate() {
            let (bodies, own) = columns(&state, joint);
            excitation.add(&Excitation::row(joint, &bodies, &own), noise);
        }
    }
    let base: SelectedParameters<f32, P, N> =
        (excitation.select::<_, 6, _>(&nominal, 0.4)).expect("enough");
    let config = ParameterEstimatorConfig {
        noise: noise.map(|noise| noise as f32),
        prior: base.prior,
        own: base.own(6, OWN),
        forgetting: 1e-4,
        limit: 5.0,
    };
    let mut estimator: ParameterEstimator<f32, P, 6> =
        ParameterEstimator::try_new(config).expect("a good one");
    let mut observer: Observer<f64, 6> = Observer::try_new(ObserverConfig {
        bandwidth: 100.0,
        tick: TICK,
    })
    .expect("a good one");
    for k in 0..15_000 {
        let (at, joint) = (learning(TICK * f64::from(k)), k as usize % 6);
        let counts = 16384.0 / core::f64::consts::TAU;
        let found = observer.update(&at.q.map(|q| (q * counts).round() / counts), &at.qdd);
        if k < 200 || at.qd[joint].abs() < 0.15 {
            continue;
        }
        let measured = State {
            q: found.q,
            qd: found.qd,
            qdd: at.qdd,
        };
        let tau = torque(&truth, &at, joint) + noise[joint] * normal(&mut rng);
        let (bodies, own) = columns(&measured, joint);
        let (bodies, own) = (bodies.map(|x| x.map(|x| x as f32)), own.map(|x| x as f32));
        let residual = tau - torque(&nominal, &measured, joint);
        let y = base.row(joint, &bodies, &own);
        let _ = estimator.update(joint, &y, residual as f32);
    }
    let mut stored: PhysicalParameters<f32, 6, N> =
        PhysicalParameters::try_new(nominal.map(|x| x as f32)).expect("a possible arm");
    stored.update(&base, &estimator.estimate());
    let kept = stored.parameters().map(f64::from);
    let (before, after) = (validation(&nominal, &truth), validation(&kept, &truth));
    assert!(before > 0.05, "{before:.4}");
    assert!(after < 0.01, "{after:.4}");
}
