//! A UR5e with the friction of bristles, and the hand that moves it.

use dynamics_core::effects::{Armature, Coulomb, Effect, Lugre, Viscous, Width, hook};
use dynamics_core::model::ArmModel;
use glam::DVec3;
use simulation_tests::plant;

pub use simulation_tests::plant::{SLIDING, TIP, tip};

pub type Q = [f64; 6];
pub const ROTORS: Armature<f64, 6> = Armature(plant::ROTORS);

/// The model of the friction, with a smooth sign, times a share.
pub fn modelled(share: f64) -> (Viscous<f64, 6>, Coulomb<f64, 6>) {
    plant::coulomb([share; 6], Width::new(0.002))
}

/// The friction of the arm: bristles, stiction, and Stribeck's effect.
pub fn real() -> Lugre<f64, 6> {
    plant::bristles([1.0; 6])
}

/// The errors of the arm's inertias.
#[derive(Clone, Copy, Debug)]
pub enum Inertias {
    /// All bodies are heavier by a share.
    All(f64),
    /// Every other body is heavier by a share, and the others are lighter.
    Alternating(f64),
}

pub fn arm(off: Inertias) -> ArmModel<f64, 6> {
    plant::arm(match off {
        Inertias::All(off) => [1.0 + off; 6],
        Inertias::Alternating(off) => plant::alternating(off),
    })
}

#[derive(Clone, Copy, Debug)]
pub enum Hand {
    Away,
    /// It pushes, N.
    Push(DVec3),
    /// It leads the tip: place and velocity, by a spring and a damper.
    Lead(DVec3, DVec3),
}

impl Hand {
    /// The force of the hand on the tip, N.
    pub fn force(&self, [place, velocity]: [DVec3; 2]) -> DVec3 {
        match *self {
            Self::Away => DVec3::ZERO,
            Self::Push(force) => force,
            Self::Lead(goal, speed) => 2e4 * (goal - place) + 200.0 * (speed - velocity),
        }
    }
}

impl<const B: usize, const V: usize> Effect<f64, B, V> for Hand {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
        hook::Wrench::of_state(|hand, body, at, fx| {
            if body == TIP {
                let velocity = at.pose.rot.transpose() * at.velocity.lin;
                fx.lin += at.pose.rot * hand.force([at.pose.pos, velocity]);
            }
        });
}
