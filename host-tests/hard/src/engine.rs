//! The specialised form on the hard arms: the same as the core, which the oracle knows.

use super::name;
use super::setup::widened;
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use fixtures::hard::{DOUBLE, N, SINGLE, scene, state};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[Case {
    number: 47,
    name: "engine = core",
    parameters: "the arms of cases 1 to 6, 11, 13, 15 to 17, 20 to 22, 42, 44 to 46, 48 in all \
        their states; f32, and f64 on six arms; forward dynamics on four",
    source: "a code generator that folds and regroups the textbook's operations",
    oracle: "the core, which the cases compare with 50 digits",
    reason: "inverse dynamics: both forms round equally often, 8 ε of a joint's largest torque; 64 \
        ε for the tiny arm, whose weight is 50 times its force of acceleration and cancels on the \
        vertical axis. Forward dynamics: κ ε, measured",
    run: engine,
}];

/// The arm of a problem, known to the compiler.
struct Hard<const K: usize>;

impl<const K: usize> Robot<N, N, N> for Hard<K> {
    const MODEL: ArmModel<f64, N> = DOUBLE[K].arm;
}

/// The states of a problem in R.
fn states<R: Real>(problem: usize) -> impl Iterator<Item = State<R, N, N>> {
    let cast = |values: [f64; N]| values.map(R::from_f64);
    SINGLE[problem].states.iter().map(move |numbers| {
        let wide = widened(&state(numbers));
        State { q: cast(wide.q), qd: cast(wide.qd), qdd: cast(wide.qdd) }
    })
}

/// The largest difference of a joint's values, relative to that joint's largest.
fn differ<R: Real>(pairs: &[([R; N], [R; N])]) -> f64 {
    let mut worst = 0.0;
    for joint in 0..N {
        let scale = pairs.iter().map(|(core, _)| core[joint].to_f64().abs()).fold(0.0, f64::max);
        for (core, engine) in pairs {
            let off = (core[joint].to_f64() - engine[joint].to_f64()).abs();
            worst = larger(worst, if off == 0.0 { 0.0 } else { off / scale });
        }
    }
    worst
}

/// Inverse dynamics of problems on the arm of problem K.
fn inverse<R: Real, const K: usize>(rows: &mut Vec<Row>, bound: f64, problems: &[usize]) {
    for &problem in problems {
        let scene = scene::<R, N>(&SINGLE[problem].extras);
        let both = |state| {
            (Core::<Hard<K>>::rnea(&state, &scene), Engine::<Hard<K>>::rnea(&state, &scene))
        };
        let worst = differ(&states::<R>(problem).map(both).collect::<Vec<_>>());
        let bound = bound * R::EPSILON.to_f64();
        rows.push(Row::stated(what("rnea", problem), name::<R>(), worst, bound));
    }
}

/// Forward dynamics in f32: of the same joint an error, or accelerations that differ by no more
/// than `bound`.
fn forward<const K: usize>(rows: &mut Vec<Row>, problems: &[(usize, f64)]) {
    for &(problem, bound) in problems {
        let (scene, mut pairs) = (scene::<f32, N>(&SINGLE[problem].extras), Vec::new());
        let mut refused = (true, false);
        for state in states::<f32>(problem) {
            let tau = Core::<Hard<K>>::rnea(&state, &scene);
            let core = Core::<Hard<K>>::forward_dynamics(&state, &tau, &scene);
            let engine = Engine::<Hard<K>>::forward_dynamics(&state, &tau, &scene);
            refused = (refused.0 && core == engine, refused.1 || engine.is_err());
            pairs.extend(core.ok().zip(engine.ok()));
        }
        let row = match refused {
            (same, true) => {
                Row::claim(what("forward: the same joint is refused", problem), "f32", same)
            }
            _ => Row::measured(what("forward", problem), "f32", differ(&pairs), bound),
        };
        rows.push(row);
    }
}

fn what(what: &str, problem: usize) -> String {
    format!("{what}, case {}, {}", SINGLE[problem].case, SINGLE[problem].name)
}

fn engine() -> Vec<Row> {
    let mut rows = Vec::new();
    inverse::<f32, 0>(&mut rows, 8.0, &[0]);
    inverse::<f64, 0>(&mut rows, 8.0, &[0]);
    inverse::<f32, 1>(&mut rows, 8.0, &[1]);
    inverse::<f64, 1>(&mut rows, 8.0, &[1]);
    inverse::<f32, 2>(&mut rows, 8.0, &[2]);
    inverse::<f32, 3>(&mut rows, 8.0, &[3]);
    inverse::<f32, 4>(&mut rows, 8.0, &[4, 5, 6, 7, 8]);
    inverse::<f64, 4>(&mut rows, 8.0, &[4, 5, 6, 7, 8]);
    inverse::<f32, 9>(&mut rows, 8.0, &[9, 15]);
    inverse::<f32, 10>(&mut rows, 8.0, &[10]);
    inverse::<f32, 11>(&mut rows, 8.0, &[11, 12, 13, 23, 24, 25, 26]);
    inverse::<f64, 11>(&mut rows, 8.0, &[11, 12, 13, 23, 24, 25, 26]);
    inverse::<f32, 14>(&mut rows, 8.0, &[14]);
    inverse::<f32, 16>(&mut rows, 8.0, &[16]);
    inverse::<f32, 17>(&mut rows, 8.0, &[17]);
    inverse::<f32, 18>(&mut rows, 64.0, &[18]);
    inverse::<f64, 18>(&mut rows, 64.0, &[18]);
    inverse::<f32, 19>(&mut rows, 8.0, &[19]);
    inverse::<f32, 20>(&mut rows, 8.0, &[20]);
    inverse::<f32, 21>(&mut rows, 8.0, &[21]);
    inverse::<f32, 22>(&mut rows, 8.0, &[22]);
    inverse::<f32, 27>(&mut rows, 8.0, &[27]);
    inverse::<f64, 27>(&mut rows, 8.0, &[27]);
    forward::<0>(&mut rows, &[(0, 2e-3)]);
    forward::<4>(&mut rows, &[(4, 0.0), (5, 1e-5), (8, 1e-5)]);
    forward::<11>(&mut rows, &[(13, 5e-6), (26, 1e-4)]);
    forward::<14>(&mut rows, &[(14, 0.0)]);
    rows
}
