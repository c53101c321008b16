//! Simulations: how far each way drifts off in energy and from the true motion, for every length of step.
//!
//! The true motion is Runge and Kutta's in f64 with the oracle's step, on the core; the double pendulum's is besides
//! held against Lagrange's equations written out by hand. Trajectory errors are over the first second, since both
//! robots are chaotic; energy is watched for longer. Where friction takes energy, it is held against the true motion's.

use dynamics_core::Core;
use dynamics_core::effects::{Effect, RIGID_BODY};
use dynamics_core::model::Static;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::{Integrator, KahanState, ModelDynamics, RungeKutta};
use dynamics_core::state::State;
use firmware_demo::accuracy::simulation::{
    Damped, DoublePendulum, LetGo, Scene, Simulation, Visitor, every,
};
use serde_json::{Value, json};

use super::statistics::Errors;

/// µs; each divides [`SAMPLE`].
const STEPS: [u32; 9] = [20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000];
/// µs from one comparison to the next.
const SAMPLE: u32 = 20_000;
/// The oracle's step, µs.
const FINE: u32 = 20;
/// Samples of a second, in which motions are compared.
const SECOND: usize = (1_000_000 / SAMPLE) as usize;
/// Seconds in which energy is watched.
const WATCHED: usize = 5;

/// The true motions of a robot.
struct Bench<const N: usize> {
    robot: &'static str,
    /// q after each sample of the first second, free and damped.
    truth: [Vec<[[f64; N]; 2]>; 2],
    /// Energies of these.
    energy: [Vec<f64>; 2],
    energies: fn([[f64; N]; 2]) -> [f64; 2],
    /// Largest kinetic energy of the free motion, J, and angle of both, rad.
    scales: [f64; 2],
}

/// Prints a line for each way and step.
pub fn print() {
    robot::<DoublePendulum, 2>();
    robot::<Ur5e, 6>();
    let pendulum = oracle::<DoublePendulum, _, 2>(&RIGID_BODY, FINE);
    let by_hand = lagrange();
    let apart = Errors::of(pendulum.iter().zip(&by_hand).map(|(a, b)| (a[0], b[0])));
    println!(
        "{}",
        json!({"robot": "double_pendulum", "kind": "oracle", "simulation_against_lagrange": apart.summary(1.0)})
    );
}

fn robot<T: LetGo<N>, const N: usize>() {
    let damped = <Damped as Scene<T, f64, N>>::effects();
    let truth = [
        oracle::<T, _, N>(&RIGID_BODY, FINE),
        oracle::<T, _, N>(&damped, FINE),
    ];
    let coarser = oracle::<T, _, N>(&RIGID_BODY, 2 * FINE);
    let apart = Errors::of(truth[0].iter().zip(&coarser).map(|(a, b)| (a[0], b[0])));
    let energies = |[q, qd]: [[f64; N]; 2]| {
        let state = State {
            q,
            qd,
            qdd: [0.0; N],
        };
        [
            Core::<T>::kinetic_energy(&state, &RIGID_BODY),
            Core::<T>::potential_energy(&q, &RIGID_BODY),
        ]
    };
    let kinetic = truth[0].iter().map(|&at| energies(at)[0]);
    let angles = truth.iter().flatten().flat_map(|at| at[0]);
    let bench = &mut Bench {
        robot: T::MODEL.name,
        energy: truth
            .each_ref()
            .map(|motion| motion.iter().map(|&at| energies(at).iter().sum()).collect()),
        energies,
        scales: [
            kinetic.fold(0.0, f64::max),
            angles.fold(0.0, |most, q| most.max(q.abs())),
        ],
        truth,
    };
    println!(
        "{}",
        json!({
            "robot": T::MODEL.name,
            "kind": "oracle",
            "simulation_against_twice_its_step": apart.summary(bench.scales[1]),
        })
    );
    every::<T, N>(bench);
}

impl<const N: usize> Visitor<N> for Bench<N> {
    fn simulation<S: Simulation<N>>(&mut self) {
        let damped = usize::from(S::KEY.scene == "damped");
        for step in STEPS {
            let mut run = S::start();
            let total = |at| (self.energies)(at).iter().sum::<f64>();
            let start = total(run.seen());
            let (mut errors, mut drift) = (Errors::<N>::new(), Errors::<1>::new());
            let samples = if damped == 0 {
                WATCHED * SECOND
            } else {
                SECOND
            };
            let mut failed = false;
            for sample in 0..samples {
                for _ in 0..SAMPLE / step {
                    failed |= run.step(f64::from(step) * 1e-6).is_err();
                }
                let seen = run.seen();
                if let Some(truth) = self.truth[damped].get(sample) {
                    errors.add(&seen[0], &truth[0]);
                }
                let want = if damped == 0 {
                    start
                } else {
                    self.energy[1][sample]
                };
                drift.add(&[total(seen)], &[want]);
            }
            self.print(
                &S::KEY.to_string(),
                &S::KEY.axes(),
                step,
                failed,
                &errors,
                &drift,
            );
        }
    }
}

