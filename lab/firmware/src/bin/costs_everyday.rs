//! The costs that users meet, which each run of the tests measures: in one image, since its
//! link-time optimisation takes the compiler longest.
#![no_std]
#![no_main]

mod costs;

use costs::inverse::{RigidBody, free_torques, inverse};
use costs::row::Row;
use costs::{Ask, STATES, asks, done, estimators, forward, laws, loaded, momentum, so101, tips};
use dynamics_core::Engine;
use dynamics_core::algorithms::TorquesAndWrenches;
use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::state::{State, StateWithTrig};
use robots::{A1Free, Ur5e};

const TIP: usize = 5;
const WRIST: usize = Ur5e::MODEL.body("wrist_3");

type WithWrench<'a> =
    fn(&'a State<f32, 6, 6>, &RigidBody, OnBody<WRIST>) -> TorquesAndWrenches<f32, 6, 1>;

/// A function of the engine, with sines and cosines computed inside and before.
fn both<'a, E, Out>(
    algorithm: &'static str,
    (asks, effects): (&'a [Ask<6>; STATES], &E),
    inside: fn(&'a State<f32, 6, 6>, &E) -> Out,
    before: fn(StateWithTrig<'a, f32, 6, 6>, &E) -> Out,
) {
    let row = |trig| Row::of::<Ur5e, 6, 6>(algorithm, "engine", "full", trig);
    row(true).measure(inside as usize, asks, |ask| inside(&ask.state, effects));
    row(false).measure(before as usize, asks, |ask| before(ask.trig.with(&ask.state), effects));
}

fn ur5e(asks: &[Ask<6>; STATES]) {
    let run: WithWrench<'_> = Engine::<Ur5e>::rnea_and_wrenches;
    let row = Row::of::<Ur5e, 6, 6>("rnea_and_wrenches", "engine", "wrist_3", true);
    row.measure(run as usize, asks, |ask| run(&ask.state, &RIGID_BODY, OnBody));
    inverse::<Ur5e, _, 6, 6>("full", asks, &RIGID_BODY);
    inverse::<Ur5e, _, 6, 6>("gravity", asks, &(Gravity::EARTH,));
    let (inside, before) = (Engine::<Ur5e>::rnea_derivatives, Engine::<Ur5e>::rnea_derivatives);
    both("rnea_derivatives", (asks, &RIGID_BODY), inside, before);
    let forms = [forward::of_core::<Ur5e, 6, 6, TIP>(), forward::of_engine::<Ur5e, 6, 6, TIP>()];
    forward::run::<Ur5e, 6, 6, TIP>(asks, &forms);
    let (inside, before) =
        (Engine::<Ur5e>::momentum_and_coriolis, Engine::<Ur5e>::momentum_and_coriolis);
    both("momentum", (asks, &()), inside, before);
    momentum::observer::<Ur5e, 6, 6>(asks);
    loaded::engine::<Ur5e, 6, 6>(asks);
    estimators::payload::<Ur5e, 6, 6>(asks);
}

fn run() -> ! {
    let asks = &asks::<Ur5e, 6, 6, STATES>();
    ur5e(asks);
    if tips::rows(asks).is_ok() {
        laws::rows(asks);
        so101::rows();
        free_torques::<A1Free, 17, 19, 18>();
    }
    done()
}

costs::main!(run());
