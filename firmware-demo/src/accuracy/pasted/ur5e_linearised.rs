use dynamics_core::Engine;
use dynamics_core::control::InertiaUpdate;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::trig::Table;

/// Torques of a motion, tick by tick.
pub struct Torques {
    between: InertiaUpdate<f32, 6, 10>,
    wait: usize,
}

impl Torques {
    /// Before the first tick, which will be that of this state.
    pub fn start(_first: &State<f32, 6, 6>) -> Self {
        Self {
            between: InertiaUpdate::start(),
            wait: 0,
        }
    }

    /// Torques of this tick, N·m.
    #[inline(never)]
    pub fn tick(&mut self, state: &State<f32, 6, 6>) -> [f32; 6] {
        if self.wait > 0 {
            self.wait -= 1;
            return self.between.hold(&state.qdd);
        }
        self.wait = 10 - 1;
        let trig = Engine::<Ur5e, Table<128, 3>>::joint_trig(&state.q);
        let torque = Engine::<Ur5e>::rnea(trig.with(state), &RIGID_BODY);
        let mass_matrix = Engine::<Ur5e>::crba(&trig, &RIGID_BODY);
        self.between.update(torque, mass_matrix, &state.qdd)
    }
}
