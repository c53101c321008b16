//! Springs, stops and cogging; and that derivatives are derivatives.

use super::*;
use dynamics_core::effects::{
    AsymmetricCoulomb, Cogging, Coulomb, EndStops, Implicit, Inertia, Spring, Viscous, Width,
};
use dynamics_core::sim::{linearly_implicit, semi_implicit};
use host_tests::measured::largest;
use host_tests::random::random_numbers;
use proptest::prelude::RngExt;

const STOPS: EndStops<f64, 1> = EndStops {
    lower: [-1.0],
    upper: [1.5],
    stiffness: 1e4,
    damping: 80.0,
    damping_depth: Width::f64(1e-3),
};

#[test]
fn two_masses_on_a_spring_swing_in_closed_form() {
    // One sledge on another: the spring sees the reduced mass, their centre moves on.
    const PAIR: ArmModel<f64, 2> = Model::new(
        "pair",
        [
            Body::new("one", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(2.0),
            Body::new("other", 0, Joint::prismatic([1.0, 0.0, 0.0])).mass(3.0),
        ],
    );
    let spring = Spring { stiffness: [0.0, 120.0], rest: [0.0, 0.25] };
    let (omega, h) = ((120.0_f64 * (1.0 / 2.0 + 1.0 / 3.0)).sqrt(), 1e-5);
    let mut state = State::at([0.0, 0.35]);
    let (mut stretch, mut centre) = (Worst::default(), 0.0_f64);
    for i in 1..=100_000 {
        semi_implicit(&PAIR, &mut state, &[0.0; 2], &(Inertia, spring), h).unwrap();
        let t = h * f64::from(i);
        stretch.see(state.q[1] - 0.25, 0.1 * (omega * t).cos());
        centre =
            largest([centre, (2.0 * state.q[0] + 3.0 * (state.q[0] + state.q[1]) - 1.05).abs()]);
    }
    assert!(centre < 1e-11, "{centre:e}");
    stretch.check::<f64>("two masses", "stretch");
}

#[test]
fn stops_push_inwards_only_and_never_add_energy() {
    let rng = &mut random_numbers();
    for _ in 0..100_000 {
        let (q, qd) = (rng.random_range(-2.0..2.0), rng.random_range(-9.0..9.0));
        let tau = torque(&STOPS, q, qd);
        if q > 1.5 {
            assert!(tau >= 0.0);
            let want = (1e4 * (q - 1.5) + 80.0 * qd).max(0.0);
            // The damping is all there beyond 1 mm.
            assert!(q < 1.501 || (tau - want).abs() < 1e-9, "{tau} {want}");
        } else if q < -1.0 {
            assert!(tau <= 0.0);
        } else {
            assert_eq!(tau, 0.0);
        }
    }
    // A ball between them only ever gets slower, with steps of any length.
    for h in [1e-5, 1e-4, 1e-3] {
        let (mut scene, mut state) = ((Inertia, STOPS), State::at([0.0]));
        state.qd = [3.0];
        let (mut free, mut bounces) = (3.0_f64, 0);
        for _ in 0..(4.0 / h) as u32 {
            linearly_implicit(&SLEDGE, &mut state, &[0.0], &mut scene, h).unwrap();
            let (q, speed) = (state.q[0], state.qd[0].abs());
            if (-1.0..1.5).contains(&q) && (speed - free).abs() > 1e-12 {
                assert!(speed < free, "{speed} after {free} at h = {h}");
                (free, bounces) = (speed, bounces + 1);
            }
        }
        assert!(bounces >= 2, "{bounces} at h = {h}");
    }
}

#[test]
fn stops_of_any_stiffness_are_stable_in_long_steps() {
    let mut scene = (Inertia, EndStops { stiffness: 1e9, damping: 1e3, ..STOPS });
    let mut state = State::at([0.0]);
    state.qd = [5.0];
    for _ in 0..5000 {
        linearly_implicit(&SLEDGE, &mut state, &[20.0], &mut scene, 1e-3).unwrap();
        assert!(state.qd[0].abs() <= 10.0 && state.q[0] < 1.51);
    }
    assert!((state.q[0] - 1.5).abs() < 1e-6 && state.qd[0].abs() < 1e-3, "{state:?}");
}

#[test]
fn cogging_follows_its_series_without_work_per_turn() {
    fn worst<R: Real>() -> Worst {
        let of = R::from_f64;
        let cogging = Cogging {
            per_turn: [of(36.0)],
            cos: [[0.1, 0.0, -0.02].map(of)],
            sin: [[0.3, 0.05, 0.01].map(of)],
        };
        let (mut worst, mut sum) = (Worst::default(), 0.0);
        let steps = 3600;
        for i in 0..steps {
            // On the grid of f32: the phase is then exact.
            let q = R::from_f64(f64::from(i) / f64::from(steps) * core::f64::consts::TAU).to_f64();
            let phase = R::from_f64(36.0 * q).to_f64();
            let part = |k: f64, a: f64, b: f64| a * (k * phase).cos() + b * (k * phase).sin();
            let want = part(1.0, 0.1, 0.3) + part(2.0, 0.0, 0.05) + part(3.0, -0.02, 0.01);
            let got = torque::<R, _>(&cogging, q, 0.0);
            worst.see(got, want);
            sum += got;
        }
        assert!((sum / f64::from(steps)).abs() < 1e-6, "{sum}");
        worst
    }
    worst::<f64>().check::<f64>("cogging", "series");
    worst::<f32>().check::<f32>("cogging", "series");
}

#[test]
fn stated_slopes_are_derivatives_of_the_torques() {
    fn holds<E: Effect<f64, 1, 1>>(effect: &E, q: f64, qd: f64) {
        let h = 1e-6;
        let along = |dq: f64, dqd: f64| {
            let f = |by: f64| torque(effect, q + by * dq, qd + by * dqd);
            (f(h) - f(-h)) / (2.0 * h)
        };
        let want = [along(1.0, 0.0), along(0.0, 1.0)];
        for (got, want) in derivatives(effect, q, qd).into_iter().zip(want) {
            assert!(
                (got - want.max(0.0)).abs() < 1e-4 * (1.0 + want.abs()),
                "{got} {want} at {q} {qd}"
            );
        }
    }
    let rng = &mut random_numbers();
    let dry = Coulomb { torque: [4.0], width: Width::new(0.5) };
    let one_way = AsymmetricCoulomb { forward: [4.0], backward: [1.0], width: Width::new(0.5) };
    let spring = Spring { stiffness: [50.0], rest: [0.3] };
    let cogging = Cogging { per_turn: [12.0], cos: [[0.1, 0.2]], sin: [[0.4, -0.1]] };
    for _ in 0..1000 {
        let (q, qd) = (rng.random_range(-2.0..2.0), rng.random_range(-1.0..1.0));
        holds(&Viscous([0.7]), q, qd);
        holds(&spring, q, qd);
        holds(&cogging, q, qd);
        if (qd.abs() - 0.5).abs() > 1e-3 {
            holds(&dry, q, qd);
            holds(&one_way, q, qd);
        }
        // Deep in a stop, where its damping is constant.
        holds(&STOPS, 1.6 + 0.2 * q.abs(), qd);
    }
}

#[test]
fn an_implicit_step_of_a_spring_is_backward_eulers() {
    // (m + h b + h² k) q̇₊ = m q̇ − h k (q − q₀)
    let (k, b, h, m) = (5e5, 300.0, 2e-3, 2.0);
    let spring = Spring { stiffness: [k], rest: [0.1] };
    let mut scene = (Inertia, spring, Viscous([b]));
    let (mut state, mut worst) = (State::at([0.3]), Worst::default());
    let [mut q, mut qd] = [0.3_f64, 0.0];
    for _ in 0..1000 {
        linearly_implicit(&SLEDGE, &mut state, &[0.0], &mut scene, h).unwrap();
        qd = (m * qd - h * k * (q - 0.1)) / (m + h * b + h * h * k);
        q += h * qd;
        worst.see(state.q[0], q);
    }
    worst.check::<f64>("sledge", "backward Euler");
    // Its own inertia is in M, too.
    let implicit = Implicit::new(&SLEDGE, &state, &scene, h);
    let m_h = dynamics_core::algorithms::crba(&SLEDGE, &state.q, &implicit);
    assert!((m_h.get(0, 0) - (m + h * b + h * h * k)).abs() < 1e-9);
}
