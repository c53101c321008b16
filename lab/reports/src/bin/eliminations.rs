//! Prints how accurate forward dynamics is in f32 by its two eliminations, as lines of a table:
//! `cargo xtask history` puts them into docs/history.md.

use dynamics_core::Ltdl;
use dynamics_core::algorithms::{aba, crba, forward_dynamics, ltdl, rnea, solve};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot, attach_to};
use dynamics_core::robots::{G1, G1Free};
use dynamics_core::state::State;
use dynamics_core::state::manifold::normalise;
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use host_tests::widen::widened;
use proptest::test_runner::TestRng;

const STATES: usize = 32;
/// The fifteenth root of 1000.
const PER_ROD: f64 = 1.584_893_192_461_113_6;
/// Steps of the power iterations that find κ(M).
const STEPS: usize = 60;

#[derive(Clone, Copy)]
enum Stance {
    Straight,
    Random,
    Zigzag,
}

/// The measured figures of one case; errors relative to the largest acceleration.
struct Measured {
    condition: f64,
    matrix: Vec<f64>,
    bodies: Vec<f64>,
    f64s: f64,
}

fn main() {
    lengths::<8>();
    lengths::<16>();
    lengths::<32>();
    lengths::<64>();
    let (heavy, light) = (rods::<16>(PER_ROD, true), rods::<16>(1.0 / PER_ROD, true));
    case("16 rods, the last 1000 × the first", &heavy, Stance::Random);
    case("16 rods, the last 1/1000 of the first", &light, Stance::Random);
    let base =
        Body::new("base", BASE, Joint::free()).mass(1.0).inertia([0.01, 0.0, 0.0, 0.01, 0.0, 0.01]);
    let floating: Model<f64, 17, 23, 22> =
        Model::new("floating", attach_to(base, &bodies::<16>(1.0, true)));
    case("16 rods on a free base", &floating, Stance::Random);
    case("G1, pelvis held", &G1::MODEL, Stance::Random);
    case("G1, pelvis free", &G1Free::MODEL, Stance::Random);
}

fn lengths<const N: usize>() {
    let plane = rods::<N>(1.0, false);
    case(&format!("{N} rods, straight"), &plane, Stance::Straight);
    case(&format!("{N} rods, zigzag ±75°"), &plane, Stance::Zigzag);
    case(&format!("{N} rods, random"), &rods::<N>(1.0, true), Stance::Random);
}

fn rods<const N: usize>(factor: f64, in_space: bool) -> ArmModel<f64, N> {
    Model::new("rods", bodies(factor, in_space))
}

/// Rods of 0.25 m along x, the first of 1 kg, each `factor` times as heavy as the one before; on
/// axes along y, or along y and z by turns.
fn bodies<const N: usize>(factor: f64, in_space: bool) -> [Body; N] {
    std::array::from_fn(|i| {
        // Not `powf`, whose last bit is each platform's own.
        let mass = (0..i).fold(1.0, |mass, _| mass * factor);
        let across = mass * 0.25 * 0.25 / 12.0;
        let axis = match in_space && i % 2 == 1 {
            true => [0.0, 0.0, 1.0],
            false => [0.0, 1.0, 0.0],
        };
        let (parent, at) = if i == 0 { (BASE, 0.0) } else { (i - 1, 0.25) };
        Body::new("rod", parent, Joint::revolute(axis))
            .xyz([at, 0.0, 0.0])
            .mass(mass)
            .com([0.125, 0.0, 0.0])
            .inertia([0.02 * across, 0.0, 0.0, across, 0.0, across])
    })
}

fn case<const B: usize, const Q: usize, const V: usize>(
    name: &str,
    model: &Model<f64, B, Q, V>,
    stance: Stance,
) {
    let mut measured =
        Measured { condition: 0.0, matrix: Vec::new(), bodies: Vec::new(), f64s: 0.0 };
    // The same numbers in both precisions: those of f32.
    let (single, double) = (&model.to_f32(), &widened(model));
    let mut rng = random_numbers();
    for _ in 0..STATES {
        one(single, double, stance, &mut rng, &mut measured);
    }
    for errors in [&mut measured.matrix, &mut measured.bodies] {
        errors.sort_by(f64::total_cmp);
    }
    let numbers = [&measured.matrix, &measured.bodies].map(|e| [e[STATES / 2], e[STATES - 1]]);
    let [[m, m_worst], [b, b_worst]] = numbers;
    let ratio = m_worst / b_worst;
    println!(
        "| {name} | {V} | {:.0e} | {m:.0e} | {m_worst:.0e} | {b:.0e} | {b_worst:.0e} | {ratio:.1} \
         | {:.0e} |",
        measured.condition, measured.f64s
    );
}

