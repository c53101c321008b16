//! Friction of gears whose direction follows the motion: the law as it is published, iterated; its
//! differential equation in small steps; and a hoist that the friction holds.

use super::*;
use dynamics_core::algorithms::{aba, rnea};
use dynamics_core::effects::{JointState, PreslidingLoadFriction, RIGID_BODY, Viscous};
use dynamics_core::sim::linearly_implicit;
use dynamics_core::{Core, Engine, robots::Ur5e};
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use proptest::prelude::RngExt;

const HOIST: ArmModel<f64, 1> =
    Model::new("hoist", [Body::new("load", BASE, Joint::prismatic([0.0, 0.0, 1.0])).mass(2.0)]);
const WEIGHT: f64 = 2.0 * 9.81;
/// The coefficients of a hoist that is lifted with an efficiency of 0.75.
const MU: [f64; 2] = [0.22, 0.03];
/// The distance over which z follows, m.
const DISTANCE: f64 = 1e-3;

fn gears<R: Real, const N: usize>(z: [f64; N]) -> PreslidingLoadFriction<R, N> {
    PreslidingLoadFriction {
        magnitude: [R::from_f64(MU[0]); N],
        torque: [R::from_f64(MU[1]); N],
        deflection: [R::from_f64(DISTANCE); N],
        direction: z.map(R::from_f64),
    }
}

#[test]
fn the_motors_torque_solves_the_published_law() {
    let mut worst = 0.0_f64;
    for load in [3.0, -0.7, 0.0, 1e-9] {
        for z in [-1.0, -0.6, 0.0, 0.3, 1.0] {
            let mut motor: f64 = load;
            for _ in 0..200 {
                motor = load + MU[0] * motor.abs() * z + MU[1] * motor * z * z;
            }
            let state = State { qdd: [load / 2.0 - 9.81], ..State::at([0.0]) };
            let [got] = rnea(&HOIST, &state, &(RIGID_BODY, gears::<f64, 1>([z])));
            worst = largest([worst, (got - motor).abs() / (1.0 + load.abs())]);
        }
    }
    assert!(worst < 2e-15, "{worst}");
}

#[test]
fn forward_dynamics_of_core_and_engine_invert_inverse_dynamics() {
    let mut rng = random_numbers();
    let mut worst = [0.0_f64; 2];
    for _ in 0..1000 {
        let [q, qd, qdd, z] = [3.1, 3.0, 10.0, 1.0].map(|bound| within::<6>(&mut rng, bound));
        let (state, scene) = (State { q, qd, qdd }, (RIGID_BODY, gears::<f64, 6>(z)));
        let tau = Core::<Ur5e>::rnea(&state, &scene);
        let of_engine = Engine::<Ur5e>::rnea(&state, &scene);
        worst[0] =
            largest([worst[0]].into_iter().chain((0..6).map(|j| (tau[j] - of_engine[j]).abs())));
        for got in
            [Core::<Ur5e>::aba(&state, &tau, &scene), Engine::<Ur5e>::aba(&state, &tau, &scene)]
        {
            let got = got.expect("a mass");
            worst[1] =
                largest([worst[1]].into_iter().chain((0..6).map(|j| (got[j] - qdd[j]).abs())));
        }
    }
    assert!(worst[0] < 1e-12 && worst[1] < 1e-9, "{worst:?}");
}

/// z after the velocities `qd`, each of `seconds`, in `parts` steps each.
fn direction(qd: &[f64], seconds: f64, parts: u32) -> f64 {
    let mut friction = gears::<f64, 1>([0.0]);
    for &qd in qd {
        for _ in 0..parts {
            let at = JointState::new(0.0, qd);
            Effect::<f64, 1, 1>::advance(&mut friction, 0, at, seconds / f64::from(parts));
        }
    }
    friction.direction[0]
}

#[test]
fn the_direction_follows_the_motion_over_the_distance() {
    // z = s + (z₀ − s) e^{−|Δq|/h} of a motion in one direction s.
    let moved =
        |z: f64, way: f64| way.signum() + (z - way.signum()) * (-way.abs() / DISTANCE).exp();
    let ways = [2e-3, -5e-4, 1e-4, -3e-3, 7e-4];
    let exact = ways.iter().fold(0.0, |z, way| moved(z, *way));
    let error = |parts| (direction(&ways.map(|way| way / 0.01), 0.01, parts) - exact).abs();
    assert!(error(10_000) < 1e-4, "{}", error(10_000));
    let order = error(1000) / error(10_000);
    assert!((9.0..11.0).contains(&order), "{order}");
    // It is a direction whatever the step.
    let mut rng = random_numbers();
    let speeds: Vec<f64> = (0..10_000).map(|_| rng.random_range(-1e3..1e3)).collect();
    for k in 1..speeds.len() {
        assert!(direction(&speeds[k - 1..k + 1], 1.0, 1).abs() <= 1.0);
    }
}

#[test]
fn a_motion_that_returns_gives_no_energy() {
    // The energy of friction alone under a constant load, over the second of two equal cycles.
    let mut rng = random_numbers();
    for _ in 0..100 {
        let [load, amplitude] = [50.0, 5.0 * DISTANCE].map(|bound| rng.random_range(-bound..bound));
        let steps = 500;
        let mut friction = gears::<f64, 1>([0.0]);
        let mut absorbed = [0.0; 2];
        for k in 0..2 * steps {
            let phase = std::f64::consts::TAU * f64::from(k) / f64::from(steps);
            let qd = amplitude * phase.cos();
            let state = State { q: [0.0], qd: [qd], qdd: [load / 2.0 - 9.81] };
            let [motor] = rnea(&HOIST, &state, &(RIGID_BODY, friction));
            let step = std::f64::consts::TAU / f64::from(steps);
            absorbed[(k / steps) as usize] += (motor - load) * qd * step;
            let at = JointState::new(0.0, qd);
            Effect::<f64, 1, 1>::advance(&mut friction, 0, at, step);
        }
        assert!(absorbed[1] >= 0.0, "{load} N, {amplitude} m: {absorbed:?} J");
    }
}

#[test]
fn between_the_two_efficiencies_the_load_stands_still() {
    let scene = (RIGID_BODY, Viscous([20.0]), gears::<f64, 1>([0.0]));
    let moved = |share: f64, seconds: u32| {
        let (mut scene, mut state) = (scene, State::at([0.0]));
        for _ in 0..seconds * 1000 {
            linearly_implicit(&HOIST, &mut state, &[share * WEIGHT], &mut scene, 1e-3).unwrap();
        }
        (state.q[0], state.qd[0])
    };
    // Lifting takes 1/(1 − 0.25) of the weight, lowering 1/(1 + 0.19).
    for share in [0.86, 0.95, 1.05, 1.3] {
        let [(at, _), (later, speed)] = [moved(share, 6), moved(share, 8)];
        assert!(at.abs() < 20.0 * DISTANCE, "{share}: {at}");
        assert!((later - at).abs() < 1e-9 && speed.abs() < 1e-9, "{share}: {at} {later} {speed}");
    }
    for (share, way) in [(0.83, -1.0), (1.35, 1.0)] {
        let (_, speed) = moved(share, 6);
        assert!(speed * way > 0.005, "{share}: {speed}");
    }
    let standing = State::at([0.0]);
    let [qdd] = aba(&HOIST, &standing, &[WEIGHT], &scene).expect("a mass");
    assert!(qdd.abs() < 1e-14);
}
