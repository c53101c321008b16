//! Attitudes that turn for long: a quaternion after ten million steps, the Dzhanibekov body.

use super::integrators::{INTEGRATORS, Integrator};
use super::name;
use dynamics_core::algorithms::{kinetic_energy, momentum};
use dynamics_core::effects::{Coriolis, Inertia};
use dynamics_core::model::{BASE, Body, Joint, Model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::state::State;
use dynamics_core::state::manifold::{integrate, neutral};
use glam::{DQuat, DVec3};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[
    Case {
        number: 25,
        name: "quaternion after 1e7 steps",
        parameters: "10⁷ steps of 7/2¹³ rad about (2, 3, 6)/7, only by `integrate`",
        source: "floating bases over hours; quaternions that are rarely normalised",
        oracle: "closed form: the angle 10⁷·7/2¹³ is exact in f64",
        reason: "length: the rounding error of one step, which corrects the length of the step \
            before. Attitude: each step rounds alike, so that up to ε/2 of 8545 rad accumulate \
            (5e-4 in f32, 9e-13 in f64); the random walk of 10⁷ sums is as large",
        run: quaternion,
    },
    Case {
        number: 26,
        name: "Dzhanibekov body (1, 2, 3)",
        parameters: "moments 1, 2, 3 kg·m², 5 rad/s about the middle axis and 0.01 about another, \
            60 s of 1 ms",
        source: "Poinsot (1834); Ashbaugh, Chicone & Cushman (1991); energy drift flips it too \
            early",
        oracle: "conserved energy and momentum in the inertial frame; the order of each \
            integrator, with half the step",
        reason: "first order: the energy grows by h²/2 ω̇·Iω̇ per step, momentum in proportion to h; \
            at the mean velocity of the step, the energy in proportion to h². Fourth order: \
            measured in f64; rounding in f32, 6e4 steps of less than ε/2",
        run: dzhanibekov,
    },
];

/// A body about its centre.
pub fn ball(mass: f64, com: f64, moments: [f64; 3]) -> Model<f64, 1, 4, 3> {
    let [xx, yy, zz] = moments;
    let body = Body::new("body", BASE, Joint::spherical()).mass(mass);
    Model::new("ball", [body.com([0.0, 0.0, com]).inertia([xx, 0.0, 0.0, yy, 0.0, zz])])
}

fn quaternion() -> Vec<Row> {
    turned(10_000_000)
}

/// The quaternion after a twentieth of the case's steps.
pub fn half_a_million_steps() -> Vec<Row> {
    turned(500_000)
}

fn turned(steps: u32) -> Vec<Row> {
    const STEP: [f64; 3] = [2.0 / 8192.0, 3.0 / 8192.0, 6.0 / 8192.0];
    fn run<R: Real>(steps: u32, rows: &mut Vec<Row>, bounds: [f64; 2]) {
        let model = ball(1.0, 0.0, [1.0; 3]);
        let model = R::cast(&model);
        let (mut q, step) = (neutral(&model), STEP.map(R::from_f64));
        let mut longest = 0.0_f64;
        for i in 0..steps {
            q = integrate(&model, &q, &step);
            if i % 1000 == 0 {
                longest = larger(longest, (length(&q) - 1.0).abs());
            }
        }
        rows.push(Row::stated("length of the quaternion", name::<R>(), longest, bounds[0]));
        rows.push(Row::measured("attitude, rad", name::<R>(), off(steps, &q), bounds[1]));
    }
    /// From the turn that it should be.
    fn off<R: Real>(steps: u32, q: &[R; 4]) -> f64 {
        let axis = DVec3::new(2.0, 3.0, 6.0) / 7.0;
        let half = f64::from(steps) * 7.0 / 16_384.0;
        let want = DQuat::from_xyzw(
            axis.x * half.sin(),
            axis.y * half.sin(),
            axis.z * half.sin(),
            half.cos(),
        );
        let got = DQuat::from_array(q.map(R::to_f64)).normalize();
        2.0 * (want.conjugate() * got).xyz().length()
    }
    fn length<R: Real>(q: &[R; 4]) -> f64 {
        DQuat::from_array(q.map(R::to_f64)).length()
    }
    /// q += ½ q ω h, never normalised.
    fn naive(steps: u32) -> [f32; 4] {
        let [x, y, z] = STEP.map(|x| 0.5 * x as f32);
        let mut q = [0.0_f32, 0.0, 0.0, 1.0];
        for _ in 0..steps {
            let [a, b, c, w] = q;
            q[0] += w * x + b * z - c * y;
            q[1] += w * y + c * x - a * z;
            q[2] += w * z + a * y - b * x;
            q[3] -= a * x + b * y + c * z;
        }
        q
    }
    let mut rows = Vec::new();
    let attitude = f64::from(steps) / 1e7;
    run::<f32>(steps, &mut rows, [2.0 * f64::from(f32::EPSILON), 4e-3 * attitude]);
    run::<f64>(steps, &mut rows, [2.0 * f64::EPSILON, 9e-13 * attitude]);
    let drifted = naive(steps);
    rows.push(Row::naive(
        "length when q̇ = ½ q ω is added up",
        "f32",
        (length(&drifted) - 1.0).abs(),
        1e-7,
    ));
    rows
}

/// The effect of 60 s of free motion: errors of energy and momentum relative to themselves, the sum
/// that a first-order step adds to the energy by theory, and how often the middle axis turned over.
struct Spun {
    energy: f64,
    momentum: f64,
    theory: f64,
    flips: u32,
}

fn spin<R: Real>(how: &Integrator, h: f64, seconds: f64) -> Spun {
    const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];
    let model = ball(1.0, 0.0, MOMENTS);
    let model = R::cast(&model);
    let mut state = State::at(neutral(&model));
    state.qd = [0.01, 5.0, 0.0].map(R::from_f64);
    let energy = |s: &State<R, 4, 3>| kinetic_energy(&model, s, &()).to_f64();
    let turning = |s: &State<R, 4, 3>| momentum(&model, s, &()).ang.array().map(R::to_f64);
    let (e_0, l_0) = (energy(&state), DVec3::from(turning(&state)));
    let (mut out, mut sign) = (Spun { energy: 0.0, momentum: 0.0, theory: 0.0, flips: 0 }, 1.0);
    for _ in 0..(seconds / h).round() as u32 {
        how.step(&model, &mut state, &[R::ZERO; 3], &mut (Inertia, Coriolis), R::from_f64(h));
        let accelerated = MOMENTS.iter().zip(state.qdd);
        out.theory +=
            accelerated.map(|(i, a)| 0.5 * h * h * i * a.to_f64() * a.to_f64()).sum::<f64>() / e_0;
        out.energy = larger(out.energy, (energy(&state) - e_0).abs() / e_0);
        let l = DVec3::from(turning(&state));
        out.momentum = larger(out.momentum, (l - l_0).length() / l_0.length());
        let now = state.qd[1].to_f64();
        if now * sign < -1.0 {
            (sign, out.flips) = (-sign, out.flips + 1);
        }
    }
    out
}

