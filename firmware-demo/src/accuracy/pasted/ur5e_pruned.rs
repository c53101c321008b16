use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Pruned;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;

/// Torques of a motion, N·m.
#[inline]
pub fn torques(state: &State<f32, 6, 6>) -> [f32; 6] {
    Engine::<Pruned<Ur5e, 1000>>::rnea(state, &RIGID_BODY)
}
