//! A simulated robot whose links bend.

use dynamics_core::effects::Effect;
use dynamics_core::flexible::{FlexibleError, ModalFeedforward, Modes, step};
use dynamics_core::model::{Calibrated, Robot};
use dynamics_core::state::State;

use super::Simulated;

/// A robot of B bodies on as many joints, and of M modes.
#[derive(Debug)]
pub struct BendingPlant<T, E, const B: usize, const M: usize> {
    robot: Calibrated<T, f32, B, B, B>,
    modes: Modes<f32, M>,
    effects: E,
    pub joints: State<f32, B, B>,
    /// The modes, which no encoder measures.
    pub bent: State<f32, M, M>,
}

impl<T, E, const B: usize, const M: usize> BendingPlant<T, E, B, M>
where
    T: Robot<B, B, B>,
    E: Effect<f32, B, B>,
{
    /// A robot at rest at q, its links bent by their weight.
    pub fn new(
        robot: Calibrated<T, f32, B, B, B>,
        modes: Modes<f32, M>,
        effects: E,
        q: [f32; B],
    ) -> Self {
        let rest = ModalFeedforward::at_rest(&robot, &modes, &q, &effects);
        // Modes that are checked while compiling have a stiffness.
        let bent = rest.map_or(State::at([0.0; M]), |rest| rest.bent);
        Self { robot, modes, effects, joints: State::at(q), bent }
    }
}

impl<T, E, X, const B: usize, const M: usize> Simulated<X, B> for BendingPlant<T, E, B, M>
where
    T: Robot<B, B, B>,
    E: Effect<f32, B, B>,
{
    type Error = FlexibleError;

    fn encoder_positions(&self) -> [f32; B] {
        self.joints.q
    }

    fn step(&mut self, torque: &[f32; B], _: &X, h: f32) -> Result<(), FlexibleError> {
        step(&self.robot, &self.modes, &mut self.joints, &mut self.bent, torque, &self.effects, h)
    }
}
