//! Springs and dampers that are stiffer than the step is short: closed forms of backward Euler's
//! method.

use super::name;
use dynamics_core::algorithms::rnea;
use dynamics_core::drivetrain::{
    ElasticJoints, ElasticReference, MotorState, elastic_inverse_dynamics, elastic_step,
};
use dynamics_core::effects::{Inertia, RIGID_BODY, Spring, Viscous};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::sim::{linearly_implicit, semi_implicit};
use dynamics_core::state::State;
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[
    Case {
        number: 31,
        name: "spring of 10⁶ N·m/rad at 1 ms",
        parameters: "released 0.1 rad from equilibrium, h ω = 31.6; then a load of 1 N·m",
        source: "stiff contacts and cables in game engines: explicit steps diverge beyond h ω = 2",
        oracle: "backward Euler in closed form: 0.1 Re (1 + i h ω)⁻ⁿ; equilibrium at τ/k",
        reason: "relative to the present amplitude: q̇ + h q̈ cancels to 1/(1 + h²ω²) of q̇: 8 (1 + \
            h²ω²) ε; in equilibrium 4 ε",
        run: spring,
    },
    Case {
        number: 32,
        name: "damping c·h/M = 1.9, 2.1, 150",
        parameters: "2 kg, steps of 1 ms, 10 steps",
        source: "identified damping of gears, thousands of N·m·s/rad, in explicit simulators",
        oracle: "backward Euler in closed form: (1 + c h/M)⁻ⁿ",
        reason: "relative to the present speed: q̇ + h q̈ cancels to 1/(1 + c h/M) of q̇, ten times: \
            10 (1 + c h/M) ε",
        run: damper,
    },
    Case {
        number: 36,
        name: "flexible joint, 10⁵ … 10⁷ N·m/rad",
        parameters: "a motor of 0.5 kg drives a carriage of 2 kg through the joint with 5 N for 1 \
            s in steps of 1 ms; UR5e at rest",
        source: "Spong (1987); harmonic drives: a stiff joint needs short explicit steps",
        oracle: "closed form: the centre of mass moves by a h² n (n + 1)/2, the spring's force is \
            M a",
        reason: "position: the random walk of 1000 sums, 2 √1000 ε. Force: k times the rounding of \
            the two angles, 6e-8 of 1 in f32, for any method that stores angles",
        run: flexible,
    },
];

/// Relative to what is wanted of it.
fn relative(got: f64, want: f64) -> f64 {
    ((got - want) / want).abs()
}

fn model<R: Real>(body: Body) -> ArmModel<R, 1> {
    let model: ArmModel<f64, 1> = Model::new("one", [body]);
    R::cast(&model)
}

