//! The simulation that `cargo xtask accuracy` prints as generated code is the one that it measured.

#[path = "generated/ur5e_rk4.rs"]
mod ur5e_rk4;

use dynamics_core::robots::Ur5e;
use dynamics_core::sim::RungeKutta;
use dynamics_core::state::State;
use fixtures::accuracy::passive_motion::{Free, PassiveMotion};
use fixtures::accuracy::simulation::{Run, Simulation};

#[test]
fn a_pasted_simulation_gives_the_bits_of_the_measured_one() {
    let [q, qd] = Ur5e::START.map(|numbers| numbers.map(|x| x as f32));
    let mut generated = ur5e_rk4::Simulation::start(State { q, qd, qdd: [0.0; 6] });
    let mut run = Run::<Ur5e, Free, RungeKutta, f32, 6, true>::start();
    for _ in 0..200 {
        let state = generated.step().expect("a robot with inertia");
        let generated_state = [state.q, state.qd].map(|numbers| numbers.map(f64::from));
        run.step(1e-3).expect("a robot with inertia");
        assert_eq!(generated_state, run.measured());
    }
}
