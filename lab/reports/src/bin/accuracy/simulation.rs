//! Simulations: how far each way drifts off in energy and from the true motion, for every length of
//! step.
//!
//! The true motion is Runge and Kutta's in f64 with the oracle's step, on the core; the tests
//! compare the double pendulum's with Lagrange's equations written out by hand. Trajectory errors
//! are over the first second, since both robots are chaotic; energy is watched for longer. If
//! friction takes energy, the energy is compared with that of the true motion.

use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use fixtures::accuracy::simulation::{
    Damped, DoublePendulum, PassiveMotion, Scene, Simulation, Visitor, every,
};
use host_tests::measured::largest;
use host_tests::true_motion::{FINE, SAMPLE, SECOND, true_motion};
use serde_json::{Value, json};

use super::statistics::{Errors, object};

/// µs; each divides [`SAMPLE`].
const STEPS: [u32; 9] = [20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000];
/// Seconds in which energy is watched.
const WATCHED: usize = 5;

/// The true motions of a robot.
struct Bench<const N: usize> {
    robot: &'static str,
    /// q and q̇ after each sample of the first second, free and damped.
    truth: [Vec<[[f64; N]; 2]>; 2],
    energies: fn([[f64; N]; 2]) -> [f64; 2],
    /// Largest kinetic energy of the free motion, J, and angle of both, rad.
    scales: [f64; 2],
}

/// Prints a line for each way and step.
pub fn print() {
    robot::<DoublePendulum, 2>();
    robot::<Ur5e, 6>();
}

fn robot<T: PassiveMotion<N>, const N: usize>() {
    let damped = <Damped<f64, N> as Scene<T, f64, N>>::effects();
    let truth = [true_motion::<T, _, N>(&RIGID_BODY, FINE), true_motion::<T, _, N>(&damped, FINE)];
    let energies = |[q, qd]: [[f64; N]; 2]| {
        let qdd = [0.0; N];
        let state = State { q, qd, qdd };
        [
            Core::<T>::kinetic_energy(&state, &RIGID_BODY),
            Core::<T>::potential_energy(&q, &RIGID_BODY),
        ]
    };
    let kinetic = truth[0].iter().map(|&at| energies(at)[0]);
    let angles = truth.iter().flatten().flat_map(|at| at[0]);
    let scales = [largest(kinetic), largest(angles.map(f64::abs))];
    let robot = T::MODEL.name;
    every::<T, N>(&mut Bench { robot, truth, energies, scales });
}

impl<const N: usize> Visitor<N> for Bench<N> {
    fn simulation<S: Simulation<N>>(&mut self) {
        let damped = S::KEY.scene == "damped";
        let truth = &self.truth[usize::from(damped)];
        let total = |at| (self.energies)(at).iter().sum::<f64>();
        let seconds = if damped { 1 } else { WATCHED };
        for step in STEPS {
            let mut run = S::start();
            let start = total(run.measured());
            let (mut errors, mut drift) = (Errors::default(), Errors::default());
            let mut failed = false;
            for sample in 0..seconds * SECOND {
                for _ in 0..SAMPLE / step {
                    failed |= run.step(f64::from(step) * 1e-6).is_err();
                }
                let measured = run.measured();
                if let Some(truth) = truth.get(sample) {
                    errors.add(&measured[0], &truth[0]);
                }
                let want = if damped { total(truth[sample]) } else { start };
                drift.add(&[total(measured)], &[want]);
            }
            let [kinetic, angle] = self.scales;
            let step = step.to_string();
            let axes = S::KEY.axes();
            let mut line = json!({
                "key": S::KEY.to_string(),
                "configuration": object(axes.iter().chain(&[("step", &*step)])),
                "unit": "rad per simulated second",
                "drift": drift.max() / kinetic / seconds as f64,
            });
            // A simulation that has left the robot's range has no meaningful error.
            if failed || errors.max() >= 100.0 || drift.max() >= 1e3 * kinetic {
                for name in ["error_max", "error_rms", "error_p99", "relative_max", "drift"] {
                    line[name] = Value::Null;
                }
            }
            errors.print(self.robot, "simulation", [angle, 0.0], line);
        }
    }
}
