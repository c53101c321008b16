use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Model, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;

/// The robot with lengths, masses and inertias of 8 bits.
pub struct Rounded;

impl Robot<6, 6, 6> for Rounded {
    const MODEL: Model<f64, 6, 6, 6> = Ur5e::MODEL.rounded(8);
}

/// Torques of a motion, N·m.
#[inline]
pub fn torques(state: &State<f32, 6, 6>) -> [f32; 6] {
    Engine::<Rounded>::rnea(state, &RIGID_BODY)
}
