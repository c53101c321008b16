//! Far away, tiny, giant, and in other frames.

use super::measure::{ErrorBounds, against_oracle, by_joints};
use super::naive::{absolute, floored};
use super::setup::list::{arm, reframed};
use super::setup::{Setup, widened};
use dynamics_core::scalar::Real;
use fixtures::hard::{Answers, GRAVITY, N, scene};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[
    Case {
        number: 13,
        name: "base 10⁴ m from the origin",
        parameters: "UR5e, its base at (10⁴, −10⁴, 10⁴) m, four states",
        source: "libraries that compute in base or world coordinates: m r² of a distant origin \
            dominates the inertia",
        oracle: "50 digits, and the bits at the origin",
        reason: "in link coordinates no number depends on the position of the base",
        run: far_base,
    },
    Case {
        number: 42,
        name: "tiny and giant robots",
        parameters: "UR5e scaled to 2⁻⁴ of its length and 17 g (upper arm 1.3·10⁻⁶ kg·m²), and to \
            2⁴ of its length and 9 t, in motions scaled in time",
        source: "fingers and excavators; lower bounds on pivots (10⁻⁶) suit neither",
        oracle: "50 digits, and the significands of the UR5e: powers of two scale exactly",
        reason: "the algorithms contain no absolute number, so that every bit but the exponents is \
            the same",
        run: tiny_and_giant,
    },
    Case {
        number: 43,
        name: "signed permutations, general frames",
        parameters: "UR5e, whose placements are quarter turns, and the same arm with each link's \
            frame rotated about its joint by 0.4 + 0.7 i rad",
        source: "libraries that round axis-aligned placements or treat them as special",
        oracle: "50 digits, and each compared with the other",
        reason: "rotations rounded to f32 move the arm by ε of its size: torques agree within 4 \
            ulp of a joint's full scale",
        run: frames,
    },
];

/// The arm as it stands at the origin.
fn plain() -> Setup<N> {
    arm(46, "payload 0")
}

/// Whether two arms give the same bits, once the second one's numbers are multiplied by powers of
/// two: torque, acceleration and mobility.
pub(super) fn same<R: Real>(
    a: &[&Answers<R, N>],
    b: &[&Answers<R, N>],
    [torque, accel, mobility]: [f64; 3],
) -> bool {
    let by = |x: R, factor: f64| x * R::from_f64(factor);
    let matrix = |m: [[R; 3]; 3]| m.map(|row| row.map(|x| by(x, mobility)));
    a.iter().zip(b).all(|(a, b)| {
        a.rnea == b.rnea.map(|x| by(x, torque))
            && a.forward == b.forward.map(|q| q.map(|x| by(x, accel)))
            && a.aba == b.aba.map(|q| q.map(|x| by(x, accel)))
            && a.mobility == b.mobility.map(matrix)
            && a.by_matrix == b.by_matrix.map(matrix)
    })
}

/// Claims that two setups give the same bits, up to powers of two.
fn same_bits(name: &str, other: &Setup<N>, factors: [f64; 3]) -> Vec<Row> {
    let plain = plain();
    let (a, b) = (plain.answers(&plain.truth()), other.answers(&other.truth()));
    let (a32, b32): (Vec<_>, Vec<_>) = a.iter().zip(&b).map(|(a, b)| (&a.0, &b.0)).unzip();
    let (a64, b64): (Vec<_>, Vec<_>) = a.iter().zip(&b).map(|(a, b)| (&a.1, &b.1)).unzip();
    vec![
        Row::claim(name, "f32", same(&a32, &b32, factors)),
        Row::claim(name, "f64", same(&a64, &b64, factors)),
    ]
}

fn far_base() -> Vec<Row> {
    let setup = arm(13, "base 10⁴ m away");
    let mut rows = against_oracle(&setup, &FAR);
    rows.extend(same_bits("everything: the same bits as at the origin", &setup, [1.0; 3]));
    let truth = setup.truth();
    let g = glam::Vec3::new(0.0, 0.0, -GRAVITY as f32);
    let single = setup.states.iter().map(|s| Ok(absolute(&setup.single, s, g)));
    let single = by_joints(single, &truth.states, |t| Some(&t.rnea));
    let double =
        setup.states.iter().map(|s| Ok(absolute(&setup.double, &widened(s), g.as_dvec3())));
    let double = by_joints(double, &truth.states, |t| Some(&t.rnea));
    let name = "naive: RNEA in absolute coordinates";
    rows.push(Row::naive(name, "f32", single, FAR.single[0]));
    rows.push(Row::naive(name, "f64", double, FAR.double[0]));
    let near = plain();
    let at_origin = near.states.iter().map(|s| Ok(absolute(&near.single, s, g)));
    let at_origin = by_joints(at_origin, &near.truth().states, |t| Some(&t.rnea));
    let name = "RNEA in absolute coordinates, base at the origin";
    rows.push(Row::measured(name, "f32", at_origin, NEAR));
    rows
}

