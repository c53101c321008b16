//! A firmware with one specialised function, or none: `cargo xtask build-time` times how long the compiler
//! takes for each. `BUILD_TIME_ROBOT`, at compile time, names the robot.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::robots::{G1, Panda};
use dynamics_core::state::State;
use firmware_demo::target;

const ROBOT: &[u8] = match option_env!("BUILD_TIME_ROBOT") {
    Some(name) => name.as_bytes(),
    None => b"none",
};

/// One call that the compiler cannot foresee.
fn call<T: Robot<N, N, N>, const N: usize>() {
    let state = black_box(State {
        q: [0.1_f32; N],
        qd: [0.2; N],
        qdd: [0.3; N],
    });
    black_box(Engine::<T>::rnea(&state, &RIGID_BODY));
}

#[entry]
fn main() -> ! {
    if const { matches!(ROBOT, b"panda") } {
        call::<Panda, 7>();
    }
    if const { matches!(ROBOT, b"g1") } {
        call::<G1, 29>();
    }
    target::leave(debug::EXIT_SUCCESS)
}