fn dzhanibekov() -> Vec<Row> {
    spun_by(INTEGRATORS.len())
}

/// The Dzhanibekov body by the first of the integrators alone.
pub fn one_integrator() -> Vec<Row> {
    spun_by(1)
}

/// The case by the first `n` integrators.
fn spun_by(n: usize) -> Vec<Row> {
    let mut rows = Vec::new();
    // Energy and momentum in f32 and in f64.
    let first = [1.5e-1, 1e-1, 1.5e-1, 1e-1];
    let mean_velocity = [1e-4, 6e-3, 2e-5, 6e-3];
    for (how, bounds) in
        INTEGRATORS.iter().zip([first, mean_velocity, [1e-4, 5e-5, 1e-12, 1e-10]]).take(n)
    {
        let (single, double) = (spin::<f32>(how, 1e-3, 60.0), spin::<f64>(how, 1e-3, 60.0));
        let half = spin::<f64>(how, 5e-4, 60.0);
        let what = |what: &str| format!("{}: {what}", how.name);
        for (scalar, spun, at, sum) in [("f32", &single, 0, 1e-3), ("f64", &double, 2, 1e-12)] {
            rows.push(Row::measured(what("energy"), scalar, spun.energy, bounds[at]));
            rows.push(Row::measured(
                what("momentum in space"),
                scalar,
                spun.momentum,
                bounds[at + 1],
            ));
            rows.push(Row::claim(what("it turns over"), scalar, spun.flips >= 4));
            if how.energy_order == 1 {
                let off = (spun.energy / spun.theory - 1.0).abs();
                rows.push(Row::measured(
                    what("its gain of energy, against h²/2 Σ ω̇·Iω̇"),
                    scalar,
                    off,
                    sum,
                ));
            }
        }
        let order = (double.energy / half.energy).log2();
        let off = (order - f64::from(how.energy_order)).abs();
        rows.push(Row::stated(
            what("order of its energy, seen by halving the step"),
            "f64",
            off,
            0.2,
        ));
    }
    rows
}
