//! The cost of the algorithms on a robot, between the meter's markers: states, and how a row is
//! measured. `cargo xtask costs` reads the log, rows and at last `done`, and cuts the meter's
//! samples by it. Two bins a robot, since each specialised function takes the compiler seconds, and
//! bins are built side by side.
#![allow(
    dead_code,
    unused_imports,
    unused_macros,
    reason = "each bin measures its part of these rows"
)]

pub mod by_hand;
#[cfg(feature = "effects")]
pub mod effects;
pub mod estimators;
pub mod forward;
pub mod inverse;
pub mod laws;
pub mod loaded;
pub mod momentum;
pub mod row;
pub mod so101;
pub mod tips;

use cortex_m_semihosting::debug;
use dynamics_core::Core;
use dynamics_core::model::Robot;
use dynamics_core::state::{JointTrig, State};
use firmware_demo::target;
use row::numbers;

/// Number of states on which each function is called.
pub const STATES: usize = 32;

/// The input of a measured function.
pub struct Ask<const N: usize> {
    pub state: State<f32, N, N>,
    pub trig: JointTrig<f32, N>,
}

/// Some states within the joints' usual ranges, from a fixed seed.
pub fn asks<T: Robot<B, N, N>, const B: usize, const N: usize, const S: usize>() -> [Ask<N>; S] {
    let mut number = numbers();
    [(); S].map(|()| {
        let state = State {
            q: [(); N].map(|()| number(3.0)),
            qd: [(); N].map(|()| number(3.0)),
            qdd: [(); N].map(|()| number(10.0)),
        };
        let trig = Core::<T>::joint_trig(&state.q);
        Ask { state, trig }
    })
}

/// Ends the log and leaves the emulator.
pub fn done() -> ! {
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

/// The `main` of a bin that measures.
macro_rules! main {
    ($run:expr) => {
        use dynamics_core::robots;

        #[cortex_m_rt::entry]
        fn main() -> ! {
            $run
        }
    };
}
pub(crate) use main;
