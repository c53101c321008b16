//! Scene `gimbal_ship`: a camera on a rolling ship sweeps the horizon, the ship's motion as
//! feed-forward.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Coriolis, Coulomb, Effect, GravityVector, Inertia, MovingBase, Viscous, Width,
};
use dynamics_core::spatial::Motion;
use dynamics_core::state::State;
use glam::Vec3;
use motion_control::reference::TrajectoryError;

use crate::plant::Plant;
use crate::robots::ship::Swing;
use crate::robots::{Gimbal, Ship};
use crate::scene::{Noise, Scene, TICK, rigid};
use crate::trajectories::watch::Watch;

/// The effects on the gimbal; gravity and the base's motion come from the ship's inertial unit.
pub type Effects =
    (GravityVector<f32>, MovingBase<f32>, Inertia, Coriolis, Viscous<f32, 3>, Coulomb<f32, 3>);

/// On a ship at rest; friction is that of bearings and seals of this size.
pub const EFFECTS: Effects = (
    GravityVector(Vec3::new(0.0, 0.0, -9.81)),
    MovingBase {
        velocity: Motion { ang: Vec3::ZERO, lin: Vec3::ZERO },
        acceleration: Motion { ang: Vec3::ZERO, lin: Vec3::ZERO },
    },
    Inertia,
    Coriolis,
    Viscous([1.2, 1.2, 0.6]),
    Coulomb { torque: [0.8, 0.8, 0.5], width: Width::f32(0.05) },
);

#[derive(Clone, Copy, Debug)]
pub struct OnWatch;

impl Scene<3, 3, 3, 3> for OnWatch {
    type Robot = Gimbal;
    type Effects = Effects;
    type Reference = Watch<f32>;
    type Environment = (GravityVector<f32>, MovingBase<f32>);
    type Plant = Plant<Gimbal, Effects, Self::Environment, 3, 3, 3>;

    const NAME: &'static str = "gimbal_ship";
    const BOUND: f32 = 5e-4;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 3] = [0.0; 3];
    const GAIN_POSE_NAME: &'static str = "level";

    fn reference() -> Result<Self::Reference, TrajectoryError> {
        Ok(Watch { ship: Ship::patrol_boat(), sweep: Swing::of(1.0, 8.0), ticks: 12_000 })
    }

    fn environment(watch: &Self::Reference, ticks: f32) -> Self::Environment {
        watch.ship.measured(ticks * TICK)
    }

    fn apply(effects: &mut Effects, &(gravity, base): &Self::Environment) {
        effects.0 = gravity;
        effects.1 = base;
    }

    fn inverse<E: Effect<f32, 3, 3>>(
        reference: &State<f32, 3, 3>,
        _: &Self::Environment,
        effects: &E,
    ) -> [f32; 3] {
        Engine::<Gimbal>::rnea(reference, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        let start = Self::reference().map_or([0.0; 3], |watch| watch.after(0.0).q);
        rigid::<Self, 3, 3, 3, 3>(start, noise, |(.., viscous, coulomb), noise| {
            noise.friction(&mut viscous.0);
            noise.friction(&mut coulomb.torque);
        })
    }
}
