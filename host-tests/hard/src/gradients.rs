//! Derivatives of inverse dynamics where differences lose their digits.

use dynamics_core::algorithms::{TorqueGradient, rnea, rnea_derivatives};
use dynamics_core::effects::{Coulomb, Effect, RIGID_BODY, Width};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::robots::{A1Free, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::integrate;
use host_tests::dual::{Dual, gradient};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use host_tests::random::{random_numbers, within};

use super::setup::list::{Stance, arm, chain};
use super::setup::{Setup, same_in_f64, widened};

const SOURCE: &str = "linearised control and identification take such derivatives by differences";
const ORACLE: &str = "the torques of the same f32 numbers in dual numbers of f64, without a step";
const REASON: &str = "sums and products of the terms of the torque itself: the error is that of \
    rounding, relative to the row's largest entry; a difference loses half of its digits";

const fn case(
    number: u32,
    name: &'static str,
    parameters: &'static str,
    run: fn() -> Vec<Row>,
) -> Case {
    Case { number, name, parameters, source: SOURCE, oracle: ORACLE, reason: REASON, run }
}

pub const CASES: &[Case] = &[
    case(95, "∂ID of a free base", "A1 on its free trunk, turned by a third of a turn", free_base),
    case(96, "∂ID at coincident axes", "UR5e of case 20", || {
        of_arm(20, "coincident axes", COINCIDENT)
    }),
    case(
        97,
        "∂ID near gimbal of a universal joint",
        "x, y by a universal joint, then z, at y = π/2 − 2⁻³ … 2⁻¹⁷ rad",
        gimbal,
    ),
    case(98, "∂ID at a tip × 10⁶", "UR5e of case 1", || of_arm(1, "tip × 10⁶", HEAVY_TIP)),
    case(99, "∂ID at a base link × 10⁶", "UR5e of case 3", || {
        of_arm(3, "base link × 10⁶", HEAVY_BASE)
    }),
    case(100, "∂ID at 1000 rad/s", "UR5e of case 15", || of_arm(15, "1000 rad/s", FAST)),
    case(101, "∂ID 10⁴ m from the origin", "UR5e of case 13", || {
        of_arm(13, "base 10⁴ m away", FAR)
    }),
    case(102, "∂ID with massless links", "UR5e of case 4", || {
        of_arm(4, "massless wrist links", MASSLESS)
    }),
    case(103, "∂ID of a chain of 32 rods", "those of case 9, anyhow", long_chain),
    case(
        104,
        "∂ID of friction at rest",
        "UR5e, Coulomb friction that fades within 10⁻⁵ rad/s",
        friction,
    ),
];

/// Bounds of ∂ID/∂q and ∂ID/∂q̇ in f32, then in f64.
type Bounds = [f64; 4];

/// A robot in f32 and the same numbers in f64, and its states.
struct Problem<'a, const B: usize, const Q: usize, const V: usize> {
    single: &'a Model<f32, B, Q, V>,
    double: &'a Model<f64, B, Q, V>,
    states: &'a [State<f32, Q, V>],
}

/// The errors of both matrices in both scalars, under these effects in f32, f64 and dual numbers,
/// and of differences.
fn rows<const B: usize, const Q: usize, const V: usize>(
    problem: &Problem<'_, B, Q, V>,
    bounds: Bounds,
    (single, double, exact): (
        &impl Effect<f32, B, V>,
        &impl Effect<f64, B, V>,
        &impl Effect<Dual, B, V>,
    ),
) -> Vec<Row> {
    let dual = Dual::cast(problem.double);
    let [mut truth, mut in_f32, mut in_f64, mut naive] = [const { Vec::new() }; 4];
    for state in problem.states {
        let wide = widened(state);
        truth.push(gradient(problem.double, &wide, |state| rnea(&dual, state, exact)));
        in_f32.push(in_double(&rnea_derivatives(problem.single, state, single)));
        in_f64.push(in_double(&rnea_derivatives(problem.double, &wide, double)));
        naive.push(differences(problem.single, state, single));
    }
    let errors = [in_f32, in_f64, naive].map(|found| errors(&found, &truth));
    let mut rows = Vec::new();
    for (k, name) in ["∂ID/∂q", "∂ID/∂q̇"].into_iter().enumerate() {
        rows.push(Row::measured(name, "f32", errors[0][k], bounds[k]));
        rows.push(Row::measured(name, "f64", errors[1][k], bounds[2 + k]));
    }
    let error = larger(errors[2][0], errors[2][1]);
    rows.push(Row::naive("naive: by central differences", "f32", error, bounds[0]));
    rows
}

type Both<const V: usize> = [[[f64; V]; V]; 2];

fn in_double<R: Real, const V: usize>(found: &TorqueGradient<R, V>) -> Both<V> {
    [found.dq, found.dqd].map(|rows| rows.map(|row| row.map(R::to_f64)))
}

/// By differences of torques at ±2⁻⁸: about ∛ε, of the steps the best.
fn differences<const B: usize, const Q: usize, const V: usize>(
    robot: &Model<f32, B, Q, V>,
    state: &State<f32, Q, V>,
    scene: &impl Effect<f32, B, V>,
) -> Both<V> {
    const H: f32 = 1.0 / 256.0;
    let mut by = [[[0.0; V]; V]; 2];
    for k in 0..V {
        let at = |[by_q, by_qd]: [f32; 2]| {
            let step = |h| std::array::from_fn(|j| if j == k { h } else { 0.0 });
            let (q, more) = (integrate(robot, &state.q, &step(by_q)), step(by_qd));
            let qd = std::array::from_fn(|j| state.qd[j] + more[j]);
            rnea(robot, &State { q, qd, ..*state }, scene)
        };
        let ends = [[at([H, 0.0]), at([-H, 0.0])], [at([0.0, H]), at([0.0, -H])]];
        for (by, [ahead, behind]) in by.iter_mut().zip(ends) {
            for (i, (ahead, behind)) in ahead.into_iter().zip(behind).enumerate() {
                by[i][k] = f64::from((ahead - behind) / (2.0 * H));
            }
        }
    }
    by
}