impl<const N: usize> Bench<N> {
    fn print(
        &self,
        key: &str,
        axes: &[(&'static str, &'static str)],
        step: u32,
        failed: bool,
        errors: &Errors<N>,
        drift: &Errors<1>,
    ) {
        let [kinetic, angle] = self.scales;
        let (errors, drift) = (errors.summary(angle), drift.summary(kinetic));
        let seconds = drift.answers as f64 / SECOND as f64;
        // What has left the robot's range has no error worth a number.
        let diverged = failed || errors.error_max >= 100.0 || drift.error_max >= 1e3 * kinetic;
        let mut configuration: serde_json::Map<String, Value> = axes
            .iter()
            .map(|&(axis, value)| (axis.to_owned(), json!(value)))
            .collect();
        configuration.insert("step".into(), json!(step.to_string()));
        let stated = |x: f64| if diverged { Value::Null } else { json!(x) };
        println!(
            "{}",
            json!({
                "robot": self.robot,
                "kind": "simulation",
                "key": key,
                "step": step,
                "configuration": configuration,
                "unit": "rad per simulated second",
                "diverged": diverged,
                "full_scale": angle,
                "error_max": stated(errors.error_max),
                "error_rms": stated(errors.error_rms),
                "error_p99": stated(errors.error_p99),
                "relative_max": stated(errors.relative_max),
                "energy_full_scale": kinetic,
                "energy_seconds": seconds,
                "energy_drift": stated(drift.error_max / seconds),
                "energy_drift_relative": stated(drift.relative_max / seconds),
            })
        );
    }
}

/// The motion of the first second by f64 and small steps, sample by sample.
fn oracle<T: LetGo<N>, E: Effect<f64, N, N>, const N: usize>(
    effects: &E,
    step: u32,
) -> Vec<[[f64; N]; 2]> {
    let robot = ModelDynamics {
        robot: &Static::<T>::NEW,
        tau: [0.0; N],
        effects,
    };
    let [q, qd] = T::START;
    let mut motion = KahanState::<f64, N, true>::at(State {
        q,
        qd,
        qdd: [0.0; N],
    });
    let h = f64::from(step) * 1e-6;
    let samples = (0..SECOND).map(|_| {
        for _ in 0..SAMPLE / step {
            let step = RungeKutta.step(&robot, &motion.state, h);
            motion.add(&step.expect("a robot with inertia"), h);
        }
        [motion.state.q, motion.state.qd]
    });
    samples.collect()
}

/// The double pendulum by Lagrange's equations, angles from the vertical, the second's relative to the first.
fn lagrange() -> Vec<[[f64; 2]; 2]> {
    let (m, l, c, i, g) = (1.0, 0.5, 0.25, 1.0 / 48.0, 9.81);
    let acceleration = |[q, qd]: [[f64; 2]; 2]| -> [f64; 2] {
        let (a, b) = (i + m * c * c + m * l * l, i + m * c * c);
        let (cross, sine) = (m * l * c * q[1].cos(), m * l * c * q[1].sin());
        let mass = [[a + b + 2.0 * cross, b + cross], [b + cross, b]];
        let weight = m * g * c * (q[0] + q[1]).sin();
        let bias = [
            -sine * (2.0 * qd[0] * qd[1] + qd[1] * qd[1]) + m * g * (c + l) * q[0].sin() + weight,
            sine * qd[0] * qd[0] + weight,
        ];
        let det = mass[0][0] * mass[1][1] - mass[0][1] * mass[1][0];
        [
            (-bias[0] * mass[1][1] + bias[1] * mass[0][1]) / det,
            (-bias[1] * mass[0][0] + bias[0] * mass[1][0]) / det,
        ]
    };
    let plus = |[q, qd]: [[f64; 2]; 2], [dq, dqd]: [[f64; 2]; 2], h: f64| {
        [
            [q[0] + h * dq[0], q[1] + h * dq[1]],
            [qd[0] + h * dqd[0], qd[1] + h * dqd[1]],
        ]
    };
    let slope = |at: [[f64; 2]; 2]| [at[1], acceleration(at)];
    let mut at = DoublePendulum::START;
    let h = f64::from(FINE) * 1e-6;
    let samples = (0..SECOND).map(|_| {
        for _ in 0..SAMPLE / FINE {
            let first = slope(at);
            let second = slope(plus(at, first, h / 2.0));
            let third = slope(plus(at, second, h / 2.0));
            let last = slope(plus(at, third, h));
            for (slope, share) in [(first, 6.0), (second, 3.0), (third, 3.0), (last, 6.0)] {
                at = plus(at, slope, h / share);
            }
        }
        at
    });
    samples.collect()
}
