//! What inverse dynamics costs on the SO-101, and its compensation of gravity and friction as a command of voltage.
#![no_std]
#![no_main]

mod costs;

use dynamics_core::Engine;
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach::{COMPENSATION, with_back_emf};

/// The command that holds and moves the arm without effort.
#[inline(never)]
fn compensation(state: &State<f32, 6, 6>) -> [f32; 6] {
    with_back_emf(Engine::<So101>::rnea(state, &COMPENSATION), &state.qd)
}

fn run() -> ! {
    costs::inverse::rows::<So101, 6, 6>();
    let asks = costs::asks::<So101, 6, 6, { costs::STATES }>();
    costs::row::Row::of::<So101, 6, 6>("rnea", "engine", "compensation", true).measure(
        compensation as usize,
        &asks,
        |ask| compensation(&ask.state),
    );
    costs::done()
}

costs::main!(run());
