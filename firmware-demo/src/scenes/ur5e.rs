//! Scene `ur5e`: pick and place, with the arm's full model as feed-forward.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, Viscous, Width,
};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use motion_control::reference::{Trajectory, TrajectoryError};

use crate::plant::Plant;
use crate::scene::{Noise, PlantModel, Run, Scene, TICK, rigid, speeds};
use crate::trajectories::{HOME, PICK_AND_PLACE};
use joint_drivers::Law;

pub type Effects = (Gravity, Inertia, Coriolis, Viscous<f32, 6>, Coulomb<f32, 6>, Armature<f32, 6>);

/// Friction and rotors are assumed, of the order that identifications of this arm's size find: the
/// maker publishes neither.
pub const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]),
    Coulomb { torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2], width: Width::f32(0.05) },
    Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
);

#[derive(Clone, Copy, Debug)]
pub struct PickAndPlace;

impl Scene<6, 6, 6, 6> for PickAndPlace {
    type Robot = Ur5e;
    type Effects = Effects;
    type Reference = Trajectory<f32, 6, 9>;
    type Environment = ();
    type Plant = Plant<Ur5e, Effects, (), 6, 6, 6>;

    const NAME: &'static str = "ur5e";
    const BOUND: f32 = 1e-3;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 6] = HOME;
    const GAIN_POSE_NAME: &'static str = "home";
    const BASELINES: &'static [Run<Self, 6, 6, 6, 6>] = &[
        Run::of::<GravityOnly>(PlantModel::Exact, "gravity"),
        Run::of::<GravityOnly>(PlantModel::Mismatched, "gravity"),
    ];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        let mut path = Trajectory::REST;
        plan(&mut path)?;
        Ok(path)
    }

    fn environment(_: &Self::Reference, _: f32) {}

    fn inverse<E: Effect<f32, 6, 6>>(
        reference: &State<f32, 6, 6>,
        (): &(),
        effects: &E,
    ) -> [f32; 6] {
        Engine::<Ur5e>::rnea(reference, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        rigid::<Self, 6, 6, 6, 6>(HOME, noise, |(.., viscous, coulomb, _), noise| {
            noise.friction(&mut viscous.0);
            noise.friction(&mut coulomb.torque);
        })
    }
}

/// Plans the path of the scene in its place, which takes less stack than [`Scene::reference`].
///
/// # Errors
/// As [`Scene::reference`].
pub fn plan(path: &mut Trajectory<f32, 6, 9>) -> Result<(), TrajectoryError> {
    let limits = speeds(&PickAndPlace::LIMITS, [12.0; 6]);
    path.plan(&PICK_AND_PLACE, TICK, &limits)
}

#[derive(Clone, Copy, Debug)]
pub struct GravityOnly;

impl Law<6> for GravityOnly {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        Engine::<Ur5e>::rnea(reference, &Gravity::EARTH)
    }
}
