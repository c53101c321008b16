//! Scene `direct_drive`: low gear ratios, where rotors are gyroscopes and not only inertia at their
//! joints.

use core::f32::consts::FRAC_PI_4;

use dynamics_core::effects::{
    Armature, Coriolis, Effect, Gravity, GyroscopicRotors, Inertia, Viscous,
};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};

use crate::plant::Plant;
use crate::robots::DirectDrive;
use crate::scene::{Noise, PlantModel, Run, Scene, rigid, through};
use joint_drivers::Law;

pub type Effects = (Gravity, Inertia, Coriolis, Viscous<f32, 3>, GyroscopicRotors<f32, 3>);

/// A ring motor drives the turret directly, pancake motors the others.
const ROTORS: GyroscopicRotors<f32, 3> =
    GyroscopicRotors { inertia: [12e-3, 2.5e-3, 8e-4], ratio: [1.0, 3.0, 6.0] };

const EFFECTS: Effects = (Gravity::EARTH, Inertia, Coriolis, Viscous([0.08, 0.1, 0.05]), ROTORS);

/// The effects with the rotors as armature inertia at their joints: ρ² I.
const DIAGONAL: (Gravity, Inertia, Coriolis, Viscous<f32, 3>, Armature<f32, 3>) = {
    let (gravity, inertia, coriolis, viscous, GyroscopicRotors { inertia: i, ratio: r }) = EFFECTS;
    let armature = Armature([i[0] * r[0] * r[0], i[1] * r[1] * r[1], i[2] * r[2] * r[2]]);
    (gravity, inertia, coriolis, viscous, armature)
};

const START: [f32; 3] = [0.0, FRAC_PI_4, 0.0];

/// Turret and roll go to and fro at once, the shoulder at twice the pace.
const WAY: [WayPoint<f32, 3>; 8] = {
    const fn point(q: [f32; 3], qd: [f32; 3], ticks: u32) -> WayPoint<f32, 3> {
        WayPoint { q, qd, ticks }
    }
    [
        point(START, [0.0; 3], 0),
        point([1.0, -0.3, 2.5], [4.5, 0.0, 12.0], 350),
        point([2.2, 0.5, 5.5], [0.0, 4.0, 0.0], 350),
        point([1.0, 0.9, 2.5], [-4.5, 0.0, -12.0], 350),
        point([-1.0, -0.3, -2.5], [-4.5, -4.0, -12.0], 420),
        point([-2.2, -0.8, -5.5], [0.0, 0.0, 0.0], 350),
        point([-1.0, 0.2, -2.5], [4.5, 4.0, 12.0], 350),
        point(START, [0.0; 3], 400),
    ]
};

#[derive(Clone, Copy, Debug)]
pub struct FastArm;

impl Scene<3, 3, 3, 3> for FastArm {
    type Robot = DirectDrive;
    type Effects = Effects;
    type Reference = Trajectory<f32, 3, 8>;
    type Environment = ();
    type Plant = Plant<DirectDrive, Effects, (), 3, 3, 3>;

    const NAME: &'static str = "direct_drive";
    const BOUND: f32 = 1e-3;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 3] = START;
    const GAIN_POSE_NAME: &'static str = "start";
    const BASELINES: &'static [Run<Self, 3, 3, 3, 3>] = &[
        Run::of::<Diagonal>(PlantModel::Exact, "diagonal"),
        Run::of::<DiagonalEngine>(PlantModel::Exact, "diagonal-engine"),
        Run::of::<Diagonal>(PlantModel::Mismatched, "diagonal"),
    ];

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        through(&WAY, &Self::LIMITS, [150.0; 3])
    }

    fn environment(_: &Self::Reference, _: f32) {}

    fn inverse<E: Effect<f32, 3, 3>>(
        reference: &State<f32, 3, 3>,
        (): &(),
        effects: &E,
    ) -> [f32; 3] {
        Core::<DirectDrive>::rnea(reference, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        rigid::<Self, 3, 3, 3, 3>(START, noise, |(_, _, _, viscous, _), noise| {
            noise.friction(&mut viscous.0);
        })
    }
}

/// Feed-forward by the approximation, in the core.
#[derive(Clone, Copy, Debug)]
pub struct Diagonal;

impl Law<3> for Diagonal {
    fn feedforward(reference: &State<f32, 3, 3>, (): &()) -> [f32; 3] {
        Core::<DirectDrive>::rnea(reference, &DIAGONAL)
    }
}

/// The same in the engine, which has no rotors that spin.
#[derive(Clone, Copy, Debug)]
pub struct DiagonalEngine;

impl Law<3> for DiagonalEngine {
    fn feedforward(reference: &State<f32, 3, 3>, (): &()) -> [f32; 3] {
        Engine::<DirectDrive>::rnea(reference, &DIAGONAL)
    }
}
