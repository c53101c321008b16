//! The energy of a double pendulum for an hour.

use super::integrators::INTEGRATORS;
use dynamics_core::effects::{Coriolis, Gravity, Inertia};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::normalise;
use host_tests::hard::Row;
use host_tests::measured::larger;

const G: f64 = 9.81;

fn points() -> ArmModel<f64, 2> {
    let point = |name, parent, at| {
        let body = Body::new(name, parent, Joint::continuous([0.0, -1.0, 0.0]));
        body.xyz([0.0, 0.0, at]).mass(1.0).com([0.0, 0.0, -1.0])
    };
    Model::new("double pendulum", [point("upper", BASE, 0.0), point("lower", 0, -1.0)])
}

/// T + U of two points on rods, angles from the vertical. Any textbook.
fn energy([a, b]: [f64; 2], [u, w]: [f64; 2]) -> f64 {
    let (b, w) = (a + b, u + w);
    u * u + 0.5 * w * w + u * w * (a - b).cos() - G * (2.0 * a.cos() + b.cos())
}

/// The largest error of the energy, relative to what there is between hanging and upright.
fn swing<R: Real>(how: usize, h: f64, seconds: f64, wrapped: bool) -> f64 {
    let model = R::cast(&points());
    let mut state = State::at([2.0, 2.5].map(R::from_f64));
    let now = |s: &State<R, 2, 2>| energy(s.q.map(R::to_f64), s.qd.map(R::to_f64));
    let (start, mut worst) = (now(&state), 0.0_f64);
    let (scene, h_r) = (&mut (Gravity::EARTH, Inertia, Coriolis), R::from_f64(h));
    for i in 0..(seconds / h).round() as u32 {
        INTEGRATORS[how].step(&model, &mut state, &[R::ZERO; 2], scene, h_r);
        if wrapped {
            normalise(&model, &mut state.q).expect("there is no quaternion");
        }
        if i % 16 == 15 {
            worst = larger(worst, (now(&state) - start).abs());
        }
    }
    worst / (6.0 * G)
}

/// The energy of a double pendulum over seconds and over an hour.
pub fn pendulum() -> Vec<Row> {
    let mut rows = pendulum_for_seconds();
    rows.extend(pendulum_for_an_hour());
    rows
}

/// The part of the pendulum's case that takes no minute.
pub fn pendulum_for_seconds() -> Vec<Row> {
    let mut rows = Vec::new();
    for (how, bounds) in [[5e-2; 2], [5e-2; 2], [1e-5, 2e-9]].into_iter().enumerate() {
        let what = format!("{}: energy in 10 s", INTEGRATORS[how].name);
        let [single, double] =
            [swing::<f32>(how, 1e-3, 10.0, true), swing::<f64>(how, 1e-3, 10.0, true)];
        rows.push(Row::measured(what.as_str(), "f32", single, bounds[0]));
        rows.push(Row::measured(what, "f64", double, bounds[1]));
    }
    rows
}

fn pendulum_for_an_hour() -> Vec<Row> {
    const LAST: usize = INTEGRATORS.len() - 1;
    let mut rows = Vec::new();
    let what = format!("{}: energy in 1 h", INTEGRATORS[LAST].name);
    let [single, double] =
        [swing::<f32>(LAST, 2e-3, 3600.0, true), swing::<f64>(LAST, 2e-3, 3600.0, true)];
    rows.push(Row::measured(what.as_str(), "f32", single, 1e-4));
    rows.push(Row::measured(what.as_str(), "f64", double, 1e-5));
    let turns = swing::<f32>(LAST, 2e-3, 3600.0, false);
    let what = format!("{}: energy in 1 h, turns left in q", INTEGRATORS[LAST].name);
    rows.push(Row::naive(what, "f32", turns, 1e-4));
    rows
}
