//! A UR5e that a wall or a hand touches, and how it differs from its model.

use dynamics_core::algorithms::{frame, kinematics};
use dynamics_core::control::ContactResponse;
use dynamics_core::effects::{Armature, Coulomb, Effect, Viscous, Width, hook};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use glam::DVec3;

pub type Q = [f64; 6];
pub const TIP: usize = 5;
/// Of the tip at the contact, m/s.
pub const SPEED: f64 = 0.25;
/// Those of ISO/TS 15066 for a hand and for the chest, N/m.
pub const STIFFNESSES: [f64; 2] = [75e3, 10e3];

pub const ROTORS: Armature<f64, 6> = Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]);
pub type Friction = (Viscous<f64, 6>, Coulomb<f64, 6>);

/// The friction of the scene `ur5e`, times a share.
pub fn friction(share: f64) -> Friction {
    let viscous = [12.0, 12.0, 8.0, 2.0, 2.0, 1.5].map(|d| share * d);
    let torque = [8.0, 8.0, 6.0, 1.5, 1.5, 1.2].map(|f| share * f);
    let width = Width::new(0.05);
    (Viscous(viscous), Coulomb { torque, width })
}

const HOME: Q = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
/// From where to where the arm moves: the first motion of the pick and place, and one downward.
pub const MOTIONS: [[Q; 2]; 2] = [
    [HOME, [-0.70, -1.35, 1.75, -1.97, -1.57, -0.70]],
    [HOME, [0.10, -1.20, 2.00, -2.37, -1.57, 0.10]],
];

/// An elastic wall, the plane through `origin` whose `normal` points into it, and a hand.
#[derive(Clone, Copy)]
pub struct Wall {
    pub origin: DVec3,
    pub normal: DVec3,
    pub stiffness: f64,
    /// The share of its force for each m/s into it, s/m (Hunt & Crossley, 1975).
    pub loss: f64,
    /// The force of a hand on the tip, N.
    pub hand: DVec3,
}

impl Wall {
    /// What the tip exerts on it, N.
    pub fn force(&self, [place, velocity]: [DVec3; 2]) -> f64 {
        let depth = (place - self.origin).dot(self.normal);
        let share = 1.0 + self.loss * velocity.dot(self.normal);
        self.stiffness * depth.max(0.0) * share.max(0.0)
    }
}

impl<const B: usize, const V: usize> Effect<f64, B, V> for Wall {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
        hook::Wrench::of_state(|wall, body, at, fx| {
            if body == TIP {
                let velocity = at.pose.rot.transpose() * at.velocity.lin;
                let back = wall.normal * wall.force([at.pose.pos, velocity]);
                fx.lin += at.pose.rot * (wall.hand - back);
            }
        });
}

/// How the arm differs from its model: the shares of every other body's inertia (the others: the opposite) and of friction.
#[derive(Clone, Copy, Debug)]
pub struct Off {
    pub bodies: f64,
    pub friction: f64,
}

impl Off {
    pub const fn new(bodies: f64, friction: f64) -> Self {
        Self { bodies, friction }
    }
}

/// The arm with every other body heavier by a share, and the others lighter.
pub fn arm(off: f64) -> ArmModel<f64, 6> {
    let mut arm = Ur5e::MODEL;
    for (i, link) in arm.links.iter_mut().enumerate() {
        let share = if i % 2 == 0 { 1.0 + off } else { 1.0 - off };
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

/// A run.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    pub motion: [Q; 2],
    pub stiffness: f64,
    pub loss: f64,
    pub off: Off,
    /// None: the arm follows its motion into the wall.
    pub response: Option<ContactResponse<f64>>,
    /// The share of friction that the law compensates in an arm that floats.
    pub share: f64,
}

impl Setup {
    /// Without a wall, a reaction, and errors of the model.
    pub const FREE: Self = Self {
        motion: MOTIONS[0],
        stiffness: 0.0,
        loss: 0.0,
        off: Off::new(0.0, 0.0),
        response: None,
        share: 0.6,
    };
}
