//! The simulation that `cargo xtask accuracy` prints to be pasted is the one that it measured.

#[path = "pasted/ur5e_rk4.rs"]
#[allow(missing_docs, reason = "as it is printed")]
mod ur5e_rk4;

use dynamics_core::robots::Ur5e;
use dynamics_core::sim::RungeKutta;
use dynamics_core::state::State;
use firmware_demo::accuracy::let_go::{Free, LetGo};
use firmware_demo::accuracy::simulation::{Run, Simulation};

#[test]
fn a_pasted_simulation_gives_the_bits_of_the_measured_one() {
    let [q, qd] = Ur5e::START.map(|numbers| numbers.map(|x| x as f32));
    let mut pasted = ur5e_rk4::Simulation::start(State {
        q,
        qd,
        qdd: [0.0; 6],
    });
    let mut run = Run::<Ur5e, Free, RungeKutta, f32, 6, true>::start();
    for _ in 0..200 {
        let state = pasted.step().expect("a robot with inertia");
        let pasted_state = [state.q, state.qd].map(|numbers| numbers.map(f64::from));
        run.step(1e-3).expect("a robot with inertia");
        assert_eq!(pasted_state, run.measured());
    }
}
