//! Scene `ur5e`: pick and place, with the arm's full model as feed-forward.
#![no_std]
#![no_main]

use cortex_m::singleton;
use cortex_m_rt::entry;
use dynamics_core::Engine;
use dynamics_core::control::WayPoint;
use dynamics_core::effects::{Coriolis, Coulomb, Gravity, Inertia, RotorInertia, Viscous};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::control_loop::Law;
use firmware_demo::plant::Wires;
use firmware_demo::scene::{App, Noise, Record, Scene};
use firmware_demo::target;
use firmware_demo::trajectories::{HOME, PICK_AND_PLACE};
use heapless::spsc::Queue;

type Effects = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<f32, 6>,
    Coulomb<f32, 6>,
    RotorInertia<f32, 6>,
);

// Friction and rotors are assumed, of the order that identifications of this arm's size find:
// the maker publishes neither.
const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]),
    Coulomb {
        torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2],
        per_width: 20.0,
    },
    RotorInertia([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
);

struct PickAndPlace;

impl Scene<6, 6, 9> for PickAndPlace {
    type Robot = Ur5e;
    type Effects = Effects;
    type FeedForward = FullModel;
    type Gravity = GravityOnly;
    const NAME: &'static str = "ur5e";
    const ACCELERATION: [f32; 6] = [12.0; 6];
    const GAIN_POSE: [f32; 6] = HOME;
    const GAIN_POSE_NAME: &'static str = "home";
    const WAY_POINTS: [WayPoint<f32, 6>; 9] = PICK_AND_PLACE;

    fn effects() -> Effects {
        EFFECTS
    }

    fn disturbed(noise: &mut Noise) -> Effects {
        let mut effects = EFFECTS;
        effects.3.0 = effects.3.0.map(|b| b * noise.factor(0.1));
        effects.4.torque = effects.4.torque.map(|f| f * noise.factor(0.1));
        effects
    }
}

struct FullModel;

impl Law<6> for FullModel {
    fn feedforward(reference: &State<f32, 6, 6>) -> [f32; 6] {
        Engine::<Ur5e>::rnea(reference, &EFFECTS)
    }
}

struct GravityOnly;

impl Law<6> for GravityOnly {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, 6, 6>) -> [f32; 6] {
        Engine::<Ur5e>::rnea(reference, &(Gravity::EARTH,))
    }
}

#[entry]
fn main() -> ! {
    static WIRES: Wires<6> = Wires::new();
    let queue = singleton!(: Queue<Record<6>, 32> = Queue::new());
    let Some((records, log)) = queue.map(Queue::split) else {
        target::fail("main ran twice");
    };
    let app = match App::new(&WIRES, records) {
        Ok(app) => singleton!(: App<PickAndPlace, 6, 6, 9> = app),
        Err(_) => target::fail("the way-points need more than the arm's limits"),
    };
    match app {
        Some(app) => target::run(app, log),
        None => target::fail("main ran twice"),
    }
}