fn sledge<R: Real>() -> ArmModel<R, 1> {
    model(Body::new("sledge", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(2.0))
}

const H: f64 = 1e-3;

fn spring() -> Vec<Row> {
    const STIFFNESS: f64 = 1e6;
    const INERTIA: f64 = 1e-3;
    fn run<R: Real>(rows: &mut Vec<Row>, epsilon: f64) {
        let wheel = Body::new("wheel", BASE, Joint::revolute([0.0, 0.0, 1.0]));
        let wheel = model::<R>(wheel.inertia([0.0, 0.0, 0.0, 0.0, 0.0, INERTIA]));
        let spring = Spring { stiffness: [R::from_f64(STIFFNESS)], rest: [R::ZERO] };
        let (mut state, mut worst) = (State::at([R::from_f64(0.1)]), 0.0_f64);
        let (start, step_inv) = (state.q[0].to_f64(), H * (STIFFNESS / INERTIA).sqrt());
        let step = |state: &mut State<R, 1, 1>, tau: f64| {
            linearly_implicit(
                &wheel,
                state,
                &[R::from_f64(tau)],
                &mut (Inertia, spring),
                R::from_f64(H),
            )
            .expect("M is positive definite");
        };
        for n in 1..=8 {
            step(&mut state, 0.0);
            let amplitude = start * (1.0 + step_inv * step_inv).powf(-0.5 * f64::from(n));
            let want = amplitude * (f64::from(n) * step_inv.atan()).cos();
            worst = larger(worst, (state.q[0].to_f64() - want).abs() / amplitude);
        }
        rows.push(Row::stated(
            "let go",
            name::<R>(),
            worst,
            8.0 * (1.0 + step_inv * step_inv) * epsilon,
        ));
        for _ in 0..100 {
            step(&mut state, 1.0);
        }
        let rest = relative(state.q[0].to_f64(), 1.0 / STIFFNESS);
        rows.push(Row::stated("at rest under 1 N·m", name::<R>(), rest, 4.0 * epsilon));
        let mut naive = State::at([R::from_f64(0.1)]);
        for _ in 0..8 {
            let step =
                semi_implicit(&wheel, &mut naive, &[R::ZERO], &(Inertia, spring), R::from_f64(H));
            step.expect("M is positive definite");
        }
        let blown = naive.q[0].to_f64().abs() / start;
        rows.push(Row::naive(
            "an explicit step: let go, in first amplitudes",
            name::<R>(),
            blown,
            1.0,
        ));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, f32::EPSILON.into());
    run::<f64>(&mut rows, f64::EPSILON);
    rows
}

fn damper() -> Vec<Row> {
    fn run<R: Real>(rows: &mut Vec<Row>, x: f64) {
        let (sledge, scene) = (sledge::<R>(), (Inertia, Viscous([R::from_f64(x * 2.0 / H)])));
        let (mut state, mut naive) = (State::at([R::ZERO]), State::at([R::ZERO]));
        (state.qd, naive.qd) = ([R::ONE], [R::ONE]);
        let (mut worst, mut blown) = (0.0_f64, 0.0_f64);
        // The damping that R has.
        let x_r = (scene.1.0[0] * R::from_f64(H)).to_f64() / 2.0;
        for n in 1..=10 {
            let h = R::from_f64(H);
            let step = linearly_implicit(&sledge, &mut state, &[R::ZERO], &mut { scene }, h);
            step.expect("M is positive definite");
            semi_implicit(&sledge, &mut naive, &[R::ZERO], &scene, h)
                .expect("M is positive definite");
            worst = larger(worst, relative(state.qd[0].to_f64(), (1.0 + x_r).powi(-n)));
            // The exact remaining speed is subtracted; a first-order step may miss all of it.
            blown = (naive.qd[0].to_f64() - (-x * f64::from(n)).exp()).abs();
        }
        let bound = 10.0 * (1.0 + x) * R::EPSILON.to_f64();
        rows.push(Row::stated(format!("c·h/M = {x}"), name::<R>(), worst, bound));
        let what = format!("c·h/M = {x}, an explicit step, in first speeds");
        rows.push(Row::naive(what, name::<R>(), blown, 0.1));
    }
    let mut rows = Vec::new();
    for x in [1.9, 2.1, 150.0] {
        run::<f32>(&mut rows, x);
        run::<f64>(&mut rows, x);
    }
    rows
}

/// Masses of sledge and motor, the force of the motor.
const LINK: f64 = 2.0;
const ROTOR: f64 = 0.5;
const FORCE: f64 = 5.0;

fn flexible() -> Vec<Row> {
    let mut rows = Vec::new();
    for k in [1e5, 1e6, 1e7] {
        driven::<f32>(&mut rows, k);
        driven::<f64>(&mut rows, k);
        held(&mut rows, k as f32);
    }
    let mut blown = [0.0, 0.0];
    let (mut place, mut speed) = ([0.0_f64; 2], [0.0_f64; 2]);
    for _ in 0..100 {
        let pull = 1e7 * (place[1] - place[0]);
        speed[0] += H * pull / LINK;
        speed[1] += H * (FORCE - pull) / ROTOR;
        (0..2).for_each(|i| place[i] += H * speed[i]);
        blown = place;
    }
    let gap = (blown[1] - blown[0]).abs() * 1e7 / (LINK * FORCE / (LINK + ROTOR));
    rows.push(Row::naive("k = 1e7, an explicit step: force of the spring", "f64", gap, 2.0));
    rows
}

/// A motor that drives a sledge through the joint.
fn driven<R: Real>(rows: &mut Vec<Row>, k: f64) {
    let of = R::from_f64;
    let joints = ElasticJoints { stiffness: [of(k)], rotor: [of(ROTOR)], friction: [R::ZERO] };
    let (mut link, mut motor) =
        (State::at([R::ZERO]), MotorState { position: [R::ZERO], velocity: [R::ZERO] });
    let (sledge, h) = (sledge::<R>(), of(H));
    for _ in 0..1000 {
        elastic_step(&sledge, &joints, &mut link, &mut motor, &[of(FORCE)], &mut (Inertia,), h)
            .expect("M is positive definite");
    }
    let a = FORCE / (LINK + ROTOR);
    let stretch = LINK * a / k;
    let centre = a * H * H * 1000.0 * 1001.0 / 2.0;
    let place = centre - ROTOR / (LINK + ROTOR) * stretch;
    let (q, theta) = (link.q[0].to_f64(), motor.position[0].to_f64());
    rows.push(Row::stated(
        format!("k = {k:.0e}: place of the link"),
        name::<R>(),
        relative(q, place),
        64.0 * R::EPSILON.to_f64(),
    ));
    let force = relative(theta - q, stretch);
    let theory = 2.0 * R::EPSILON.to_f64() * centre / stretch;
    rows.push(Row::stated(format!("k = {k:.0e}: force of the spring"), name::<R>(), force, theory));
}

/// The motors' commands for an arm at rest in f32: its weight, and angles ahead by weight over
/// stiffness.
fn held(rows: &mut Vec<Row>, k: f32) {
    let joints = ElasticJoints { stiffness: [k; 6], rotor: [0.5; 6], friction: [0.0; 6] };
    let q = [0.3, -1.2, 1.5, 0.3, 0.5, 0.1];
    let rest = ElasticReference { state: State::at(q), jerk: [0.0; 6], snap: [0.0; 6] };
    let motors = elastic_inverse_dynamics(&Ur5e::MODEL_F32, &joints, &rest, &RIGID_BODY)
        .expect("every joint is single");
    let weight = rnea(&Ur5e::MODEL, &State::at(q.map(f64::from)), &RIGID_BODY);
    let most = weight.iter().fold(0.0_f64, |most, tau| most.max(tau.abs()));
    let (mut torque, mut ahead) = (0.0_f64, 0.0_f64);
    for (i, weight) in weight.into_iter().enumerate() {
        torque = larger(torque, (f64::from(motors.torque[i]) - weight).abs() / most);
        let angle = f64::from(motors.position[i]) - f64::from(q[i]);
        ahead = larger(ahead, (angle - weight / f64::from(k)).abs());
    }
    let epsilon = f64::from(f32::EPSILON);
    let what = |what: &str| format!("k = {k:.0e}: UR5e at rest, {what}");
    rows.push(Row::stated(what("torques of its motors"), "f32", torque, 4.0 * epsilon));
    rows.push(Row::stated(what("angles of its motors, rad"), "f32", ahead, epsilon));
}
