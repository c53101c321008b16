//! Invariances: under the choice of root, of numbering, of the direction of gravity, and under
//! rounded rotations.

use super::measure::{ErrorBounds, against_oracle, by_joints};
use super::placements::{apart, same};
use super::setup::list::arm;
use super::setup::{Setup, literally_in_f64, turning, widened};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::{Answers, N, RENUMBERING, Scene, answers_to, scene};
use glam::DMat3;
use host_tests::hard::{Case, Row};

pub const CASES: &[Case] = &[
    Case {
        number: 44,
        name: "frame, gravity, root do not matter",
        parameters: "UR5e on a wall; rotated with gravity by a quarter turn about x, and by 0.7 \
            rad about (1, 2, 3); three bodies in free motion, rooted at either end",
        source: "errors in frames that cancel when gravity is along z",
        oracle: "50 digits for the wall; the arm that is not rotated; the other root",
        reason: "a quarter turn keeps the bits. Another rotation rounds the base's placement once: \
            some ε of full scale",
        run: turned,
    },
    Case {
        number: 45,
        name: "two numberings of one tree",
        parameters: "a trunk with two limbs, one of them forked, its six bodies in two orders; \
            four states",
        source: "index arithmetic that chains do not reveal",
        oracle: "50 digits for each, and one against the other",
        reason: "only the order of a sum over children differs: one or two ulp of full scale",
        run: renumbered,
    },
    Case {
        number: 48,
        name: "rotations rounded to 24 bits",
        parameters: "six links with general axes, placements and inertias; arithmetic in f64, \
            rotations as f32 rounds them, then orthonormal; four states",
        source: "Eᵀ is not E⁻¹ of a rounded rotation: CRBA uses Eᵀ, ABA uses E outward and Eᵀ \
            inward",
        oracle: "50 digits for the orthonormal arm; for the rounded one, ABA against CRBA + LᵀDL",
        reason: "each of n rotations errs by ε/2, which is another arm, and forward dynamics \
            multiplies this by κ: n κ ε/2 with n = 6, κ = 360",
        run: rounded,
    },
];

/// The quantities of a setup under another scene, its torques the oracle's.
fn under(
    setup: &Setup<N>,
    like: &Setup<N>,
    scenes: (&Scene<f32, N>, &Scene<f64, N>),
) -> Vec<(Answers<f32, N>, Answers<f64, N>)> {
    let truth = like.truth();
    let each = setup.states.iter().enumerate().map(|(k, state)| {
        let tau = like.tau(&truth, k);
        (
            answers_to(&turning(&setup.single), state, &tau, scenes.0),
            answers_to(&turning(&setup.double), &widened(state), &tau.map(f64::from), scenes.1),
        )
    });
    each.collect()
}

/// The setup with its base and gravity turned: x_new = R x.
fn turned_with_gravity(setup: &Setup<N>, r: DMat3) -> (Setup<N>, Scene<f32, N>, Scene<f64, N>) {
    let mut turned = setup.clone();
    let first = &mut turned.double.links[0].placement;
    (first.rot, first.pos) = (first.rot * r.transpose(), r * first.pos);
    let turned = Setup::new(44, "turned", &turned.double, setup.extras, setup.states.clone());
    let mut single: Scene<f32, N> = scene(&setup.extras);
    let mut double: Scene<f64, N> = scene(&setup.extras);
    double.0.0 = r * double.0.0;
    single.0.0 = double.0.0.as_vec3();
    // The direction of gravity, rounded to f32.
    double.0.0 = single.0.0.as_dvec3();
    (turned, single, double)
}

