//! Some ticks of inverse dynamics under a scene's effects, which remember: they lie in RAM. The log
//! names how many bytes of it they take.

use core::hint::black_box;

use cortex_m_semihosting::debug;
use dynamics_core::Engine;
use dynamics_core::effects::{Effect, JointState};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::target;

const TICKS: usize = 10;

/// Runs the ticks and leaves the emulator.
pub fn run<E: Effect<f32, 6, 6>>(effects: Option<&'static mut E>) -> ! {
    let Some(effects) = effects else {
        target::fail("main ran twice");
    };
    for _ in 0..TICKS {
        let state: State<f32, 6, 6> = black_box(State { q: [0.3; 6], qd: [0.5; 6], qdd: [1.0; 6] });
        black_box(Engine::<Ur5e>::rnea(&state, effects));
        for joint in 0..6 {
            let at = JointState::new(state.q[joint], state.qd[joint]);
            effects.advance(joint, at, 1e-3);
        }
    }
    defmt::println!("effects {=usize}", size_of::<E>());
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}
