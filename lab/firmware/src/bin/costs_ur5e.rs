//! The cost of inverse dynamics on the UR5e, and of a wrench in a joint beside it.
#![no_std]
#![no_main]

mod costs;

use costs::inverse::RigidBody;
use costs::row::Row;
use costs::{STATES, asks};
use dynamics_core::Engine;
use dynamics_core::algorithms::TorquesAndWrenches;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::state::State;
use robots::Ur5e;

const WRIST: usize = Ur5e::MODEL.body("wrist_3");
type WithWrench<'a> =
    fn(&'a State<f32, 6, 6>, &RigidBody, OnBody<WRIST>) -> TorquesAndWrenches<f32, 6, 1>;

fn run() -> ! {
    let run: WithWrench<'_> = Engine::<Ur5e>::rnea_and_wrenches;
    Row::of::<Ur5e, 6, 6>("rnea_and_wrenches", "engine", "wrist_3", true).measure(
        run as usize,
        &asks::<Ur5e, 6, 6, STATES>(),
        |ask| run(&ask.state, &RIGID_BODY, OnBody),
    );
    costs::inverse::run::<Ur5e, 6, 6>()
}

costs::main!(run());
