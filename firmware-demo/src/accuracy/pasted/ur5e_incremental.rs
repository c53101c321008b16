use dynamics_core::Engine;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::state::Carried;

/// Torques of a motion, tick by tick.
pub struct Torques {
    carried: Carried<f32, 6>,
}

impl Torques {
    /// Before the first tick, which will be that of this state.
    pub fn start(first: &State<f32, 6, 6>) -> Self {
        Self {
            carried: Carried::at(first.q),
        }
    }

    /// Torques of this tick, N·m.
    #[inline(never)]
    pub fn tick(&mut self, state: &State<f32, 6, 6>) -> [f32; 6] {
        Engine::<Ur5e>::rnea(self.carried.follow(&state.q).with(state), &RIGID_BODY)
    }
}
