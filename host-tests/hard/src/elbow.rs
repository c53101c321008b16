//! Operational space at a stretched elbow.

use dynamics_core::algorithms::{
    Damping, OperationalSpace, aba, forward_dynamics, frame, operational_space, osim_inverse, rnea,
};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BASE, Body, Joint, Model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[
    Case {
        number: 18,
        name: "operational space, stretched elbow",
        parameters: "two links of 1 m, 1 kg and 1/16 kg·m² in a plane; angles of the elbow with \
            σ_min(J) = 0, 10⁻⁶, 10⁻³; damping below 10⁻³ of the trace of Λ⁻¹",
        source: "Khatib (1987); Chiaverini (1997)",
        oracle: "closed forms of M, J and torques in f64; the eigenvalues of Λ⁻¹ from its trace \
            and determinant sin²q₂/det M, without cancellation",
        reason: "the error of Λ⁻¹ is ε of its trace; damping below ρ = 10⁻³ of the trace divides \
            it by ρ: 4 ε/ρ of the largest inertia that damping allows, 1/(ρ tr Λ⁻¹)",
        run: poses,
    },
    Case {
        number: 19,
        name: "sweep through the singularity",
        parameters: "the same arm, elbow from −0.05 to 0.05 rad in 4001 steps; the force of 1 m/s² \
            along the arm",
        source: "pseudo-inverses with a threshold jump where an eigenvalue crosses it",
        oracle: "the same closed forms",
        reason: "as case 18 at every step; adjacent steps differ by the true slope and twice that \
            bound at most",
        run: sweep,
    },
];

/// The threshold of damping, as a share of the trace of Λ⁻¹.
const DAMPING: f64 = 1e-3;
/// Inertia of a link about its centre, kg·m²; its mass is 1 kg, its length 1 m.
const I: f64 = 0.0625;

type Elbow<R> = Model<R, 3, 2, 2>;

fn elbow() -> Elbow<f64> {
    let link = |parent| {
        Body::new("link", parent, Joint::revolute([0.0, 0.0, 1.0]))
            .mass(1.0)
            .com([0.5, 0.0, 0.0])
            .inertia([0.0, 0.0, 0.0, I, 0.0, I])
    };
    let at = [1.0, 0.0, 0.0];
    let hand = Body::new("hand", 1, Joint::fixed()).xyz(at);
    Model::new("elbow", [link(BASE), link(0).xyz(at), hand])
}

/// M by its three numbers.
fn matrix(q: f64) -> [f64; 3] {
    let (own, cross) = (I + 0.25, 0.5 * q.cos());
    [I + 0.25 + 1.0 + own + 2.0 * cross, own + cross, own]
}

/// Torques of a state; gravity pulls along the axes.
fn torques(state: &State<f64, 2, 2>) -> [f64; 2] {
    let ([_, q], [v, w], [x, y]) = (state.q, state.qd, state.qdd);
    let ([a, b, d], h) = (matrix(q), 0.5 * q.sin());
    [a * x + b * y - h * (2.0 * v * w + w * w), b * x + d * y + h * v * v]
}

/// Λ⁻¹ in base axes, xx, xy, yy.
fn lightness([q1, q2]: [f64; 2]) -> [f64; 3] {
    let [a, b, d] = matrix(q2);
    let det = a * d - b * b;
    let ((s1, c1), (s2, c2)) = (q1.sin_cos(), (q1 + q2).sin_cos());
    let (x, y) = ([-s1 - s2, -s2], [c1 + c2, c2]);
    let form = |u: [f64; 2], v: [f64; 2]| {
        (d * u[0] * v[0] - b * (u[0] * v[1] + u[1] * v[0]) + a * u[1] * v[1]) / det
    };
    [form(x, x), form(x, y), form(y, y)]
}

