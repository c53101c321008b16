//! A time step of fourth order, on joints of any kind.
//!
//! Runge and Kutta's method as Celledoni, Marthinsen & Owren, "Commutator-free Lie group methods"
//! (2003), section 3.2, write it for groups, here for velocities in the body's own frame. With k =
//! (q̇, q̈):
//!
//! ```text
//! Y₂ = Y ⊕ h/2 k₁    Y₃ = Y ⊕ h/2 k₂    Y₄ = Y₂ ⊕ h (k₃ − k₁/2)
//! Y₊ = Y ⊕ h/12 (3 k₁ + 2 k₂ + 2 k₃ − k₄) ⊕ h/12 (−k₁ + 2 k₂ + 2 k₃ + 3 k₄)
//! ```
//!
//! As two halves of a step, k + b and k − b: in Y₄ about k = k₃ with b = k₁ − k₃, in Y₊ about the
//! mean k = (k₁ + 2 k₂ + 2 k₃ + k₄)/6 with b = (k₁ − k₄)/3. Joints of one axis do not see b: the
//! classical method.

use super::{Dynamics, Integrator, ModelDynamics, Step, StepIncrement};
use crate::algorithms::NotPositiveDefinite;
use crate::effects::Effect;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::State;

/// Runge and Kutta's method. Fourth order, with four evaluations of forward dynamics per step.
#[derive(Clone, Copy, Debug, Default)]
pub struct RungeKutta;

impl<R: Real, const Q: usize, const V: usize> Integrator<R, Q, V> for RungeKutta {
    #[cfg_attr(optimised, inline(always))]
    fn step(&self, robot: &impl Dynamics<R, Q, V>, at: &State<R, Q, V>, h: R) -> Step<R, V> {
        let rates = |at: &State<R, Q, V>| {
            let qdd = robot.acceleration(at)?;
            Ok(StepIncrement::constant(at.qd, qdd))
        };
        let after = |k: &StepIncrement<R, V>, h| rates(&k.end(robot, at, h));
        let half = h * R::from_f64(0.5);
        let first = rates(at)?;
        let second = after(&first, half)?;
        let mut third = after(&second, half)?;
        third.half_difference = Some(core::array::from_fn(|j| first.qd[j] - third.qd[j]));
        let last = after(&third, h)?;

        let [third_of, sixth_of] = [1.0 / 3.0, 1.0 / 6.0].map(R::from_f64);
        let mean = |of: fn(&StepIncrement<R, V>) -> &[R; V]| {
            let [first, second, third, last] = [&first, &second, &third, &last].map(of);
            core::array::from_fn(|j| {
                let inner = sixth_of * first[j] + third_of * second[j] + third_of * third[j];
                inner + sixth_of * last[j]
            })
        };
        Ok(StepIncrement {
            qd: mean(|k| &k.qd),
            qdd: mean(|k| &k.qdd),
            half_difference: Some(core::array::from_fn(|j| third_of * (first.qd[j] - last.qd[j]))),
        })
    }
}

/// One step of `h` seconds of fourth order, explicit: for motion without stiff springs, dampers or
/// dry friction. `state.qdd` is left at the mean acceleration; the internal states of effects are
/// not advanced.
///
/// Cost: four times that of [`aba`](crate::algorithms::aba()), and for quaternions six
/// exponentials.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, sim::runge_kutta, state::State};
/// use dynamics_core::algorithms::{kinetic_energy, potential_energy};
/// let mut arm = State::at([0.0_f64, -1.5, 0.0, 0.0, 0.0, 0.0]);
/// let energy = |arm: &State<f64, 6, 6>| {
///     kinetic_energy(&Ur5e::MODEL, arm, &()) + potential_energy(&Ur5e::MODEL, &arm.q, &RIGID_BODY)
/// };
/// let before = energy(&arm);
/// for _ in 0..1000 {
///     runge_kutta(&Ur5e::MODEL, &mut arm, &[0.0; 6], &RIGID_BODY, 1e-3)?;
/// }
/// assert!((energy(&arm) - before).abs() < 1e-6);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`aba`](crate::algorithms::aba()); the state is then unchanged.
pub fn runge_kutta<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &mut State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
    h: R,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let tau = *tau;
    RungeKutta.advance(&ModelDynamics { robot, tau, effects }, state, h)
}
