//! Scene `delta_pick`: a Delta robot picks parts from a feeder, 120 a minute.

use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, Viscous, Width,
};
use dynamics_core::model::{JointLimits, Robot};
use dynamics_core::state::State;
use motion_control::reference::TrajectoryError;

use crate::plant::ClusterPlant;
use crate::robots::PickDelta;
use crate::scene::clustered;
use crate::scene::{Noise, Scene, limits_of};
use crate::trajectories::picks::{FEEDER, Picks, cranks};

pub type Effects =
    (Gravity, Inertia, Coriolis, Viscous<f32, 12>, Coulomb<f32, 12>, Armature<f32, 12>);

/// The effects' numbers, of the cranks.
///
/// The inertia of the gears is that of [`PickDelta`]'s source, which leaves out the motors' rotors.
/// Friction is assumed, of the order of gears of 55 : 1 for this torque.
pub const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous(at_cranks(2.0)),
    Coulomb { torque: at_cranks(8.0), width: Width::f32(0.05) },
    Armature(at_cranks(PickDelta::GEAR * PickDelta::RATIO * PickDelta::RATIO)),
);

const fn at_cranks(number: f32) -> [f32; 12] {
    let mut all = [0.0; 12];
    let [a, b, c] = PickDelta::MOTORS;
    all[a] = number;
    all[b] = number;
    all[c] = number;
    all
}

/// The cranks' angles at the feeder, where the picks begin and end.
fn start() -> [f32; 3] {
    cranks(&State::at(FEEDER)).q
}

#[derive(Clone, Copy, Debug)]
pub struct Picking;

impl Scene<12, 12, 12, 3> for Picking {
    type Robot = PickDelta;
    type Effects = Effects;
    type Reference = Picks;
    type Environment = ();
    type Plant = ClusterPlant<PickDelta, Effects, 12, 12, 3>;

    const NAME: &'static str = "delta_pick";
    const BOUND: f32 = 1e-3;
    const EFFECTS: Effects = EFFECTS;
    /// A step takes 40,000 instructions, and the emulated processor executes 125,000 in a tick.
    const STEPS: u32 = 2;
    const GAIN_POSE_NAME: &'static str = "feeder";
    const LIMITS: [JointLimits<f32>; 3] = limits_of(&PickDelta::MODEL, PickDelta::MOTORS);

    fn reference() -> Result<Picks, TrajectoryError> {
        Picks::new()
    }

    fn environment(_: &Picks, _: f32) {}

    fn inverse<E: Effect<f32, 12, 12>>(
        reference: &State<f32, 3, 3>,
        (): &(),
        effects: &E,
    ) -> [f32; 3] {
        clustered::inverse::<PickDelta, E, 12, 12, 3>(reference, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        clustered::plant::<Self, 12, 12, 3>(
            start(),
            noise,
            |(_, _, _, viscous, coulomb, _), noise| {
                noise.friction(&mut viscous.0);
                noise.friction(&mut coulomb.torque);
            },
        )
    }

    fn inertia((): &()) -> [f32; 3] {
        clustered::inertia::<Self, 12, 12, 3>(start()).unwrap_or([0.0; 3])
    }
}
