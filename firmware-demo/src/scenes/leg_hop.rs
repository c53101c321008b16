//! Scene `leg_hop`: a leg hops on a rail, and the feed-forward knows the ground.

use dynamics_core::Engine;
use dynamics_core::effects::{
    Armature, Contact, ContactPoint, Coriolis, Effect, Gravity, Inertia, Viscous, Width,
};
use dynamics_core::state::State;
use glam::Vec3;
use motion_control::reference::TrajectoryError;

use crate::plant::{Plant, last};
use crate::robots::Leg;
use crate::scene::{Noise, Scene, rigid};
use crate::trajectories::hop::{ElasticReference, Hop};

pub type Effects = (Gravity, Inertia, Coriolis, Viscous<f32, 4>, Armature<f32, 4>, Contact<f32, 1>);

/// A rubber mat; its numbers are assumed. The ball's centre comes as near as its radius.
pub const GROUND: Contact<f32, 1> = Contact {
    points: [ContactPoint { body: Leg::FOOT, point: Vec3::ZERO }],
    normal: Vec3::Z,
    height: Leg::FOOT_RADIUS,
    stiffness: 3e4,
    damping: 100.0,
    damping_depth: Width::f32(1e-4),
    friction: 0.6,
    slip_tolerance: 0.2,
};

/// Friction and rotors are assumed, of the order of quasi-direct drives of this size; the rail has
/// neither.
const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous([0.0, 0.1, 0.1, 0.1]),
    Armature([0.0, 0.01, 0.01, 0.01]),
    GROUND,
);

/// Four hops of 77 mm.
pub const COURSE: ElasticReference =
    ElasticReference { rise: 140, flight: 250, stance: 250, knee: 0.68, clearance: 0.09 };

fn hop() -> Hop {
    Hop::new(&COURSE, &GROUND, 9.81)
}

#[derive(Clone, Copy, Debug)]
pub struct Hopping;

impl Scene<5, 4, 4, 3> for Hopping {
    type Robot = Leg;
    type Effects = Effects;
    type Reference = Hop;
    /// The reference of the carriage, m, m/s and m/s².
    type Environment = State<f32, 1, 1>;
    type Plant = Plant<Leg, Effects, Self::Environment, 5, 4, 4>;

    const NAME: &'static str = "leg_hop";
    const BOUND: f32 = 0.02;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 4] = [0.3, 0.0, 0.8, -1.6];
    const GAIN_POSE_NAME: &'static str = "mid-stance";

    fn reference() -> Result<Hop, TrajectoryError> {
        Ok(hop())
    }

    fn environment(reference: &Hop, ticks: f32) -> Self::Environment {
        let whole = reference.whole(ticks as u32);
        State { q: [whole.q[0]], qd: [whole.qd[0]], qdd: [whole.qdd[0]] }
    }

    fn inverse<E: Effect<f32, 5, 4>>(
        leg: &State<f32, 3, 3>,
        rail: &Self::Environment,
        effects: &E,
    ) -> [f32; 3] {
        let on = |[rail]: [f32; 1], [hip, thigh, calf]: [f32; 3]| [rail, hip, thigh, calf];
        let whole =
            State { q: on(rail.q, leg.q), qd: on(rail.qd, leg.qd), qdd: on(rail.qdd, leg.qdd) };
        last(&Engine::<Leg>::rnea(&whole, effects))
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        let start = hop().whole(0);
        rigid::<Self, 5, 4, 4, 3>(start.q, noise, |(_, _, _, viscous, ..), noise| {
            noise.friction(&mut viscous.0);
        })
    }
}
