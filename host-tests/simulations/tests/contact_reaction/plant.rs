//! A UR5e that a wall or a hand touches, and how it differs from its model.

use dynamics_core::effects::{Armature, Coulomb, Viscous, Width};
use dynamics_core::model::ArmModel;
use motion_control::motion::ContactResponse;
use simulation_tests::plant;

pub use simulation_tests::plant::{TIP, tip};

pub type Q = [f64; 6];
/// Speed of the tip at the contact, m/s.
pub const SPEED: f64 = 0.25;
/// Those of ISO/TS 15066 for a hand and for the chest, N/m.
pub const STIFFNESSES: [f64; 2] = [75e3, 10e3];

pub const ROTORS: Armature<f64, 6> = Armature(plant::ROTORS);
pub type Friction = (Viscous<f64, 6>, Coulomb<f64, 6>);
pub type Wall = plant::Wall<f64>;

/// The friction of the scene `ur5e`, times a share.
pub fn friction(share: f64) -> Friction {
    plant::coulomb([share; 6], Width::new(0.05))
}

const HOME: Q = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
/// From where to where the arm moves: the first motion of the pick and place, and one downward.
pub const MOTIONS: [[Q; 2]; 2] = [
    [HOME, [-0.70, -1.35, 1.75, -1.97, -1.57, -0.70]],
    [HOME, [0.10, -1.20, 2.00, -2.37, -1.57, 0.10]],
];

/// The arm's deviation from its model: the shares of every other body's inertia (opposite for the
/// others) and of friction.
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
    plant::arm(plant::alternating(off))
}

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
