use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Static;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::{Dynamics, Integrator, KahanState, RungeKutta, StepIncrement};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

/// The robot without torques.
pub struct PassiveMotion;

impl Dynamics<f32, 6, 6> for PassiveMotion {
    fn acceleration(&self, at: &State<f32, 6, 6>) -> Result<[f32; 6], NotPositiveDefinite> {
        Engine::<Ur5e>::forward_dynamics(at, &[0.0; 6], &RIGID_BODY)
    }

    fn implicit_acceleration(
        &self,
        at: &State<f32, 6, 6>,
        _h: f32,
    ) -> Result<[f32; 6], NotPositiveDefinite> {
        self.acceleration(at) // no friction, no springs
    }

    fn energies(&self, at: &State<f32, 6, 6>) -> (f32, f32) {
        (
            Core::<Ur5e>::kinetic_energy(at, &RIGID_BODY),
            Core::<Ur5e>::potential_energy(&at.q, &RIGID_BODY),
        )
    }

    fn configuration_after(&self, q: &[f32; 6], at: &StepIncrement<f32, 6>, h: f32) -> [f32; 6] {
        at.configuration_after(&Static::<Ur5e>::NEW, q, h)
    }
}

/// s.
pub const STEP: f32 = 1000.0e-6;

/// The robot's motion, step by step.
pub struct Simulation {
    integrator: RungeKutta,
    motion: KahanState<f32, 6, true>,
}

impl Simulation {
    /// From this state on.
    pub fn start(state: State<f32, 6, 6>) -> Self {
        Self {
            integrator: Integrator::start(&PassiveMotion, &state),
            motion: KahanState::at(state),
        }
    }

    /// One step; the state after it.
    pub fn step(&mut self) -> Result<&State<f32, 6, 6>, NotPositiveDefinite> {
        let rates = self.integrator.step(&PassiveMotion, &self.motion.state, STEP)?;
        self.motion.add(&rates, STEP);
        Ok(&self.motion.state)
    }
}
