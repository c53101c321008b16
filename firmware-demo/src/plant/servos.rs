//! A simulated robot moved by hobby servos: voltage in place of torque, coarse encoders and duties.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::Effect;
use dynamics_core::model::Robot;

use super::{Plant, Simulated};

/// A robot of B bodies, each on the gear of a servo. Commands are the torques that the voltages
/// would give at rest.
#[derive(Debug)]
pub struct ServoPlant<T, E, const B: usize> {
    /// The robot under the servos' torques.
    pub arm: Plant<T, E, (), B, B, B>,
    /// Torque per commanded torque: 1, or what supply and torque constant make of it.
    pub gain: [f32; B],
    /// k_t²/R: torque that the back-EMF takes per speed, N·m·s/rad.
    pub back_emf: [f32; B],
    /// The least step of a command, N·m.
    pub step: f32,
    /// The encoders' resolution, rad.
    pub resolution: f32,
}

/// The nearest multiple of `unit`.
fn to_nearest(x: f32, unit: f32) -> f32 {
    libm::roundf(x / unit) * unit
}

impl<T, E, const B: usize> Simulated<(), B> for ServoPlant<T, E, B>
where
    T: Robot<B, B, B>,
    E: Effect<f32, B, B>,
{
    type Error = NotPositiveDefinite;

    fn encoder_positions(&self) -> [f32; B] {
        self.arm.state.q.map(|q| to_nearest(q, self.resolution))
    }

    fn actual(&self) -> [f32; B] {
        self.arm.state.q
    }

    fn step(&mut self, command: &[f32; B], (): &(), h: f32) -> Result<(), NotPositiveDefinite> {
        let torque: [f32; B] = core::array::from_fn(|j| {
            let voltage = to_nearest(command[j], self.step);
            self.gain[j] * voltage - self.back_emf[j] * self.arm.state.qd[j]
        });
        self.arm.step(&torque, &(), h)
    }
}
