//! The law of Slotine & Li: the energy of s changes by its damping alone, and tracking on a
//! simulated arm.

use crate::common::*;
use dynamics_core::algorithms::{aba, crba, rnea};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Viscous};
use dynamics_core::model::{ArmModel, Model, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::state::State;
use motion_control::estimate::Estimate;
use motion_control::law::{PassivityGains, passivity_based_torque};

type Scene<const V: usize> = ((Gravity, Inertia, Coriolis), (Armature<f64, V>, Viscous<f64, V>));

fn scene<const V: usize>() -> Scene<V> {
    let joints = (Armature([0.5; V]), Viscous([2.0; V]));
    ((Gravity::EARTH, Inertia, Coriolis), joints)
}

fn gains<const V: usize>() -> PassivityGains<f64, V> {
    PassivityGains {
        lambda: [6.0; V],
        kd: core::array::from_fn(|i| if i < 3 { 60.0 } else { 8.0 }),
    }
}

/// ½ sᵀ M s.
fn energy<const B: usize, const V: usize>(
    arm: &Model<f64, B, V, V>,
    q: &[f64; V],
    s: &[f64; V],
) -> f64 {
    let m_s = crba(arm, q, &scene()).mul_vec(s);
    s.iter().zip(m_s).map(|(s, m_s)| 0.5 * s * m_s).sum()
}

type Law<'a, const B: usize, const V: usize> = &'a dyn Fn(
    &Model<f64, B, V, V>,
    &PassivityGains<f64, V>,
    &State<f64, V, V>,
    &Estimate<f64, V>,
) -> [f64; V];

fn slotine_li<const B: usize, const V: usize>(
    arm: &Model<f64, B, V, V>,
    gains: &PassivityGains<f64, V>,
    reference: &State<f64, V, V>,
    estimate: &Estimate<f64, V>,
) -> [f64; V] {
    passivity_based_torque(arm, gains, reference, estimate, &scene())
}

/// The same with the velocity products of q̇ in place of C q̇_r: computed torque with these gains.
fn without_c_of_the_reference<const B: usize, const V: usize>(
    arm: &Model<f64, B, V, V>,
    gains: &PassivityGains<f64, V>,
    reference: &State<f64, V, V>,
    estimate: &Estimate<f64, V>,
) -> [f64; V] {
    let sliding = gains.sliding(reference, estimate);
    let state = State { q: estimate.q, qd: estimate.qd, qdd: sliding.qdd_r };
    let tau = rnea(arm, &state, &scene());
    core::array::from_fn(|i| tau[i] - gains.kd[i] * sliding.s[i])
}

/// The rate of ½ sᵀ M s on an arm under a law, and −sᵀ K_D s, at random states and references.
fn rates<const B: usize, const V: usize>(arm: &Model<f64, B, V, V>, law: Law<'_, B, V>) -> Worst {
    let (mut worst, mut rng, gains) = (Worst::default(), Rng::new(31), gains());
    for _ in 0..100 {
        let state = random_state(arm, &mut rng);
        let off: [f64; V] = rng.vector(0.5);
        let reference = State {
            q: core::array::from_fn(|i| state.q[i] + off[i]),
            qd: rng.vector(3.0),
            qdd: rng.vector(10.0),
        };
        let estimate = Estimate { q: state.q, qd: state.qd };
        let sliding = gains.sliding(&reference, &estimate);
        let tau = law(arm, &gains, &reference, &estimate);
        let qdd = aba(arm, &state, &tau, &scene()).unwrap();
        let [rate] = slope(|t| {
            let q = moved(arm, &state.q, &state.qd, t);
            let s = core::array::from_fn(|i| sliding.s[i] + (qdd[i] - sliding.qdd_r[i]) * t);
            [energy(arm, &q, &s)]
        });
        let damping = sliding.s.iter().zip(gains.kd).map(|(s, kd)| kd * s * s);
        worst.see([rate], [-damping.sum::<f64>()]);
    }
    worst
}

#[test]
fn the_energy_of_s_changes_by_its_damping_alone() {
    let mut verdict = Verdict::default();
    let both =
        [("ur5e", rates(&Ur5e::MODEL, &slotine_li)), ("panda", rates(&Panda::MODEL, &slotine_li))];
    for (arm, worst) in &both {
        verdict.see(arm, "rate of the energy of s", "f64", worst);
    }
    verdict.speak();
    // The velocity products of q̇ itself do not: that law needs the inertia matrix in its gains.
    let other = rates(&Ur5e::MODEL, &without_c_of_the_reference);
    assert!(other.error > 0.01 * other.full_scale, "{:e}", other.error);
}

const H: f64 = 1e-3;
const SWING: f64 = 4.0; // rad/s
const START: [f64; 6] = [0.2, -1.2, 1.4, -0.4, 0.5, 0.1];

/// A swing of all joints, which comes to rest after `SWINGS` of 1.57 s.
fn reference(t: f64) -> State<f64, 6, 6> {
    const SWINGS: f64 = 2.0;
    let end = SWINGS * core::f64::consts::TAU / SWING;
    let (s, c) = (SWING * t.min(end)).sin_cos();
    let still = if t < end { 1.0 } else { 0.0 };
    let size = |i: usize| if i < 3 { 0.4 } else { 0.8 };
    State {
        q: core::array::from_fn(|i| START[i] + size(i) * (1.0 - c)),
        qd: core::array::from_fn(|i| still * size(i) * SWING * s),
        qdd: core::array::from_fn(|i| still * size(i) * SWING * SWING * c),
    }
}

/// The run of an arm under the law: its state at the end, the tracking error and the energy of s
/// over time.
struct Run {
    end: State<f64, 6, 6>,
    errors: Vec<f64>,
    energies: Vec<f64>,
}

/// An arm, off by 0.2 rad at the start, under the law with a model that may be another one.
fn run(arm: &ArmModel<f64, 6>, model: &ArmModel<f64, 6>, ticks: usize) -> Run {
    let gains = gains();
    let rate = |q: &[f64; 6], qd: &[f64; 6], t: f64| {
        let tau = slotine_li(model, &gains, &reference(t), &Estimate { q: *q, qd: *qd });
        let state = State { q: *q, qd: *qd, qdd: [0.0; 6] };
        aba(arm, &state, &tau, &scene()).unwrap()
    };
    let mut at = State::at(START.map(|q| q + 0.2));
    let (mut errors, mut energies) = (Vec::new(), Vec::new());
    for k in 0..ticks {
        let t = k as f64 * H;
        let (wanted, estimate) = (reference(t), Estimate { q: at.q, qd: at.qd });
        let off = wanted.q.iter().zip(at.q).map(|(w, q)| (w - q).abs());
        errors.push(off.fold(0.0, f64::max));
        energies.push(energy(arm, &at.q, &gains.sliding(&wanted, &estimate).s));
        // The classical Runge-Kutta method.
        let mut rates: Vec<([f64; 6], [f64; 6])> = Vec::new();
        for share in [0.0, 0.5, 0.5, 1.0] {
            let (v, a) = rates.last().copied().unwrap_or(([0.0; 6], [0.0; 6]));
            let (q, qd) = (plus(&at.q, &v, share * H), plus(&at.qd, &a, share * H));
            rates.push((qd, rate(&q, &qd, t + share * H)));
        }
        for (weight, (v, a)) in [1.0, 2.0, 2.0, 1.0].into_iter().zip(rates) {
            at.q = plus(&at.q, &v, weight * H / 6.0);
            at.qd = plus(&at.qd, &a, weight * H / 6.0);
        }
    }
    let end = at;
    Run { end, errors, energies }
}

fn plus(x: &[f64; 6], rate: &[f64; 6], h: f64) -> [f64; 6] {
    core::array::from_fn(|i| x[i] + h * rate[i])
}

/// The arm with every other link 20 % heavier, and the others 20 % lighter.
fn off_by_20_percent(arm: &ArmModel<f64, 6>) -> ArmModel<f64, 6> {
    let mut off = *arm;
    for (i, link) in off.links.iter_mut().enumerate() {
        let share = if i % 2 == 0 { 1.2 } else { 0.8 };
        link.inertia.mass *= share;
        link.inertia.first_moment *= share;
        link.inertia.rotational *= share;
    }
    off
}

/// The last two ticks between which the energy of s grows, J, beyond the error of the integration.
fn growth(run: &Run) -> Option<&[f64]> {
    let mut pairs = run.energies.windows(2);
    pairs.rfind(|energies| energies[1] > energies[0] && energies[1] > 1e-17)
}

// The energy of s never grows.
#[test]
fn an_exact_model_makes_the_error_vanish() {
    let exact = run(&Ur5e::MODEL, &Ur5e::MODEL, 3000);
    assert!(exact.energies[0] > 1.0, "{}", exact.energies[0]);
    assert_eq!(growth(&exact), None);
    // The error decays as e⁻⁶ᵗ once s has.
    let [early, late] = [2000, 2999].map(|k| exact.errors[k]);
    assert!(early < 1e-5 && late < 1e-7, "{early} {late}");
    // With a model that is off it grows at some time.
    let off = off_by_20_percent(&Ur5e::MODEL);
    assert!(growth(&run(&Ur5e::MODEL, &off, 3000)).is_some());
}

// They are off by 20 %.
#[test]
fn tracking_with_wrong_inertias_converges_to_the_stated_error() {
    let (arm, model) = (Ur5e::MODEL, off_by_20_percent(&Ur5e::MODEL));
    let Run { end, errors, .. } = run(&arm, &model, 6000);
    let most = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    // It starts with 0.2 rad; the second swing of 4 rad/s and 0.8 rad is tracked within a tenth of
    // that.
    assert!(most(&errors[1570..3140]) < 0.02, "{}", most(&errors[1570..3140]));
    // At rest K_D Λ (q_d − q) is the error of gravity.
    let weight = |arm| rnea(arm, &State::at(end.q), &Gravity::EARTH);
    let (truth, modelled, gains) = (weight(&arm), weight(&model), gains::<6>());
    for i in 0..6 {
        let want = (truth[i] - modelled[i]) / (gains.kd[i] * gains.lambda[i]);
        let error = START[i] - end.q[i];
        assert!((error - want).abs() < 1e-6, "{i}: {error} {want}");
    }
    let off = truth[1] - modelled[1];
    assert!(off.abs() > 0.5, "the model is off by {off} N·m");
}