/// The damped inverse of Λ⁻¹, xx, xy, yy, and the largest inertia that damping allows.
fn inertia(q: [f64; 2]) -> ([f64; 3], f64) {
    let ([xx, xy, yy], [a, b, d]) = (lightness(q), matrix(q[1]));
    let (trace, det) = (xx + yy, q[1].sin().powi(2) / (a * d - b * b));
    let most = 0.5 * (trace + (trace * trace - 4.0 * det).sqrt());
    let threshold = DAMPING * trace;
    let reciprocal = |value: f64| {
        let short = f64::max(threshold - value, 0.0);
        value / (value * value + short * short)
    };
    let (stiff, light) = (reciprocal(det / most), reciprocal(most));
    let (s, c) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let damped =
        [light * c * c + stiff * s * s, (light - stiff) * c * s, light * s * s + stiff * c * c];
    (damped, 1.0 / threshold)
}

fn across<R: Real>() -> [Force<R>; 2] {
    let (o, e) = (R::ZERO, R::ONE);
    [[e, o, o], [o, e, o]].map(|[x, y, z]| Force::new(R::Vec3::ZERO, R::Vec3::new(x, y, z)))
}

fn task<R: Real>(arm: &Elbow<R>, q: &[R; 2], damping: f64) -> OperationalSpace<R, 2, 2> {
    let damping = Damping::relative(R::from_f64(damping));
    let body = (2, frame::LocalWorldAligned);
    operational_space(arm, q, body, &across(), &RIGID_BODY, damping).expect("M > 0")
}

/// Errors of RNEA, LᵀDL, ABA, Λ⁻¹ by bodies and by M, and Λ, at an elbow's angle.
fn errors<R: Real>(arm: &Elbow<R>, q: f32) -> [f64; 6] {
    let real = |x: f32| R::select(f64::from(x), x);
    let given = State { q: [0.4, q], qd: [1.5, -2.25], qdd: [3.0, -7.5_f32] };
    let wide = super::setup::widened(&given);
    let state = State { q: given.q.map(real), qd: given.qd.map(real), qdd: given.qdd.map(real) };
    let truth = torques(&wide);
    let tau: [R; 2] = truth.map(R::from_f64);
    let [a, b, d] = matrix(wide.q[1]);
    let [t, u] = [0, 1].map(|i| tau[i].to_f64() - truth[i]);
    let det = a * d - b * b;
    let qdd = [wide.qdd[0] + (d * t - b * u) / det, wide.qdd[1] + (a * u - b * t) / det];
    let worst = |found: &[R], truth: &[f64], scale: f64| {
        let each = found.iter().zip(truth);
        each.fold(0.0, |worst, (x, truth)| larger(worst, (x.to_f64() - truth).abs() / scale))
    };
    let full = |truth: &[f64]| truth.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    let [xx, xy, yy] = lightness(wide.q);
    let light = [xx, xy, xy, yy];
    let ([xx, xy, yy], cap) = inertia(wide.q);
    let heavy = [xx, xy, xy, yy];
    let bodies =
        osim_inverse(arm, &state.q, 2, frame::LocalWorldAligned, &RIGID_BODY).expect("M > 0");
    let task = task(arm, &state.q, DAMPING);
    [
        worst(&rnea(arm, &state, &RIGID_BODY), &truth, full(&truth)),
        worst(&forward_dynamics(arm, &state, &tau, &RIGID_BODY).expect("M > 0"), &qdd, full(&qdd)),
        worst(&aba(arm, &state, &tau, &RIGID_BODY).expect("M > 0"), &qdd, full(&qdd)),
        worst(bodies.along(&across()).as_flattened(), &light, full(&light)),
        worst(task.mobility.as_flattened(), &light, full(&light)),
        worst(task.inertia.as_flattened(), &heavy, cap),
    ]
}

