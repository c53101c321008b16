//! Calls the functions in QEMU, between the meter's marks, at states that the host writes into the
//! program, and prints the bits of their results.

use core::hint::black_box;

use cortex_m_semihosting::hprintln;
use dynamics_core::state::{RobotState as _, StateWithTrig};
use firmware_demo::marker::measured;

use crate::inputs::{CERTIFIED_STATES, CERTIFIED_TRIGS};
use crate::{
    CERTIFIED_CORE_CRBA, CERTIFIED_CORE_FORWARD, CERTIFIED_CORE_RNEA, CERTIFIED_CRBA,
    CERTIFIED_EFFECTS, CERTIFIED_FORWARD, CERTIFIED_GRAVITY, CERTIFIED_RNEA, N,
};

/// Nothing is known of the function to the compiler, so that its code is that which is proven.
pub fn run() {
    let (rnea, gravity, core) = black_box((CERTIFIED_RNEA, CERTIFIED_GRAVITY, CERTIFIED_CORE_RNEA));
    let (crba, forward) = black_box((CERTIFIED_CRBA, CERTIFIED_FORWARD));
    let (core_crba, core_forward) = black_box((CERTIFIED_CORE_CRBA, CERTIFIED_CORE_FORWARD));
    each("rnea", |state| rnea(state, &CERTIFIED_EFFECTS));
    each("gravity", |state| gravity(state, &(CERTIFIED_EFFECTS.0,)));
    each("core", |state| core(state, &CERTIFIED_EFFECTS));
    // Torques are where the state has accelerations. A matrix that is refused has no bits.
    let both = [("forward_dynamics", forward), ("core_forward_dynamics", core_forward)];
    for (name, forward) in both {
        each(name, |state| {
            forward(state, &state.state().qdd, &CERTIFIED_EFFECTS).unwrap_or([0.0; N])
        });
    }
    for (name, crba) in [("crba", crba), ("core_crba", core_crba)] {
        for trig in black_box(&CERTIFIED_TRIGS) {
            let m = measured::<0, _>(|| crba(trig, &CERTIFIED_EFFECTS));
            let rows: [[u32; N]; N] =
                core::array::from_fn(|i| core::array::from_fn(|j| m.get(i, j).to_bits()));
            hprintln!("{} {:x?}", name, rows);
        }
    }
}

fn each(name: &str, function: impl Fn(StateWithTrig<'static, f32, N, N>) -> [f32; N]) {
    for (state, trig) in black_box(&CERTIFIED_STATES).iter().zip(black_box(&CERTIFIED_TRIGS)) {
        let state = trig.with(state);
        let result = measured::<0, _>(|| function(state));
        hprintln!("{} {:x?}", name, result.map(f32::to_bits));
    }
}
