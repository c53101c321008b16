//! Inverse dynamics on the SO-101, and its compensation of gravity and friction as a command of
//! voltage.

use dynamics_core::Engine;
use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach::{COMPENSATION, with_back_emf};

use super::inverse::inverse;
use super::row::Row;
use super::{STATES, asks, by_hand, estimators};

type Torque = fn(&State<f32, 6, 6>) -> [f32; 6];

/// The torques that hold and move the arm without effort.
#[inline(never)]
fn torques(state: &State<f32, 6, 6>) -> [f32; 6] {
    Engine::<So101>::rnea(state, &COMPENSATION)
}

/// The command that holds and moves the arm without effort.
#[inline(never)]
fn command(state: &State<f32, 6, 6>) -> [f32; 6] {
    with_back_emf(Engine::<So101>::rnea(state, &COMPENSATION), &state.qd)
}

pub fn rows() {
    let asks = asks::<So101, 6, 6, STATES>();
    inverse::<So101, _, 6, 6>("full", &asks, &RIGID_BODY);
    inverse::<So101, _, 6, 6>("gravity", &asks, &(Gravity::EARTH,));
    let row = Row::of::<So101, 6, 6>("gravity", "by_hand", "libm", true);
    let by_hand = by_hand::gravity;
    row.measure(by_hand as *const () as usize, &asks, |ask| by_hand(&ask.state.q));
    for ask in &asks {
        let engine = Engine::<So101>::rnea(&ask.state, &(Gravity::EARTH,));
        let both = by_hand(&ask.state.q).into_iter().zip(engine);
        defmt::assert!(both.into_iter().all(|(by_hand, engine)| (by_hand - engine).abs() < 1e-5));
    }
    let functions: [(&str, Torque); 2] = [("compensation", torques), ("command", command)];
    for (inputs, function) in functions {
        let row = Row::of::<So101, 6, 6>("rnea", "engine", inputs, true);
        row.measure(function as usize, &asks, |ask| function(&ask.state));
    }
    estimators::parameters(&asks);
}