/// The largest error of each matrix, relative to the largest entry of its row over the states.
fn errors<const V: usize>(found: &[Both<V>], truth: &[Both<V>]) -> [f64; 2] {
    std::array::from_fn(|which| {
        let scale: [f64; V] = std::array::from_fn(|i| {
            let entries = truth.iter().flat_map(|both| both[which][i]);
            entries.fold(0.0, |scale, x| f64::max(scale, x.abs()))
        });
        let most = scale.iter().fold(0.0, |a, &b| f64::max(a, b));
        let mut worst = 0.0;
        for (found, truth) in found.iter().zip(truth) {
            for i in 0..V {
                // A torque that depends on nothing, to a rounding.
                let scale = if scale[i] < 1e-9 * most { most } else { scale[i] };
                for (found, truth) in found[which][i].iter().zip(truth[which][i]) {
                    worst = larger(worst, (found - truth).abs() / scale);
                }
            }
        }
        worst
    })
}

fn of_setup<const N: usize>(setup: &Setup<N>, bounds: Bounds) -> Vec<Row> {
    let problem = Problem { single: &setup.single, double: &setup.double, states: &setup.states };
    rows(&problem, bounds, (&RIGID_BODY, &RIGID_BODY, &RIGID_BODY))
}

fn of_arm(case: u32, name: &str, bounds: Bounds) -> Vec<Row> {
    of_setup(&arm(case, name), bounds)
}

/// Random states of a robot of one coordinate a position, q̇ within a bound.
fn random_states<const N: usize>(speed: f64) -> [State<f32, N, N>; 4] {
    let mut random = random_numbers();
    [(); 4].map(|()| {
        let [q, qd, qdd] =
            [3.0, speed, 10.0].map(|bound| within::<N>(&mut random, bound).map(|x| x as f32));
        State { q, qd, qdd }
    })
}

fn free_base() -> Vec<Row> {
    let single = A1Free::MODEL.to_f32();
    let double = same_in_f64(&A1Free::MODEL, &single);
    let states = random_states::<19>(3.0).map(|State { mut q, qd, qdd }| {
        q[..4].copy_from_slice(&[0.5, -0.5, 0.5, 0.5]);
        let [qd, qdd] = [qd, qdd].map(|x| std::array::from_fn(|i| x[i]));
        State { q, qd, qdd }
    });
    let problem = Problem { single: &single, double: &double, states: &states };
    rows(&problem, FREE, (&RIGID_BODY, &RIGID_BODY, &RIGID_BODY))
}

fn gimbal() -> Vec<Row> {
    let link = |parent, joint| {
        Body::new("link", parent, joint)
            .xyz([0.0, 0.0, 0.25])
            .mass(1.0)
            .com([0.05, -0.03, 0.125])
            .inertia([0.02, 0.001, -0.002, 0.018, 0.0015, 0.012])
    };
    let described = Model::<f64, 2, 3, 3>::new(
        "wrist",
        [
            link(BASE, Joint::universal([1.0, 0.0, 0.0], [0.0, 1.0, 0.0])),
            link(0, Joint::revolute([0.0, 0.0, 1.0])),
        ],
    );
    let single = described.to_f32();
    let double = same_in_f64(&described, &single);
    let mut states = random_states::<3>(3.0);
    for (state, k) in states.iter_mut().zip([3, 6, 10, 17]) {
        state.q[1] = std::f32::consts::FRAC_PI_2 - (-k as f32).exp2();
    }
    let problem = Problem { single: &single, double: &double, states: &states };
    rows(&problem, GIMBAL, (&RIGID_BODY, &RIGID_BODY, &RIGID_BODY))
}

fn long_chain() -> Vec<Row> {
    of_setup(&chain::<32>(9, Stance::Random), CHAIN)
}

fn friction() -> Vec<Row> {
    fn dry<R: Real>() -> Coulomb<R, 6> {
        Coulomb { torque: [R::from_f64(4.0); 6], width: Width::new(R::from_f64(1e-5)) }
    }
    let single = Ur5e::MODEL.to_f32();
    let double: ArmModel<f64, 6> = same_in_f64(&Ur5e::MODEL, &single);
    let states = random_states::<6>(1e-5);
    let problem = Problem { single: &single, double: &double, states: &states };
    rows(&problem, DRY, (&(RIGID_BODY, dry()), &(RIGID_BODY, dry()), &(RIGID_BODY, dry())))
}

const FREE: Bounds = [2e-6, 8e-7, 6e-15, 2e-15];
const COINCIDENT: Bounds = [5e-7, 6e-7, 1.2e-15, 1.2e-15];
const GIMBAL: Bounds = [3e-7, 4e-7, 4e-16, 2e-15];
const HEAVY_TIP: Bounds = [7e-7, 5e-7, 1.4e-15, 8e-16];
const HEAVY_BASE: Bounds = [4e-7, 4e-7, 1.3e-15, 6e-16];
const FAST: Bounds = [6e-7, 4e-7, 1e-15, 7e-16];
const FAR: Bounds = [4e-7, 4e-7, 1.3e-15, 6e-16];
const MASSLESS: Bounds = [6e-7, 3e-7, 8e-16, 8e-16];
const CHAIN: Bounds = [3e-6, 1.6e-6, 3e-15, 3e-15];
const DRY: Bounds = [4e-7, 2e-7, 9e-16, 5e-16];
