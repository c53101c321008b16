//! The true motion of a robot that is let go, for simulations to be compared with.

use dynamics_core::effects::Effect;
use dynamics_core::model::Static;
use dynamics_core::sim::{Integrator, KahanState, ModelDynamics, RungeKutta};
use dynamics_core::state::State;
use fixtures::accuracy::simulation::PassiveMotion;

/// µs from one comparison to the next.
pub const SAMPLE: u32 = 20_000;
/// The oracle's step, µs.
pub const FINE: u32 = 20;
/// Samples of a second, in which motions are compared.
pub const SECOND: usize = (1_000_000 / SAMPLE) as usize;

/// q and q̇ after each sample of the first second, in f64 by the core, in steps of this many µs.
pub fn true_motion<T: PassiveMotion<N>, E: Effect<f64, N, N>, const N: usize>(
    effects: &E,
    step: u32,
) -> Vec<[[f64; N]; 2]> {
    let robot = ModelDynamics { robot: &Static::<T>::NEW, tau: [0.0; N], effects };
    let ([q, qd], qdd) = (T::START, [0.0; N]);
    let mut motion = KahanState::<f64, N, true>::at(State { q, qd, qdd });
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
