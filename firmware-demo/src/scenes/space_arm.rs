//! Scene `space_arm`: an arm on a satellite that floats free reaches out; what the satellite gives
//! way is in the feed-forward. The plant's step conserves momentum, down to rounding: it does not
//! drift.

use dynamics_core::Engine;
use dynamics_core::effects::{Armature, Coriolis, Coulomb, Effect, Inertia, Viscous, Width};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};

use crate::plant::{Floating, last};
use crate::robots::SpaceArm;
use crate::scene::{Noise, PlantModel, Run, Scene, rigid, through};
use crate::trajectories::{STOWED, stop};
use joint_drivers::Law;

/// The space arm reaches out for something that drifts by, pulls it in, and folds.
const REACH_OUT: [WayPoint<f32, 6>; 6] = [
    stop(STOWED, 0),
    stop([0.7, -0.9, 1.3, -0.4, 0.0, 0.8], 1800),
    stop([1.0, -0.3, 0.7, -0.4, 0.4, 1.2], 1400),
    stop([1.0, -0.9, 1.7, -0.8, 0.4, 1.2], 1400),
    stop([-0.9, -1.0, 1.9, -0.9, -0.3, -0.6], 2600),
    stop(STOWED, 2000),
];

/// The effects on the joints; none acts on the satellite.
pub type Effects = (Inertia, Coriolis, Viscous<f32, 12>, Coulomb<f32, 12>, Armature<f32, 12>);

/// Friction and rotors of strain-wave gears in cold grease.
pub const EFFECTS: Effects = (
    Inertia,
    Coriolis,
    Viscous(SpaceArm::joints([9.0, 9.0, 7.0, 1.5, 1.5, 1.2])),
    Coulomb { torque: SpaceArm::joints([3.0, 3.0, 2.5, 0.8, 0.8, 0.6]), width: Width::f32(0.05) },
    Armature(SpaceArm::joints([1.0, 1.0, 0.8, 0.15, 0.15, 0.12])),
);

#[derive(Clone, Copy, Debug)]
pub struct ReachOut;

impl Scene<7, 13, 12, 6> for ReachOut {
    type Robot = SpaceArm;
    type Effects = Effects;
    type Reference = Trajectory<f32, 6, 6>;
    type Environment = ();
    type Plant = Floating<SpaceArm, Effects, (), 7, 13, 12>;

    const NAME: &'static str = "space_arm";
    const BOUND: f32 = 5e-4;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 13] = SpaceArm::at(STOWED);
    const GAIN_POSE_NAME: &'static str = "stowed";
    const BASELINES: &'static [Run<Self, 7, 13, 12, 6>] = &[
        Run::of::<FixedBase>(PlantModel::Exact, "fixed-base"),
        Run::of::<FixedBase>(PlantModel::Mismatched, "fixed-base"),
    ];
    /// Nothing moves without `Inertia`.
    const ABLATIONS: &'static [Run<Self, 7, 13, 12, 6>] =
        &[Run::without::<1>(), Run::without::<2>(), Run::without::<3>(), Run::without::<4>()];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        through(&REACH_OUT, &Self::LIMITS, [3.0; 6])
    }

    fn environment(_: &Self::Reference, _: f32) {}

    /// The satellite is left to itself: it recoils from the joints' rates, since all momentum is
    /// zero, and from their accelerations, since nothing holds it.
    fn inverse<E: Effect<f32, 7, 12>>(
        reference: &State<f32, 6, 6>,
        (): &(),
        effects: &E,
    ) -> [f32; 6] {
        let state = SpaceArm::floating(reference);
        let trig = Engine::<SpaceArm>::joint_trig(&state.q);
        let rates = if E::VELOCITY_PRODUCTS {
            Engine::<SpaceArm>::base_velocity_from_momentum(trig.with(&state), Force::ZERO, &())
        } else {
            Ok(state.qd)
        };
        rates
            .and_then(|qd| {
                let state = State { qd, ..state };
                Engine::<SpaceArm>::free_base_inverse_dynamics(trig.with(&state), effects)
            })
            // Only what is not a number has no solution: the gate stops it.
            .map_or([f32::NAN; 6], |response| last(&response.tau))
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        Floating(rigid::<Self, 7, 13, 12, 6>(
            SpaceArm::at(STOWED),
            noise,
            |(.., viscous, coulomb, _), noise| {
                noise.friction(&mut viscous.0);
                noise.friction(&mut coulomb.torque);
            },
        ))
    }
}

/// Feed-forward that takes the satellite for a wall.
#[derive(Clone, Copy, Debug)]
pub struct FixedBase;

impl Law<6> for FixedBase {
    fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        last(&Engine::<SpaceArm>::rnea(&SpaceArm::floating(reference), &EFFECTS))
    }
}
