use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::A1Leg;
use dynamics_core::state::State;
use dynamics_core::trig::Minimax;

/// Torques of a motion, N·m.
#[inline]
pub fn torques(state: &State<f32, 3, 3>) -> [f32; 3] {
    Engine::<A1Leg, Minimax<7, 2>>::rnea(state, &RIGID_BODY)
}
