//! What each effect of the catalogue costs in inverse dynamics on the UR5e, between the meter's markers.
//! `cargo xtask effects` reads the log: the rows of `costs`, and before each of them
//!
//! ```text
//! holds FORM NAME BYTES
//! ```
//!
//! the bytes of the scene's effects: their numbers, and what they remember.

use core::marker::PhantomData;

use dynamics_core::effects::Effect;
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::catalogue::Visitor;

use super::costs::row::Row;
use super::costs::{Ask, STATES, asks};

/// Inverse dynamics in one of its forms.
pub trait Form {
    const NAME: &'static str;
    fn rnea<E: Effect<f32, 6, 6>>() -> Rnea<E>;
}

type Rnea<E> = fn(&State<f32, 6, 6>, &E) -> [f32; 6];

impl Form for Core<Ur5e> {
    const NAME: &'static str = "core";
    fn rnea<E: Effect<f32, 6, 6>>() -> Rnea<E> {
        Self::rnea
    }
}

impl Form for Engine<Ur5e> {
    const NAME: &'static str = "engine";
    fn rnea<E: Effect<f32, 6, 6>>() -> Rnea<E> {
        Self::rnea
    }
}

/// Prices each scene that it visits.
pub struct Priced<F> {
    asks: [Ask<6>; STATES],
    form: PhantomData<F>,
}

impl<F> Priced<F> {
    pub fn new() -> Self {
        let asks = asks::<Ur5e, 6, 6>();
        Self {
            asks,
            form: PhantomData,
        }
    }
}

impl<F: Form> Visitor<6> for Priced<F> {
    fn scene<E: Effect<f32, 6, 6>>(&mut self, name: &'static str, effects: E) {
        defmt::println!(
            "holds {=str} {=str} {=usize}",
            F::NAME,
            name,
            size_of::<E>()
        );
        let row = Row {
            robot: <Ur5e as Robot<6, 6, 6>>::MODEL.name,
            algorithm: "rnea",
            form: F::NAME,
            inputs: name,
            trig: true,
            joints: 6,
        };
        let rnea = F::rnea::<E>();
        row.measure(rnea as usize, &self.asks, |ask| rnea(&ask.state, &effects));
    }
}
