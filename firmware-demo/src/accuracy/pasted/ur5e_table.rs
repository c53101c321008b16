use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::trig::Table;

/// Torques of a motion, N·m.
#[inline]
pub fn torques(state: &State<f32, 6, 6>) -> [f32; 6] {
    Engine::<Ur5e, Table<256, 1>>::rnea(state, &RIGID_BODY)
}