fn poses() -> Vec<Row> {
    let quantities = ["RNEA", "CRBA + LᵀDL", "ABA", "OSIM⁻¹ by bodies", "OSIM⁻¹ by J M⁻¹ Jᵀ"];
    let (double, mut rows) = (elbow(), Vec::new());
    let single = double.to_f32();
    let (mut worst, mut most) = ([[0.0; 6]; 2], 0.0);
    // σ_min σ_max = sin q₂, and σ_max = √5 where it is small.
    for (name, sigma) in [("0", 0.0), ("10⁻⁶", 1e-6), ("10⁻³", 1e-3)] {
        let q = (sigma * 5.0_f64.sqrt()) as f32;
        let measured = [errors(&single, q), errors(&double, q)];
        for (worst, measured) in worst.iter_mut().zip(measured) {
            *worst = std::array::from_fn(|k| larger(worst[k], measured[k]));
        }
        let [a, b, d] = matrix(f64::from(q));
        let (trace, det) = (a + d, a * d - b * b);
        most = larger(most, (trace + (trace * trace - 4.0 * det).sqrt()).powi(2) / (4.0 * det));
        let name = format!("OSIM, damped, σ_min = {name}");
        rows.push(Row::stated(
            name.clone(),
            "f32",
            measured[0][5],
            4.0 * f64::from(f32::EPSILON) / DAMPING,
        ));
        rows.push(Row::stated(name, "f64", measured[1][5], 4.0 * f64::EPSILON / DAMPING));
    }
    for (k, quantity) in quantities.into_iter().enumerate() {
        for (scalar, error, bound) in
            [("f32", worst[0][k], SINGLE[k]), ("f64", worst[1][k], DOUBLE[k])]
        {
            let row = Row::measured(quantity, scalar, error, bound);
            rows.push(if k == 0 { row } else { row.of_condition(most) });
        }
    }
    rows
}

/// The results of the sweep: the largest error and the largest step between neighbours, relative to
/// the largest force.
struct Sweep {
    error: f64,
    step: f64,
}

/// The force of 1 m/s² along the arm by `force`, over the sweep.
fn swept<R: Real>(force: impl Fn(&[R; 2]) -> [R; 2]) -> Sweep {
    let (mut error, mut step, mut before) = (0.0, 0.0, None::<[f64; 2]>);
    for k in -2000..=2000 {
        let q = [R::ZERO, R::from_f64(f64::from(k) * 2.5e-5)];
        let ([xx, xy, _], cap) = inertia(q.map(R::to_f64));
        let found = force(&q).map(R::to_f64);
        for (i, truth) in [xx, xy].into_iter().enumerate() {
            error = larger(error, (found[i] - truth).abs() / cap);
            if let Some(before) = before {
                step = larger(step, (found[i] - before[i]).abs() / cap);
            }
        }
        before = Some(found);
    }
    Sweep { error, step }
}

fn sweep() -> Vec<Row> {
    let (double, along) = (elbow(), |m: [[f32; 2]; 2]| m[0]);
    let single = double.to_f32();
    let f32s = swept(|q| task(&single, q, DAMPING).inertia[0]);
    let f64s = swept(|q| task(&double, q, DAMPING).inertia[0]);
    let truth = swept(|q: &[f64; 2]| {
        let ([xx, xy, _], _) = inertia(*q);
        [xx, xy]
    });
    let plain = swept(|q| along(task(&single, q, 0.0).inertia));
    // A pseudo-inverse: what is below the threshold counts for nothing.
    let cut = swept(|q| {
        let m = task(&single, q, 0.0).mobility;
        let threshold = 1e-3 * (m[0][0] + m[1][1]);
        let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let most = m[0][0] + m[1][1];
        match det / most < threshold {
            true => [m[0][0] / (most * most), m[0][1] / (most * most)],
            false => [m[1][1] / det, -m[0][1] / det],
        }
    });
    let bound = |epsilon: f64| 4.0 * epsilon / DAMPING;
    let (e32, e64) = (bound(f32::EPSILON.into()), bound(f64::EPSILON));
    vec![
        Row::stated("force, damped", "f32", f32s.error, e32),
        Row::stated("force, damped", "f64", f64s.error, e64),
        Row::stated("largest step between neighbours", "f32", f32s.step, truth.step + 2.0 * e32),
        Row::stated("largest step between neighbours", "f64", f64s.step, truth.step + 2.0 * e64),
        Row::naive("naive: Λ undamped, largest step", "f32", plain.step, truth.step + 2.0 * e32),
        Row::naive(
            "naive: cut off below the threshold, largest step",
            "f32",
            cut.step,
            truth.step + 2.0 * e32,
        ),
    ]
}

const SINGLE: [f64; 5] = [4e-7, 1e-6, 1e-7, 5e-7, 5e-7];
const DOUBLE: [f64; 5] = [1.5e-15, 1.5e-15, 1e-15, 3e-15, 2e-15];
