//! A slide far out on a turntable.

use dynamics_core::algorithms::Damping;
use dynamics_core::algorithms::{
    aba, forward_dynamics, frame, operational_space, osim_inverse, rnea,
};
use dynamics_core::effects::{RIGID_BODY, Spring};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[Case {
    number: 14,
    name: "slide 10⁴ m out, stroke of mm",
    parameters: "a turntable of 2 kg·m²; 10⁴ m from its axis a slide along x with 0.5 kg, 0.25 \
        kg·m² and a spring of 10⁶ N/m; q = 0.5, 1, 3, −2 mm",
    source: "gantries whose q counts from a distant datum, where f32 resolves 1 mm",
    oracle: "polar coordinates in f64: τ = (J + m r²) θ̈ + 2 m r ṙ θ̇, F = m (r̈ − r θ̇²) + k s with r \
        = L + s",
    reason: "L + s is rounded once, by ε of L; the spring uses s itself, which a q that contains L \
        would round to 1 mm",
    run: slide,
}];

/// The placement of the slide, m.
const FAR: f64 = 1e4;
/// Moment of inertia of the table and of the slide, mass of the slide.
const J: f64 = 2.0 + 0.25;
const MASS: f64 = 0.5;
/// N/m
const STIFFNESS: f64 = 1e6;

/// The turntable and the slide, whose q begins `from` m short of the placement.
fn table(from: f64) -> ArmModel<f64, 2> {
    let z = [0.0, 0.0, 1.0];
    Model::new(
        "table",
        [
            Body::new("table", BASE, Joint::revolute(z)).inertia([2.0, 0.0, 0.0, 2.0, 0.0, 2.0]),
            Body::new("slide", 0, Joint::prismatic([1.0, 0.0, 0.0]))
                .xyz([FAR - from, 0.0, 0.0])
                .mass(MASS)
                .inertia([0.25, 0.0, 0.0, 0.25, 0.0, 0.25]),
        ],
    )
}

/// Numbers that f32 has.
const STATES: [State<f32, 2, 2>; 4] = [
    state(0.5, 0.000_488_281_25),
    state(-1.25, 0.000_976_562_5),
    state(2.0, 0.003),
    state(0.75, -0.002),
];

const fn state(turn: f32, stroke: f32) -> State<f32, 2, 2> {
    State { q: [turn, stroke], qd: [0.01 * turn, 0.5], qdd: [0.001 * turn, 40.0 * turn] }
}

/// Torque and force of one state.
fn closed_form(state: &State<f64, 2, 2>) -> [f64; 2] {
    let ([_, s], [turn, slide], [turning, sliding]) = (state.q, state.qd, state.qdd);
    let r = FAR + s;
    [
        (J + MASS * r * r) * turning + 2.0 * MASS * r * slide * turn,
        MASS * (sliding - r * turn * turn) + STIFFNESS * s,
    ]
}

/// Errors of RNEA, LᵀDL, ABA, and mobilities by bodies and by M; `offset` m are in q.
fn errors<R: Real>(arm: &ArmModel<R, 2>, offset: f64) -> [f64; 5] {
    let real = |x: f32| R::select(f64::from(x), x);
    let [k, at] = [STIFFNESS, offset].map(R::from_f64);
    let spring = Spring { stiffness: [R::ZERO, k], rest: [R::ZERO, at] };
    let scene = (RIGID_BODY, spring);
    let (o, e) = (R::ZERO, R::ONE);
    let across =
        [[e, o, o], [o, e, o]].map(|[x, y, z]| Force::new(R::Vec3::ZERO, R::Vec3::new(x, y, z)));
    let mut worst = [0.0; 5];
    for given in &STATES {
        let wide = super::setup::widened(given);
        let mut state =
            State { q: given.q.map(real), qd: given.qd.map(real), qdd: given.qdd.map(real) };
        // As a program that measures from afar would store it.
        state.q[1] = R::from_f64(offset + wide.q[1]);
        let truth = closed_form(&wide);
        let found = rnea(arm, &state, &scene);
        let tau: [R; 2] = truth.map(R::from_f64);
        // q̈ of the rounded torques; M is diagonal.
        let r = FAR + wide.q[1];
        let inertia = [J + MASS * r * r, MASS];
        let qdd: [f64; 2] =
            std::array::from_fn(|i| wide.qdd[i] + (tau[i].to_f64() - truth[i]) / inertia[i]);
        let by_matrix = forward_dynamics(arm, &state, &tau, &scene).expect("M > 0");
        let by_bodies = aba(arm, &state, &tau, &scene).expect("M > 0");
        // Full scale of an acceleration: what the largest force gives.
        let largest = [truth[0], 4e-3 * STIFFNESS];
        for i in 0..2 {
            let off = |x: R, truth: f64, scale: f64| (x.to_f64() - truth).abs() / scale.abs();
            worst[0] = larger(worst[0], off(found[i], truth[i], largest[i]));
            worst[1] = larger(worst[1], off(by_matrix[i], qdd[i], largest[i] / inertia[i]));
            worst[2] = larger(worst[2], off(by_bodies[i], qdd[i], largest[i] / inertia[i]));
        }
        let truth = [[1.0 / MASS, 0.0], [0.0, r * r / inertia[0]]];
        let bodies = osim_inverse(arm, &state.q, 1, frame::Local, &scene).expect("M > 0");
        let damping = Damping::relative(R::ZERO);
        let task = operational_space(arm, &state.q, (1, frame::Local), &across, &scene, damping);
        for (k, found) in [bodies.along(&across), task.expect("M > 0").mobility].iter().enumerate()
        {
            for (found, truth) in found.as_flattened().iter().zip(truth.as_flattened()) {
                worst[3 + k] = larger(worst[3 + k], (found.to_f64() - truth).abs() * MASS);
            }
        }
    }
    worst
}

fn slide() -> Vec<Row> {
    let quantities = ["RNEA", "CRBA + LᵀDL", "ABA", "OSIM⁻¹ by bodies", "OSIM⁻¹ by J M⁻¹ Jᵀ"];
    let (single, double) = (errors(&table(0.0).to_f32(), 0.0), errors(&table(0.0), 0.0));
    let mut rows = Vec::new();
    for (k, quantity) in quantities.into_iter().enumerate() {
        rows.push(Row::measured(quantity, "f32", single[k], SINGLE[k]));
        rows.push(Row::measured(quantity, "f64", double[k], DOUBLE[k]));
    }
    let far = errors(&table(FAR).to_f32(), FAR);
    rows.push(Row::naive("naive: RNEA with the offset in q", "f32", far[0], SINGLE[0]));
    rows
}

const SINGLE: [f64; 5] = [3e-7, 4e-7, 4e-7, 1e-7, 1e-7];
const DOUBLE: [f64; 5] = [3e-16, 3e-16, 3e-16, 3e-16, 3e-16];