fn turned() -> Vec<Row> {
    let wall = arm(44, "base turned, gravity not");
    let mut rows = against_oracle(&wall, &WALL);
    let plain = arm(46, "payload 0");
    let (single, double) = (scene(&plain.extras), scene(&plain.extras));
    let a = under(&plain, &plain, (&single, &double));
    // x to x, y to z, z to −y, without rounding.
    let quarter = DMat3::from_cols(glam::DVec3::X, glam::DVec3::Z, -glam::DVec3::Y);
    let (turned, single, double) = turned_with_gravity(&plain, quarter);
    let b = under(&turned, &plain, (&single, &double));
    let name = "everything, turned by a quarter with gravity: the same bits";
    let (a32, b32): (Vec<_>, Vec<_>) = a.iter().zip(&b).map(|(a, b)| (&a.0, &b.0)).unzip();
    rows.push(Row::claim(name, "f32", same(&a32, &b32, [1.0; 3])));
    let (a64, b64): (Vec<_>, Vec<_>) = a.iter().zip(&b).map(|(a, b)| (&a.1, &b.1)).unzip();
    rows.push(Row::claim(name, "f64", same(&a64, &b64, [1.0; 3])));
    let general = DMat3::from_axis_angle(glam::DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let (turned, single, double) = turned_with_gravity(&plain, general);
    let b = under(&turned, &plain, (&single, &double));
    let f32s = apart(a.iter().map(|a| a.0.rnea), b.iter().map(|b| b.0.rnea));
    let f64s = apart(a.iter().map(|a| a.1.rnea), b.iter().map(|b| b.1.rnea));
    let name = "RNEA, turned anyhow with gravity";
    rows.push(Row::measured(name, "f32", f32s, TURNED));
    rows.push(Row::measured(name, "f64", f64s, TURNED));
    rows.extend(super::rerooted_chain::rows());
    rows
}

fn renumbered() -> Vec<Row> {
    let one = arm(45, "tree");
    let mut rows = against_oracle(&one, &TREE);
    rows.extend(against_oracle(&arm(45, "tree, numbered otherwise"), &RENUMBERED));
    let mut other = arm(45, "tree, numbered otherwise");
    other.states = one
        .states
        .iter()
        .map(|s| State { q: permuted(s.q), qd: permuted(s.qd), qdd: permuted(s.qdd) })
        .collect();
    let (truth, single, double) = (one.truth(), scene(&one.extras), scene(&one.extras));
    let a = one.answers(&truth);
    let b: Vec<_> = other
        .states
        .iter()
        .enumerate()
        .map(|(k, state)| {
            let tau = permuted(one.tau(&truth, k));
            let wide = tau.map(f64::from);
            (
                answers_to(&turning(&other.single), state, &tau, &single),
                answers_to(&turning(&other.double), &widened(state), &wide, &double),
            )
        })
        .collect();
    let f32s = both(
        &a.iter().map(|a| a.0).collect::<Vec<_>>(),
        &b.iter().map(|b| b.0).collect::<Vec<_>>(),
    );
    let f64s = both(
        &a.iter().map(|a| a.1).collect::<Vec<_>>(),
        &b.iter().map(|b| b.1).collect::<Vec<_>>(),
    );
    for (k, quantity) in ["RNEA", "CRBA + LᵀDL", "ABA"].into_iter().enumerate() {
        let name = format!("{quantity}, one numbering against the other");
        rows.push(Row::measured(name.clone(), "f32", f32s[k], EITHER[k][0]));
        rows.push(Row::measured(name, "f64", f64s[k], EITHER[k][1]));
    }
    rows
}

/// Numbers of the first tree's joints in the other one's order.
fn permuted<T: Copy>(from: [T; N]) -> [T; N] {
    RENUMBERING.map(|at| from[at])
}

/// The differences of torques and accelerations of the two trees.
fn both<R: Real>(a: &[Answers<R, N>], b: &[Answers<R, N>]) -> [f64; 3] {
    let solved = |qdd: Result<[R; N], _>| qdd.unwrap_or_else(|_| panic!("M > 0"));
    [
        apart(a.iter().map(|a| permuted(a.rnea)), b.iter().map(|b| b.rnea)),
        apart(a.iter().map(|a| permuted(solved(a.forward))), b.iter().map(|b| solved(b.forward))),
        apart(a.iter().map(|a| permuted(solved(a.aba))), b.iter().map(|b| solved(b.aba))),
    ]
}

fn rounded() -> Vec<Row> {
    let setup = arm(48, "general rotations");
    let mut rows = against_oracle(&setup, &ROTATIONS);
    let truth = setup.truth();
    let condition = truth.condition.unwrap_or(f64::NAN);
    let mut literal = setup.clone();
    literal.double = literally_in_f64(&setup.double, &setup.single);
    for (name, setup, bound) in [
        ("orthonormal", &setup, None),
        ("as f32 rounds them", &literal, Some(6.0 * condition * f64::from(f32::EPSILON) / 2.0)),
    ] {
        let answers = setup.answers(&truth);
        let solved = |qdd: Result<[f64; N], _>| qdd.unwrap_or_else(|_| panic!("M > 0"));
        let by_matrix = answers.iter().map(|(_, a)| solved(a.forward));
        let by_bodies = answers.iter().map(|(_, a)| solved(a.aba));
        let error = apart(by_matrix, by_bodies);
        let name = format!("CRBA + LᵀDL against ABA, rotations {name}");
        let row = match bound {
            Some(bound) => Row::stated(name, "f64", error, bound),
            None => Row::measured(name, "f64", error, ORTHONORMAL),
        };
        rows.push(row.of_condition(condition));
        if bound.is_some() {
            let errors = [
                by_joints(answers.iter().map(|(_, a)| a.forward), &truth.states, |t| {
                    t.qdd.as_deref()
                }),
                by_joints(answers.iter().map(|(_, a)| a.aba), &truth.states, |t| t.qdd.as_deref()),
            ];
            for (quantity, error) in ["CRBA + LᵀDL", "ABA"].into_iter().zip(errors) {
                let name = format!("{quantity}, rotations as f32 rounds them");
                let bound = 6.0 * condition * f64::from(f32::EPSILON) / 2.0;
                rows.push(Row::stated(name, "f64", error, bound).of_condition(condition));
            }
        }
    }
    rows
}

/// The bound of RNEA with turned frames.
const TURNED: f64 = 2e-7;
/// ABA against LᵀDL, rotations orthonormal to f64.
const ORTHONORMAL: f64 = 5e-14;
/// RNEA, LᵀDL and ABA, one numbering against the other.
const EITHER: [[f64; 2]; 3] = [[2.5e-7, 0.0], [3e-7, 8e-16], [5e-7, 4e-16]];

const WALL: ErrorBounds = ErrorBounds {
    single: [4e-7, 4e-6, 4e-6, 6e-7, 4e-7],
    double: [1.5e-15, 6e-15, 1.5e-14, 6e-16, 6e-16],
};

const TREE: ErrorBounds = ErrorBounds {
    single: [4e-7, 1.5e-6, 8e-7, 2e-7, 3e-7],
    double: [8e-16, 1.5e-15, 8e-16, 1.5e-15, 5e-16],
};

const RENUMBERED: ErrorBounds = ErrorBounds {
    single: [3e-7, 5e-7, 8e-7, 3e-7, 5e-7],
    double: [8e-16, 1.5e-15, 2e-15, 1.5e-15, 6e-16],
};

const ROTATIONS: ErrorBounds = ErrorBounds {
    single: [6e-7, 1.5e-5, 1e-5, 1.5e-6, 6e-7],
    double: [1e-15, 3e-14, 3e-14, 1.5e-15, 1.5e-15],
};
