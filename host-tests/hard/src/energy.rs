//! Free motion, and rest: a double pendulum for an hour, a tree in free fall,
//! rest without gravity.

use super::name;
use super::pendulum::pendulum;
use dynamics_core::Core;
use dynamics_core::algorithms::{aba, forward_dynamics, rnea};
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1Free, G1, G1Free, Panda, Ur5e};
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use dynamics_core::state::manifold::{neutral, normalise};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use host_tests::random::{random_numbers, within};

pub const CASES: &[Case] = &[
    Case {
        number: 28,
        name: "energy of a double pendulum",
        parameters: "two points of 1 kg on rods of 1 m, from rest at (2, 2.5) rad, steps of 1 ms, \
            10 s and 1 h",
        source: "the demo of every simulator; its motion is chaotic, so that only the energy \
            follows a law",
        oracle: "the energy by the textbook's formula in f64; the order of each integrator",
        reason: "first order in h, measured. Fourth order: 1.5e-11 per second in f64; in f32 the \
            random walk of two sums per step, √N ε",
        run: pendulum,
    },
    Case {
        number: 29,
        name: "free fall of a floating tree",
        parameters: "A1 and G1 on a free base, released at rest in 50 random configurations; 1 s \
            of fall",
        source: "quadrupeds and humanoids in MuJoCo and Brax that move their joints while they \
            fall",
        oracle: "the base accelerates by g, no joint moves, and every motor torque is zero",
        reason: "inverse dynamics: one sum's rounding. Articulated bodies: a free joint decouples \
            the robot from its base's acceleration. By M and its factors: κ ε",
        run: fall,
    },
    Case {
        number: 30,
        name: "at rest without gravity",
        parameters: "UR5e, Panda, G1 and A1 on a free base, G1 on a free base in 50 random \
            configurations; without gravity, and with gravity of 0",
        source: "the drift of an idle simulation",
        oracle: "zero",
        reason: "only products with zeros are computed: exactly zero",
        run: rest,
    },
];

const G: f64 = 9.81;

/// Largest errors of a robot that falls: torques relative to its weight (N·m, N), accelerations of
/// joints and base relative to g, by bodies and by M; joint speeds after a second.
fn falling<R: Real, T, const B: usize, const Q: usize, const V: usize>(by_factors: f64) -> Vec<Row>
where
    T: Robot<B, Q, V>,
{
    let model = dynamics_core::model::model::<R, T, B, Q, V>();
    let mass: f64 = T::MODEL.links.iter().map(|link| link.inertia.mass).sum();
    let (rng, mut worst) = (&mut random_numbers(), [0.0_f64; 3]);
    for _ in 0..50 {
        let mut q: [f64; Q] = within(rng, 1.5);
        normalise(&T::MODEL, &mut q).expect("no random quaternion is zero");
        let mut state = State::<R, Q, V>::at(q.map(R::from_f64));
        let pose = dynamics_core::algorithms::poses(model, &state.q)[0];
        let g = pose.rot.transpose_mul(R::Vec3::new(R::ZERO, R::ZERO, R::from_f64(-G)));
        for (qdd, g) in state.qdd[3..6].iter_mut().zip(g.array()) {
            *qdd = g;
        }
        let free = [R::ZERO; V];
        let far = |got: [R; V], want: &[R; V]| {
            let apart = |(a, b): (&R, &R)| (a.to_f64() - b.to_f64()).abs();
            got.iter().zip(want).map(apart).fold(0.0, larger)
        };
        let none = [R::from_f64(f64::NAN); V];
        let torque = far(rnea(model, &state, &RIGID_BODY), &free) / (mass * G);
        let by_bodies = far(aba(model, &state, &free, &RIGID_BODY).unwrap_or(none), &state.qdd) / G;
        let by_matrix =
            far(forward_dynamics(model, &state, &free, &RIGID_BODY).unwrap_or(none), &state.qdd)
                / G;
        for (worst, error) in worst.iter_mut().zip([torque, by_bodies, by_matrix]) {
            *worst = if error <= *worst { *worst } else { error };
        }
    }
    let mut state = State::<R, Q, V>::at(neutral(model));
    for _ in 0..1000 {
        let step = semi_implicit(model, &mut state, &[R::ZERO; V], &RIGID_BODY, R::from_f64(1e-3));
        step.expect("M is positive definite");
    }
    let speed = state.qd[6..].iter().map(|qd| qd.to_f64().abs()).fold(0.0, larger);
    let what = |what: &str| format!("{}: {what}", T::MODEL.name);
    let rows = [
        Row::stated(what("rnea"), name::<R>(), worst[0], R::EPSILON.to_f64()),
        Row::stated(what("aba"), name::<R>(), worst[1], 0.0),
        Row::measured(what("crba + ltdl"), name::<R>(), worst[2], by_factors),
        Row::stated(what("joints' speed after 1 s of fall, rad/s"), name::<R>(), speed, 0.0),
    ];
    rows.into()
}

fn fall() -> Vec<Row> {
    let mut rows = falling::<f32, A1Free, 17, 19, 18>(1e-5);
    rows.extend(falling::<f64, A1Free, 17, 19, 18>(2e-14));
    rows.extend(falling::<f32, G1Free, 30, 36, 35>(3e-3));
    rows.extend(falling::<f64, G1Free, 30, 36, 35>(6e-12));
    rows
}

/// The largest number that comes out of any algorithm in 50 poses at rest without gravity.
fn resting<R: Real, T, const B: usize, const Q: usize, const V: usize>() -> Row
where
    T: Robot<B, Q, V>,
{
    let (rng, mut worst) = (&mut random_numbers(), 0.0_f64);
    for _ in 0..50 {
        let mut q: [f64; Q] = within(rng, 3.0);
        normalise(&T::MODEL, &mut q).expect("no random quaternion is zero");
        let state = State::at(q.map(R::from_f64));
        let (nothing, none) = ([R::ZERO; V], [R::from_f64(f64::NAN); V]);
        let (empty, weightless) = (
            (Inertia, Coriolis),
            (Gravity::<dynamics_core::effects::Down>::new(0.0), Inertia, Coriolis),
        );
        let all = [
            Core::<T>::rnea(&state, &empty),
            Core::<T>::rnea(&state, &weightless),
            Core::<T>::aba(&state, &nothing, &empty).unwrap_or(none),
            Core::<T>::aba(&state, &nothing, &weightless).unwrap_or(none),
            Core::<T>::forward_dynamics(&state, &nothing, &empty).unwrap_or(none),
        ];
        for x in all.iter().flatten() {
            let x = x.to_f64().abs();
            worst = if x <= worst { worst } else { x };
        }
    }
    let what = format!("{}: rnea, aba, crba + ltdl", T::MODEL.name);
    Row::stated(what, name::<R>(), worst, 0.0)
}

fn rest() -> Vec<Row> {
    vec![
        resting::<f32, Ur5e, 6, 6, 6>(),
        resting::<f64, Ur5e, 6, 6, 6>(),
        resting::<f32, Panda, 7, 7, 7>(),
        resting::<f64, Panda, 7, 7, 7>(),
        resting::<f32, G1, 29, 29, 29>(),
        resting::<f64, G1, 29, 29, 29>(),
        resting::<f32, A1Free, 17, 19, 18>(),
        resting::<f64, A1Free, 17, 19, 18>(),
        resting::<f32, G1Free, 30, 36, 35>(),
        resting::<f64, G1Free, 30, 36, 35>(),
    ]
}
