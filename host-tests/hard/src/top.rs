//! A heavy symmetric top.

use super::attitude::ball;
use super::integrators::{INTEGRATORS, Integrator};
use super::name;
use dynamics_core::algorithms::{aba, forward_dynamics, poses, rnea};
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Model;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::state::State;
use glam::DVec3;
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[Case {
    number: 27,
    name: "heavy symmetric top",
    parameters: "2 kg, 0.25 m from its tip, moments of 1/4 and 1/16 kg·m² about the tip, inclined \
        by 0.6 rad, precession of 2 rad/s, 2 s in steps of 0.1 ms (first order) and 1 ms (fourth \
        order)",
    source: "Klein & Sommerfeld (1897-1910), steady precession; Goldstein, section 5.7",
    oracle: "closed form: C s Ω = m g l + (A − C) Ω² cos θ; the axis rotates about the vertical by \
        Ω t",
    reason: "one acceleration: 4 ε. Axis: measured, the order confirmed with half the step; in f32 \
        the fourth order's error is the rounding of 2000 steps",
    run: top,
}];

fn top() -> Vec<Row> {
    const LEAN: f64 = 0.6;
    const TURN: f64 = 2.0;
    let (mass, l, a, c, g) = (2.0, 0.25, 0.25, 0.0625, 9.81);
    let spin = (mass * g * l + (a - c) * TURN * TURN * LEAN.cos()) / (c * TURN);
    let model = ball(mass, l, [a - mass * l * l, a - mass * l * l, c]);
    let start = State {
        q: [(0.5 * LEAN).sin(), 0.0, 0.0, (0.5 * LEAN).cos()],
        qd: [0.0, TURN * LEAN.sin(), TURN * LEAN.cos() + spin],
        qdd: [spin * TURN * LEAN.sin(), 0.0, 0.0],
    };
    let weight = mass * g * l;
    let mut rows = accelerations::<f32>(&model, &start, weight);
    rows.extend(accelerations::<f64>(&model, &start, weight));
    for (how, bounds) in INTEGRATORS.iter().zip([[5e-2; 2], [5e-3; 2], [1e-5, 1e-6]]) {
        let h = if how.order == 1 { 1e-4 } else { 1e-3 };
        let axis = |h| precession::<f64>(&model, &start, how, h, LEAN, TURN);
        let (single, double) = (precession::<f32>(&model, &start, how, h, LEAN, TURN), axis(h));
        let what = format!("{}: axis", how.name);
        rows.push(Row::measured(what.as_str(), "f32", single, bounds[0]));
        rows.push(Row::measured(what, "f64", double, bounds[1]));
        let off = ((double / axis(0.5 * h)).log2() - f64::from(how.order)).abs();
        rows.push(Row::stated(format!("{}: its order", how.name), "f64", off, 0.2));
    }
    rows
}

/// One acceleration and its torque against the closed form.
fn accelerations<R: Real>(
    model: &Model<f64, 1, 4, 3>,
    start: &State<f64, 4, 3>,
    weight: f64,
) -> Vec<Row> {
    let (model, start) = (R::cast(model), cast::<R>(start));
    let far = |got: [R; 3], want: [R; 3]| {
        let apart = |(a, b): (R, R)| (a.to_f64() - b.to_f64()).abs();
        got.into_iter().zip(want).map(apart).fold(0.0, larger)
    };
    let (free, none) = ([R::ZERO; 3], [R::from_f64(f64::NAN); 3]);
    let by_bodies = aba(&model, &start, &free, &RIGID_BODY).unwrap_or(none);
    let by_matrix = forward_dynamics(&model, &start, &free, &RIGID_BODY).unwrap_or(none);
    let (most, bound) = (start.qdd[0].to_f64(), 4.0 * R::EPSILON.to_f64());
    let errors = [
        ("rnea", far(rnea(&model, &start, &RIGID_BODY), free) / weight),
        ("aba", far(by_bodies, start.qdd) / most),
        ("crba + ltdl", far(by_matrix, start.qdd) / most),
    ];
    errors.map(|(what, error)| Row::stated(what, name::<R>(), error, bound)).into()
}

/// The largest distance of the axis from its closed form, in 2 s.
fn precession<R: Real>(
    model: &Model<f64, 1, 4, 3>,
    start: &State<f64, 4, 3>,
    how: &Integrator,
    h: f64,
    lean: f64,
    turn: f64,
) -> f64 {
    let (model, mut state, mut worst) = (R::cast(model), cast::<R>(start), 0.0_f64);
    for step in 1..=(2.0 / h).round() as u32 {
        let scene = &mut (Gravity::EARTH, Inertia, Coriolis);
        how.step(&model, &mut state, &[R::ZERO; 3], scene, R::from_f64(h));
        let axis = poses(&model, &state.q)[0].rot.cols()[2].array().map(R::to_f64);
        let (sin, cos) = (turn * h * f64::from(step)).sin_cos();
        let want = DVec3::new(lean.sin() * sin, -lean.sin() * cos, lean.cos());
        worst = larger(worst, (DVec3::from(axis) - want).length());
    }
    worst
}

fn cast<R: Real>(state: &State<f64, 4, 3>) -> State<R, 4, 3> {
    State {
        q: state.q.map(R::from_f64),
        qd: state.qd.map(R::from_f64),
        qdd: state.qdd.map(R::from_f64),
    }
}
