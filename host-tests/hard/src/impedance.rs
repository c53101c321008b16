//! A Cartesian impedance whose goal is out of reach.

use dynamics_core::algorithms::{
    Conditioning, Pose, crba, frame, jacobian, jacobian_rows, kinematics, ltdl, rnea, solve,
};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use motion_control::law::{
    CartesianImpedance, ImpedanceConfig, TaskDeviation, TaskFrame, pose_error,
};

pub const CASES: &[Case] = &[Case {
    number: 70,
    name: "impedance, goal out of reach",
    parameters: "UR5e with 150 N/m and 30 N·m/rad, ζ = 0.7 above 2 rad/s; the goal moves 0.7 m out \
        of reach within a second and returns after five, then stays for five; ticks of 1 ms",
    source: "Chiaverini (1997); a spring with its goal out of reach has a singular posture as its \
        equilibrium",
    oracle: "the limits of the drives, rest in the singular posture, the goal after the return",
    reason: "the spring's torque stays below 150 N/m · 0.7 m · 0.9 m, with gravity within the \
        drives' limits; a passive law gets no energy, so that the arm comes to rest; its slowest \
        damping leaves the error after five seconds",
    run,
}];

const STIFFNESS: [f64; 6] = [30.0, 30.0, 30.0, 150.0, 150.0, 150.0];
const START: [f64; 6] = [0.2, -0.9, 1.3, -0.4, 0.7, 0.1];
const TICK: f64 = 1e-3;
const AWAY: f64 = 0.7;
/// Torque limits of the drives, N·m.
const LIMITS: [f64; 6] = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];

struct Outcome {
    /// The largest torque of a drive over its limit.
    torque: f64,
    /// The largest change of a torque from tick to tick, N·m.
    step: f64,
    /// The angle of the elbow from straight at its smallest, rad.
    elbow: f64,
    /// The largest speed of a joint after five seconds out of reach, rad/s.
    speed: f64,
    /// The distance from the goal five seconds after its return, m.
    off: f64,
    /// Whether the status named the singularity when the elbow was straight, and only near it.
    named: bool,
}

impl Outcome {
    const BROKEN: Self = Self {
        torque: f64::INFINITY,
        step: f64::INFINITY,
        elbow: f64::INFINITY,
        speed: f64::INFINITY,
        off: f64::INFINITY,
        named: false,
    };
}

/// The distance of the goal from the start, as a share of `AWAY`, at a time in s.
fn away(t: f64) -> f64 {
    let ramp = |t: f64| {
        let t = t.clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    ramp(t) - ramp(t - 6.0)
}

/// Twelve seconds, with the slowest fully damped mode in rad/s.
fn simulate<R: Real>(arm: &ArmModel<R, 6>, slowest: f64) -> Option<Outcome> {
    let real = R::from_f64;
    let config =
        ImpedanceConfig { stiffness: STIFFNESS.map(real), zeta: real(0.7), slowest: real(slowest) };
    let mut impedance = CartesianImpedance::try_new(config).ok()?;
    let rotors = Armature([real(0.3); 6]);
    let directions = TaskFrame::<R>::BASE.turn_and_place(R::ONE);
    let mut state = State::at(START.map(real));
    let start: Pose<R> = kinematics(arm, &state, &()).poses[5];
    let [x, y, z] = start.pos.array().map(R::to_f64);
    let reach = (x * x + y * y + z * z).sqrt();
    let outward = start.pos * real(AWAY / reach);
    let (mut last, mut out) =
        (None, Outcome { torque: 0.0, step: 0.0, elbow: 9.0, named: true, ..Outcome::BROKEN });
    for k in 0..12_000 {
        let mut goal = start;
        goal.pos += outward * real(away(f64::from(k) * TICK));
        let tip = kinematics(arm, &state, &());
        let (off, v) =
            (pose_error(&tip.poses[5], &goal), tip.velocity(5, frame::LocalWorldAligned));
        let deviation = TaskDeviation {
            position: directions.map(|d| off.dot(d)),
            velocity: directions.map(|d| -v.dot(d)),
        };
        let rows = jacobian_rows(&jacobian(arm, &state.q, 5, frame::LocalWorldAligned));
        let factors = ltdl(arm, &crba(arm, &state.q, &(Inertia, rotors))).ok()?;
        let solve = |tau: &_| solve(arm, &factors, tau);
        let bias = rnea(arm, &State::at(state.q), &Gravity::EARTH);
        let posture = state.qd.map(|qd| -(real(6.0) * qd));
        let command = impedance.torque(&rows, solve, &deviation, &bias, &posture).ok()?;
        let (tau, elbow) = (command.tau.map(R::to_f64), state.q[2].to_f64().abs());
        for (tau, limit) in tau.iter().zip(LIMITS) {
            out.torque = larger(out.torque, tau.abs() / limit);
        }
        if let Some(last) = last.replace(tau) {
            for (tau, last) in tau.iter().zip::<[f64; 6]>(last) {
                out.step = larger(out.step, (tau - last).abs());
            }
        }
        let regular = command.conditioning == Conditioning::Regular;
        out.named &= if elbow < 0.02 { !regular } else { regular | (elbow < 1.0) };
        out.elbow = out.elbow.min(elbow);
        let speed = state.qd.map(|qd| qd.to_f64().abs());
        if k == 5_999 {
            out.speed = speed.into_iter().fold(0.0, larger);
        }
        let [.., x, y, z] = deviation.position.map(R::to_f64);
        out.off = (x * x + y * y + z * z).sqrt();
        let plant = ((Gravity::EARTH, Inertia, Coriolis), rotors);
        semi_implicit(arm, &mut state, &command.tau, &plant, real(TICK)).ok()?;
    }
    Some(out)
}

fn run() -> Vec<Row> {
    let (double, mut rows) = (Ur5e::MODEL, Vec::new());
    let single = double.to_f32();
    let outcomes = [("f32", simulate(&single, 2.0)), ("f64", simulate(&double, 2.0))];
    for (scalar, outcome) in outcomes {
        let out = outcome.unwrap_or(Outcome::BROKEN);
        rows.extend([
            Row::stated("largest torque, of the drive's limit", scalar, out.torque, 1.0),
            Row::measured("largest change of a torque in a tick, N·m", scalar, out.step, STEP),
            Row::stated("angle of the elbow from straight, rad", scalar, out.elbow, 0.02),
            Row::claim("the status names the singularity", scalar, out.named),
            Row::stated("speed out of reach, rad/s", scalar, out.speed, 1e-3),
            Row::measured("distance from the goal after its return, m", scalar, out.off, OFF),
        ]);
    }
    let naive = simulate(&single, 1e-3).unwrap_or(Outcome::BROKEN);
    rows.push(Row::naive(
        "naive: neither modes nor null space damped at the singularity, change of a torque",
        "f32",
        naive.step,
        STEP,
    ));
    rows
}

const STEP: f64 = 0.5;
const OFF: f64 = 1e-3;
