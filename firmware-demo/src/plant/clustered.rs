//! A simulated robot with kinematic loops and with encoders at its motors.

use dynamics_core::Core;
use dynamics_core::clusters::{Clustered, ClusteredRobot, ForwardError, TreeMotion};
use dynamics_core::effects::{Effect, Implicit, JointState};
use dynamics_core::model::Calibrated;
use dynamics_core::state::{RobotState, State};

use super::Simulated;

/// A robot of B bodies and V tree coordinates whose loops leave N independent ones, y, and that N
/// motors drive.
#[derive(Debug)]
pub struct ClusterPlant<T, E, const B: usize, const V: usize, const N: usize>
where
    T: ClusteredRobot<B, V, V, N, N>,
{
    robot: Calibrated<T, f32, B, V, V>,
    pub effects: E,
    /// Position, velocity and acceleration of y, which the encoders do not measure.
    pub y: State<f32, N, N>,
    /// The tree's motion at y, if its loops close there.
    motion: Option<TreeMotion<f32, T, B, V, V, N, N>>,
}

impl<T, E, const B: usize, const V: usize, const N: usize> ClusterPlant<T, E, B, V, N>
where
    T: ClusteredRobot<B, V, V, N, N>,
    E: Effect<f32, B, V>,
{
    /// A robot at rest at y. Where no configuration closes its loops, the motors are at 0 and the
    /// first step fails.
    pub fn new(robot: Calibrated<T, f32, B, V, V>, effects: E, y: [f32; N]) -> Self {
        let y = State::at(y);
        let motion = Clustered::<Core<T>>::motion(&y).ok();
        Self { robot, effects, y, motion }
    }

    /// One step as [`linearly_implicit`](dynamics_core::sim::linearly_implicit()) takes it, of y:
    /// effects of the tree's joints are those of the step's end.
    fn advance(&mut self, torque: &[f32; N], h: f32) -> Result<(), ForwardError> {
        let motion = match &self.motion {
            Some(motion) => motion,
            None => &Clustered::<Core<T>>::motion(&self.y)?,
        };
        let effects = Implicit::new(&self.robot, motion.state().state(), &self.effects, h);
        let ydd = motion.aba(&self.robot, &motion.from_motors(torque), &effects)?;
        for (k, ydd) in ydd.into_iter().enumerate() {
            self.y.qd[k] += h * ydd;
            self.y.q[k] += h * self.y.qd[k];
            self.y.qdd[k] = ydd;
        }
        let motion = Clustered::<Core<T>>::motion(&self.y)?;
        let tree = *motion.state().state();
        for v in 0..V {
            let at = JointState::new(tree.q[v], tree.qd[v]);
            self.effects.advance(v, at, h);
        }
        self.motion = Some(motion);
        Ok(())
    }
}

impl<T, E, X, const B: usize, const V: usize, const N: usize> Simulated<X, N>
    for ClusterPlant<T, E, B, V, N>
where
    T: ClusteredRobot<B, V, V, N, N>,
    E: Effect<f32, B, V>,
{
    type Error = ForwardError;

    fn encoder_positions(&self) -> [f32; N] {
        let motors = self.motion.as_ref().map(|motion| motion.motors(&self.y).q);
        motors.unwrap_or([0.0; N])
    }

    fn step(&mut self, torque: &[f32; N], _: &X, h: f32) -> Result<(), ForwardError> {
        self.advance(torque, h)
    }
}