fn tiny_and_giant() -> Vec<Row> {
    let (tiny, giant) = (arm(42, "tiny"), arm(42, "giant"));
    let mut rows = against_oracle(&tiny, &SCALED);
    rows.extend(against_oracle(&giant, &SCALED));
    // Torques as m l, accelerations as 1/l, mobilities as 1/m.
    let factors = |length: f64, mass: f64| [1.0 / (mass * length), length, mass];
    let name = "everything, tiny: the significands of UR5e";
    rows.extend(same_bits(name, &tiny, factors(1.0 / 16.0, 1.0 / 1024.0)));
    let name = "everything, giant: the significands of UR5e";
    rows.extend(same_bits(name, &giant, factors(16.0, 512.0)));
    let (truth, scene) = (tiny.truth(), scene(&tiny.extras));
    let found = tiny.states.iter().enumerate().map(|(k, state)| {
        let tau = tiny.tau(&truth, k);
        Ok(floored(&tiny.single, state, &tau, &scene, 1e-6))
    });
    let error = by_joints(found, &truth.states, |t| t.qdd.as_deref());
    let name = "naive: pivots of at least 10⁻⁶, tiny";
    rows.push(Row::naive(name, "f32", error, SCALED.single[1]));
    rows
}

fn frames() -> Vec<Row> {
    let general = reframed();
    let mut rows = against_oracle(&general, &GENERAL);
    let plain = plain();
    let (a, b) = (plain.answers(&plain.truth()), general.answers(&general.truth()));
    let ulps = |error: f64, ulp: f64| error / ulp;
    let single = apart(a.iter().map(|a| a.0.rnea), b.iter().map(|b| b.0.rnea));
    let double = apart(a.iter().map(|a| a.1.rnea), b.iter().map(|b| b.1.rnea));
    let name = "RNEA, one against the other, in ulp of full scale";
    rows.push(Row::stated(name, "f32", ulps(single, f32::EPSILON.into()), 4.0));
    // Its f64 twin has f32's numbers: as far apart.
    rows.push(Row::stated(name, "f64", ulps(double, f32::EPSILON.into()), 4.0));
    rows
}

/// The difference of two sets of torques, relative to each joint's largest.
pub(super) fn apart<R: Real>(
    a: impl Iterator<Item = [R; N]> + Clone,
    b: impl Iterator<Item = [R; N]>,
) -> f64 {
    let mut scale = [0.0_f64; N];
    for row in a.clone() {
        for (scale, x) in scale.iter_mut().zip(row) {
            *scale = scale.max(x.to_f64().abs());
        }
    }
    let mut worst = 0.0;
    for (a, b) in a.zip(b) {
        for ((a, b), scale) in a.into_iter().zip(b).zip(scale) {
            worst = larger(worst, (a.to_f64() - b.to_f64()).abs() / scale);
        }
    }
    worst
}

/// RNEA in absolute coordinates about a near origin.
const NEAR: f64 = 3e-4;

const FAR: ErrorBounds = ErrorBounds {
    single: [4e-7, 6e-6, 5e-6, 6e-7, 4e-7],
    double: [8e-16, 1e-14, 1.5e-14, 6e-16, 6e-16],
};

const SCALED: ErrorBounds = ErrorBounds {
    single: [4e-7, 6e-6, 5e-6, 6e-7, 4e-7],
    double: [8e-16, 1e-14, 1.5e-14, 6e-16, 6e-16],
};

const GENERAL: ErrorBounds = ErrorBounds {
    single: [5e-7, 2e-6, 8e-6, 5e-7, 6e-7],
    double: [1e-15, 1.5e-14, 5e-15, 1.5e-15, 1.5e-15],
};
