//! The step of the simulated robots that move for minutes.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::effects::{Effect, JointState};
use dynamics_core::model::RobotModel;
use dynamics_core::sim::{Integrator, KahanState, LinearlyImplicit, ModelDynamics};

/// One linearly implicit step of `h` seconds with compensated sums, under a scene that contains
/// `friction`, whose bristles then move on.
///
/// # Errors
/// As forward dynamics.
pub(crate) fn compensated_step<D, E, F, const N: usize>(
    robot: &D,
    at: &mut KahanState<f32, N, true>,
    tau: [f32; N],
    (scene, friction): (&E, &mut F),
    h: f32,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<f32, N, N, N>,
    E: Effect<f32, N, N>,
    F: Effect<f32, N, N>,
{
    let mechanics = ModelDynamics {
        robot,
        tau,
        effects: scene,
    };
    let step = LinearlyImplicit.step(&mechanics, &at.state, h)?;
    at.add(&step, h);
    for (joint, (&q, &qd)) in at.state.q.iter().zip(&at.state.qd).enumerate() {
        friction.advance(joint, JointState::new(q, qd), h);
    }
    Ok(())
}
