//! Scene `ur5e`: pick and place, with the arm's full model as feed-forward.

use dynamics_core::Engine;
use dynamics_core::control::WayPoint;
use dynamics_core::effects::{Coriolis, Coulomb, Gravity, Inertia, RotorInertia, Viscous};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;

use crate::control_loop::Law;
use crate::scene::{Noise, Scene};
use crate::trajectories::{HOME, PICK_AND_PLACE};

/// What acts on the arm.
pub type Effects = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<f32, 6>,
    Coulomb<f32, 6>,
    RotorInertia<f32, 6>,
);

/// Friction and rotors are assumed, of the order that identifications of this arm's size find: the
/// maker publishes neither.
pub const EFFECTS: Effects = (
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

/// The scene.
#[derive(Clone, Copy, Debug)]
pub struct PickAndPlace;

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

/// Feed-forward by the arm's full model.
#[derive(Clone, Copy, Debug)]
pub struct FullModel;

impl Law<6> for FullModel {
    fn feedforward(reference: &State<f32, 6, 6>) -> [f32; 6] {
        Engine::<Ur5e>::rnea(reference, &EFFECTS)
    }
}

/// Gravity compensation.
#[derive(Clone, Copy, Debug)]
pub struct GravityOnly;

impl Law<6> for GravityOnly {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, 6, 6>) -> [f32; 6] {
        Engine::<Ur5e>::rnea(reference, &(Gravity::EARTH,))
    }
}
