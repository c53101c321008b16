//! A UR5e with the friction of bristles, and the hand that moves it.

use dynamics_core::algorithms::{frame, kinematics};
use dynamics_core::effects::{Armature, Coulomb, Effect, Lugre, Viscous, Width, hook};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use glam::DVec3;

pub type Q = [f64; 6];
pub const TIP: usize = 5;
pub const ROTORS: Armature<f64, 6> = Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]);

/// That of the scene `ur5e`, N·m·s/rad and N·m.
pub const VISCOUS: Q = [12.0, 12.0, 8.0, 2.0, 2.0, 1.5];
pub const SLIDING: Q = [8.0, 8.0, 6.0, 1.5, 1.5, 1.2];
/// Stiction exceeds sliding friction by this share of it.
const EXCESS: f64 = 0.15;

/// The model of the friction, with a smooth sign, times a share.
pub fn modelled(share: f64) -> (Viscous<f64, 6>, Coulomb<f64, 6>) {
    let torque = SLIDING.map(|f| share * f);
    let width = Width::new(0.002);
    (
        Viscous(VISCOUS.map(|d| share * d)),
        Coulomb { torque, width },
    )
}

/// The friction of the arm: bristles, stiction, and Stribeck's effect.
pub fn real() -> Lugre<f64, 6> {
    Lugre {
        stiffness: SLIDING.map(|f| f / 1e-4), // bristles slide from 10⁻⁴ rad on
        damping: SLIDING.map(|f| 30.0 * f),
        viscous: VISCOUS,
        sliding: SLIDING,
        excess: SLIDING.map(|f| EXCESS * f),
        stribeck_speed: Width::new(0.01),
        bristle: [0.0; 6],
    }
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
    let mut arm = Ur5e::MODEL;
    for (i, link) in arm.links.iter_mut().enumerate() {
        let share = match off {
            Inertias::All(off) => 1.0 + off,
            Inertias::Alternating(off) => 1.0 + if i % 2 == 0 { off } else { -off },
        };
        link.inertia.mass *= share;
        link.inertia.first_moment *= share;
        link.inertia.rotational *= share;
    }
    arm
}

/// The place and the velocity of the tip.
pub fn tip(state: &State<f64, 6, 6>) -> [DVec3; 2] {
    let k = kinematics(&Ur5e::MODEL, state, &());
    let v = k.velocity(TIP, frame::LocalWorldAligned);
    [k.poses[TIP].pos, v.lin]
}

/// A hand at the tip.
#[derive(Clone, Copy, Debug)]
pub enum Hand {
    Away,
    /// It pushes, N.
    Push(DVec3),
    /// It leads the tip: place and velocity, by a spring and a damper.
    Lead(DVec3, DVec3),
}

impl Hand {
    /// What it exerts on the tip, N.
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
