//! A simulated robot whose transmissions give way: its encoders sit on the motors.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::drivetrain::{ElasticJoints, MotorState, elastic_step};
use dynamics_core::effects::Effect;
use dynamics_core::model::{Calibrated, Robot};
use dynamics_core::state::State;

use super::Simulated;

/// A robot of B bodies on as many compliant joints.
#[derive(Debug)]
pub struct FlexiblePlant<T, E, const B: usize> {
    robot: Calibrated<T, f32, B, B, B>,
    joints: ElasticJoints<f32, B>,
    effects: E,
    /// The links, beyond what the encoders tell.
    pub links: State<f32, B, B>,
    motors: MotorState<f32, B>,
}

impl<T, E, const B: usize> FlexiblePlant<T, E, B>
where
    T: Robot<B, B, B>,
    E: Effect<f32, B, B>,
{
    /// A robot at rest: links and motors at these positions.
    pub fn new(
        robot: Calibrated<T, f32, B, B, B>,
        joints: ElasticJoints<f32, B>,
        effects: E,
        [links, motors]: [[f32; B]; 2],
    ) -> Self {
        Self {
            robot,
            joints,
            effects,
            links: State::at(links),
            motors: MotorState { position: motors, velocity: [0.0; B] },
        }
    }
}

impl<T, E, X, const B: usize> Simulated<X, B> for FlexiblePlant<T, E, B>
where
    T: Robot<B, B, B>,
    E: Effect<f32, B, B>,
{
    type Error = NotPositiveDefinite;

    fn encoder_positions(&self) -> [f32; B] {
        self.motors.position
    }

    fn actual(&self) -> [f32; B] {
        self.links.q
    }

    fn step(&mut self, torque: &[f32; B], _: &X, h: f32) -> Result<(), NotPositiveDefinite> {
        elastic_step(
            &self.robot,
            &self.joints,
            &mut self.links,
            &mut self.motors,
            torque,
            &mut self.effects,
            h,
        )
    }
}
