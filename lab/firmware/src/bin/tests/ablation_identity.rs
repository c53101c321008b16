//! An effect that is not named is not there: inverse dynamics of a rigid body alone, beside effects
//! that do nothing, and beside friction and rotors. `cargo xtask test absent-effects` compares what
//! the compiler made of them.
#![no_std]
#![no_main]

#[path = "../costs/mod.rs"]
mod costs;

use cortex_m_rt::entry;
use dynamics_core::effects::{Armature, Coulomb, Effect, JointState, RIGID_BODY, Viscous, Width};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

use costs::row::Row;
use costs::{Ask, STATES, asks, done};

/// An effect with nothing but an empty hook.
struct Nothing;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Nothing {
    fn torque(&self, _: usize, _: JointState<R>, _: &mut R) {}
}

const VISCOUS: Viscous<f32, 6> = Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]);
const COULOMB: Coulomb<f32, 6> =
    Coulomb { torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2], width: Width::f32(0.05) };
const ROTORS: Armature<f32, 6> = Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]);

type Rnea<'a, E> = fn(&'a State<f32, 6, 6>, &E) -> [f32; 6];

#[entry]
fn main() -> ! {
    let asks = asks::<Ur5e, 6, 6, STATES>();
    both("full", &asks, &RIGID_BODY);
    both("idle", &asks, &(Nothing, RIGID_BODY, (Nothing, Nothing)));
    both("friction", &asks, &(RIGID_BODY, VISCOUS, COULOMB, ROTORS));
    // As a scene has them: their numbers known while compiling, of types that nothing else here
    // has.
    row("engine", "full_known").measure(full as *const () as usize, &asks, |ask| full(&ask.state));
    row("engine", "friction_known")
        .measure(friction as *const () as usize, &asks, |ask| friction(&ask.state));
    done()
}

#[inline(never)]
fn full(state: &State<f32, 6, 6>) -> [f32; 6] {
    Engine::<Ur5e>::rnea(state, &(RIGID_BODY,))
}

#[inline(never)]
fn friction(state: &State<f32, 6, 6>) -> [f32; 6] {
    Engine::<Ur5e>::rnea(state, &((RIGID_BODY,), VISCOUS, COULOMB, ROTORS))
}

/// Measures inverse dynamics in both forms, effects at an address.
fn both<E: Effect<f32, 6, 6>>(inputs: &'static str, asks: &[Ask<6>; STATES], effects: &E) {
    let forms: [(&str, Rnea<'_, E>); 2] =
        [("core", Core::<Ur5e>::rnea), ("engine", Engine::<Ur5e>::rnea)];
    for (form, rnea) in forms {
        row(form, inputs).measure(rnea as usize, asks, |ask| rnea(&ask.state, effects));
    }
}

fn row(form: &'static str, inputs: &'static str) -> Row<'static> {
    Row::of::<Ur5e, 6, 6>("rnea", form, inputs, true)
}
