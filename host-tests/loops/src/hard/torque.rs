//! Torques of a machine in a state, and whether their status is as it has to be.

use dynamics_core::algorithms::rnea;
use dynamics_core::loops::{Drive, LoopTorque, Loops, SINGULAR, inverse_dynamics};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::loops::scene;

use super::outcome::Outcome;
use super::setup::Setup;

impl<const B: usize, const Q: usize, const V: usize, const L: usize, const C: usize, const A: usize>
    Setup<B, Q, V, L, C, A>
{
    /// Torques of a state; near a singular configuration with a status that names a loop.
    pub fn inverse<R: Real>(
        &self,
        robot: &impl RobotModel<R, B, Q, V>,
        loops: &Loops<L, C, A>,
        state: &State<R, Q, V>,
    ) -> Outcome {
        match inverse_dynamics(robot, loops, state, &scene()) {
            Ok(found) => {
                let named = match found.drive {
                    Drive::Singular { name, .. } => {
                        self.has(name) && self.is_within_bound(robot, &found)
                    }
                    _ => false,
                };
                Outcome::of(&found.tau, named)
            }
            Err(_) => Outcome::NOTHING,
        }
    }

    /// Whether damped torques are within the bound of [`Loops::damped_below`] at the default
    /// threshold.
    fn is_within_bound<R: Real>(
        &self,
        robot: &impl RobotModel<R, B, Q, V>,
        found: &LoopTorque<R, Q, V, C, A>,
    ) -> bool {
        let tree = rnea(robot, &found.state, &scene()).map(Real::to_f64);
        let norm = |motors: bool| {
            let of = (0..V).filter(|i| self.loops.actuated().contains(i) == motors);
            of.map(|i| tree[i] * tree[i]).sum::<f64>().sqrt()
        };
        let bound = norm(true) + (2.0 * L as f64).sqrt() / SINGULAR * norm(false);
        let squares = found.tau.iter().map(|tau| tau.to_f64().powi(2));
        squares.sum::<f64>().sqrt() <= bound
    }

    /// Whether a loop has this name.
    pub fn has(&self, name: &str) -> bool {
        self.loops.joints().iter().any(|joint| joint.name() == name)
    }
}
