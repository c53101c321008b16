use dynamics_core::Engine;
use dynamics_core::control::ZeroOrderHold;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;

/// Torques of a motion, tick by tick.
pub struct Torques {
    between: ZeroOrderHold<f32, 6>,
    wait: usize,
}

impl Torques {
    /// Before the first tick, which will be that of this state.
    pub fn start(_first: &State<f32, 6, 6>) -> Self {
        Self {
            between: ZeroOrderHold::start(),
            wait: 0,
        }
    }

    /// Torques of this tick, N·m.
    #[inline(never)]
    pub fn tick(&mut self, state: &State<f32, 6, 6>) -> [f32; 6] {
        if self.wait > 0 {
            self.wait -= 1;
            return self.between.hold();
        }
        self.wait = 10 - 1;
        self.between.update(Engine::<Ur5e>::rnea(state, &RIGID_BODY))
    }
}
