//! Calls the functions in QEMU, between the meter's marks, at states that the host writes into the
//! program, and prints the bits of their results.

use core::hint::black_box;

use cortex_m_semihosting::hprintln;
use dynamics_core::state::StateWithTrig;
use firmware_demo::marker::measured;

use crate::inputs::{CERTIFIED_STATES, CERTIFIED_TRIGS};
use crate::{CERTIFIED_CORE_RNEA, CERTIFIED_EFFECTS, CERTIFIED_GRAVITY, CERTIFIED_RNEA, N};

/// Nothing is known of the function to the compiler, so that its code is that which is proven.
pub fn run() {
    let (rnea, gravity, core) = black_box((CERTIFIED_RNEA, CERTIFIED_GRAVITY, CERTIFIED_CORE_RNEA));
    each("rnea", |state| rnea(state, &CERTIFIED_EFFECTS));
    each("gravity", |state| gravity(state, &(CERTIFIED_EFFECTS.0,)));
    each("core", |state| core(state, &CERTIFIED_EFFECTS));
}

fn each(name: &str, function: impl Fn(StateWithTrig<'static, f32, N, N>) -> [f32; N]) {
    for (state, trig) in black_box(&CERTIFIED_STATES).iter().zip(black_box(&CERTIFIED_TRIGS)) {
        let state = trig.with(state);
        let result = measured::<0, _>(|| function(state));
        hprintln!("{} {:x?}", name, result.map(f32::to_bits));
    }
}
