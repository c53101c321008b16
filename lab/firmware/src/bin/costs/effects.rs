//! The cost of each effect of the catalogue in inverse dynamics, between the meter's markers.
//! `cargo xtask effects` reads the log: the rows of `costs`, and before each of them
//!
//! ```text
//! holds ROBOT FORM NAME BYTES
//! ```
//!
//! the bytes of the scene's effects: their numbers, and what they remember.

use core::marker::PhantomData;

use dynamics_core::effects::Effect;
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use fixtures::effect_presets::{self, Visitor};

use super::row::Row;
use super::{Ask, STATES, asks, done};

/// Inverse dynamics of an arm in one of its forms.
trait Form<const N: usize> {
    const NAME: &'static str;
    type Arm: Robot<N, N, N>;
    fn rnea<'a, E: Effect<f32, N, N>>() -> Rnea<'a, E, N>;
}

type Rnea<'a, E, const N: usize> = fn(&'a State<f32, N, N>, &E) -> [f32; N];

impl<T: Robot<N, N, N>, const N: usize> Form<N> for Core<T> {
    const NAME: &'static str = "core";
    type Arm = T;
    fn rnea<'a, E: Effect<f32, N, N>>() -> Rnea<'a, E, N> {
        Self::rnea
    }
}

impl<T: Robot<N, N, N>, const N: usize> Form<N> for Engine<T> {
    const NAME: &'static str = "engine";
    type Arm = T;
    fn rnea<'a, E: Effect<f32, N, N>>() -> Rnea<'a, E, N> {
        Self::rnea
    }
}

/// Prices each scene that it visits.
struct Priced<F, const N: usize> {
    asks: [Ask<N>; STATES],
    form: PhantomData<F>,
}

impl<F: Form<N>, const N: usize> Priced<F, N> {
    fn new() -> Self {
        Self { asks: asks::<F::Arm, N, N, STATES>(), form: PhantomData }
    }
}

impl<F: Form<N>, const N: usize> Visitor<N> for Priced<F, N> {
    fn scene<E: Effect<f32, N, N>>(&mut self, name: &'static str, effects: E) {
        let robot = F::Arm::MODEL.name;
        let bytes = size_of::<E>();
        defmt::println!("holds {=str} {=str} {=str} {=usize}", robot, F::NAME, name, bytes);
        let row = Row::of::<F::Arm, N, N>("rnea", F::NAME, name, true);
        let rnea = F::rnea::<E>();
        row.measure(rnea as usize, &self.asks, |ask| rnea(&ask.state, &effects));
    }
}

/// Every effect, in the core.
#[inline(always)]
pub fn core<T: Robot<N, N, N>, const N: usize, const TIP: usize>() {
    let priced = &mut Priced::<Core<T>, N>::new();
    effect_presets::rigid(priced);
    effect_presets::joints(priced);
    effect_presets::bodies::<N, TIP>(priced);
    effect_presets::spinning(priced);
}

/// Effects at joints, in the engine.
pub fn joints<T: Robot<N, N, N>, const N: usize>() -> ! {
    effect_presets::joints(&mut Priced::<Engine<T>, N>::new());
    done()
}

/// A rigid body's own terms, and effects on bodies, in the engine.
pub fn bodies<T: Robot<N, N, N>, const N: usize, const TIP: usize>() -> ! {
    let priced = &mut Priced::<Engine<T>, N>::new();
    effect_presets::rigid(priced);
    effect_presets::bodies::<N, TIP>(priced);
    done()
}
