//! Scene `scara_table`: three vertical axes serve a table at the speeds of a packing line. Gravity
//! does no work there, so that the scene does not name it.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, GravityVector, Inertia, Viscous, Width,
};
use dynamics_core::state::State;
use glam::Vec3;
use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};

use crate::plant::Plant;
use crate::robots::Scara;
use crate::scene::{Noise, PlantModel, Run, Scene, rigid, through};
use crate::trajectories::{pass, stop};
use joint_drivers::Law;

/// The start and end of the SCARA's motion, rad.
const ASIDE: [f32; 3] = [-0.9, 1.6, -0.7];

/// The SCARA serves a table: from a feeder to two places and back, at rest there for a grip.
const SCARA_SERVES: [WayPoint<f32, 3>; 10] = [
    stop(ASIDE, 0),
    stop([-0.4, 0.7, 0.9], 360),
    stop([-0.4, 0.7, 0.9], 80),
    stop([0.5, 1.6, -0.9], 400),
    stop([0.5, 1.6, -0.9], 80),
    stop([-0.4, 0.7, 0.9], 400),
    stop([-0.4, 0.7, 0.9], 80),
    pass([0.2, -0.1, 0.3], [2.2, -3.0, -2.5], 240),
    stop([0.6, -0.7, 0.0], 280),
    stop(ASIDE, 640),
];

pub type Effects = (Inertia, Coriolis, Viscous<f32, 3>, Coulomb<f32, 3>, Armature<f32, 3>);

/// Assumed, of the order of servo motors behind harmonic drives of 50 : 1 and a belt of 15 : 1.
pub const EFFECTS: Effects = (
    Inertia,
    Coriolis,
    Viscous([3.0, 1.5, 0.05]),
    Coulomb { torque: [8.0, 4.0, 0.4], width: Width::f32(0.05) },
    Armature([0.25, 0.08, 0.002]),
);

#[derive(Clone, Copy, Debug)]
pub struct Serve;

impl Scene<3, 3, 3, 3> for Serve {
    type Robot = Scara;
    type Effects = Effects;
    type Reference = Trajectory<f32, 3, 10>;
    type Environment = ();
    type Plant = Plant<Scara, Effects, (), 3, 3, 3>;

    const NAME: &'static str = "scara_table";
    const BOUND: f32 = 2e-3;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 3] = ASIDE;
    const GAIN_POSE_NAME: &'static str = "aside";
    const BASELINES: &'static [Run<Self, 3, 3, 3, 3>] = &[
        Run::of::<WithGravity>(PlantModel::Exact, "with-gravity"),
        Run::of::<WithGravityAlong>(PlantModel::Exact, "with-gravity-of-run-time"),
    ];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        through(&SCARA_SERVES, &Self::LIMITS, [60.0, 120.0, 250.0])
    }

    fn environment(_: &Self::Reference, _: f32) {}

    fn inverse<E: Effect<f32, 3, 3>>(
        reference: &State<f32, 3, 3>,
        (): &(),
        effects: &E,
    ) -> [f32; 3] {
        Engine::<Scara>::rnea(reference, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        rigid::<Self, 3, 3, 3, 3>(ASIDE, noise, |(.., viscous, coulomb, _), noise| {
            noise.friction(&mut viscous.0);
            noise.friction(&mut coulomb.torque);
        })
    }
}

/// Feed-forward by a scene that names gravity too: its type says along which axis, and the compiler
/// finds that none of it reaches a torque. The code is the same.
#[derive(Clone, Copy, Debug)]
pub struct WithGravity;

impl Law<3> for WithGravity {
    fn feedforward(reference: &State<f32, 3, 3>, (): &()) -> [f32; 3] {
        Engine::<Scara>::rnea(reference, &(Gravity::EARTH, EFFECTS))
    }
}

/// The same of a direction known at run time only: computed each tick, to add nothing.
#[derive(Clone, Copy, Debug)]
pub struct WithGravityAlong;

impl Law<3> for WithGravityAlong {
    fn feedforward(reference: &State<f32, 3, 3>, (): &()) -> [f32; 3] {
        let down = GravityVector(core::hint::black_box(Vec3::NEG_Z * 9.81));
        Engine::<Scara>::rnea(reference, &(down, EFFECTS))
    }
}
