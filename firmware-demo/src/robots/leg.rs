//! A leg on a vertical rail.

use dynamics_core::model::{BASE, Body, Joint, Model, Robot, attach_to};
use dynamics_core::robots::A1;

/// The front right leg of a Unitree A1 on a carriage that glides up and down a rail: a slide
/// without a drive, then hip, thigh and calf, and the foot on a fixed joint.
///
/// The leg's numbers are those of [`A1::LEG`]; the carriage weighs a quarter of that robot's trunk.
/// The base frame stands on the floor: z up, the carriage's origin at the height of its position.
#[derive(Clone, Copy, Debug, Default)]
pub struct Leg;

impl Leg {
    /// The foot's place in the list of bodies.
    pub const FOOT: usize = 4;
    /// The foot is a ball, m.
    pub const FOOT_RADIUS: f32 = 0.02;
    /// Thigh and calf are equally long, m.
    pub const LIMB: f32 = 0.2;
}

const CARRIAGE: Body = Body::new("carriage", BASE, Joint::prismatic([0.0, 0.0, 1.0])).mass(1.5);

impl Robot<5, 4, 4> for Leg {
    const MODEL: Model<f64, 5, 4, 4> = Model::new("leg", attach_to(CARRIAGE, &A1::LEG));
}

const _: Model<f64, 5, 4, 4> = Leg::MODEL;