/// Forward dynamics of one state, by both eliminations.
fn one<const B: usize, const Q: usize, const V: usize>(
    single: &Model<f32, B, Q, V>,
    double: &Model<f64, B, Q, V>,
    stance: Stance,
    rng: &mut TestRng,
    measured: &mut Measured,
) {
    let mut q: [f64; Q] = within(rng, std::f64::consts::PI);
    let turn = 75.0_f64.to_radians();
    match stance {
        Stance::Random => normalise(double, &mut q).expect("no random quaternion is zero"),
        Stance::Straight => q = [0.0; Q],
        Stance::Zigzag => q = std::array::from_fn(|i| if i % 2 == 0 { turn } else { -turn }),
    }
    let state = State {
        q: q.map(|x| x as f32),
        qd: within(rng, 3.0).map(|x: f64| x as f32),
        qdd: within(rng, 10.0).map(|x: f64| x as f32),
    };
    let wide = State {
        q: state.q.map(f64::from),
        qd: state.qd.map(f64::from),
        qdd: state.qdd.map(f64::from),
    };
    // Torques of accelerations of a common size, rounded.
    let tau = inverse(double, &wide).map(|x| x as f32);
    let wide_tau = tau.map(f64::from);
    let m = crba(double, &wide.q, &RIGID_BODY);
    let factors = ltdl(double, &m).expect("M > 0");
    let mut truth = forward_dynamics(double, &wide, &wide_tau, &RIGID_BODY).expect("M > 0");
    for _ in 0..2 {
        // Iterative refinement: what the torques of this acceleration lack.
        let now = inverse(double, &State { qdd: truth, ..wide });
        let rest = std::array::from_fn(|i| wide_tau[i] - now[i]);
        let more = solved(double, &factors, &rest);
        truth = std::array::from_fn(|i| truth[i] + more[i]);
    }
    let by_bodies = aba(double, &wide, &wide_tau, &RIGID_BODY).expect("M > 0");
    measured.f64s = largest([measured.f64s, error(&by_bodies, &truth)]);
    let matrix = forward_dynamics(single, &state, &tau, &RIGID_BODY).map(|x| x.map(f64::from));
    let bodies = aba(single, &state, &tau, &RIGID_BODY).map(|x| x.map(f64::from));
    measured.matrix.push(matrix.map_or(f64::INFINITY, |x| error(&x, &truth)));
    measured.bodies.push(bodies.map_or(f64::INFINITY, |x| error(&x, &truth)));
    let most = eigenvalue(|x| m.mul_vec(x));
    let least = eigenvalue(|x| solved(double, &factors, x));
    measured.condition = largest([measured.condition, most * least]);
}

#[inline(never)]
fn inverse<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    state: &State<f64, Q, V>,
) -> [f64; V] {
    rnea(model, state, &RIGID_BODY)
}

#[inline(never)]
fn solved<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    factors: &Ltdl<f64, V>,
    tau: &[f64; V],
) -> [f64; V] {
    solve(model, factors, tau)
}

fn error<const V: usize>(found: &[f64; V], truth: &[f64; V]) -> f64 {
    let size = truth.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
    let off = std::iter::zip(found, truth).map(|(a, b)| (a - b).abs());
    largest(off) / size
}

/// The largest eigenvalue of a positive definite matrix, by power iteration.
fn eigenvalue<const V: usize>(apply: impl Fn(&[f64; V]) -> [f64; V]) -> f64 {
    let mut x: [f64; V] = std::array::from_fn(|i| 1.0 + 0.1 * (i % 7) as f64);
    let mut size = 1.0;
    for _ in 0..STEPS {
        let y = apply(&x);
        size = y.iter().map(|y| y * y).sum::<f64>().sqrt();
        x = y.map(|y| y / size);
    }
    size
}
