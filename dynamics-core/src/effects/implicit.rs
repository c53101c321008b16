//! Stiff effects evaluated at the end of a time step instead of at its beginning.

use super::query::joint_state;
use super::{Declared, Effect, JointState, TorqueDerivatives, add_load_slope};
use crate::effects::delegate::delegate_effect;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{State, entry};

/// The effects of a scene for a step of `h` seconds, with torques at its end, extrapolated along
/// their derivatives.
///
/// τ(q + h q̇₊, q̇₊) ≈ τ + ∂τ/∂q h (q̇ + h q̈) + ∂τ/∂q̇ h q̈: the factor of q̈, h ∂τ/∂q̇ + h²
/// ∂τ/∂q, is added to M's diagonal, the rest to τ. Forward dynamics under these effects is the
/// linearly implicit Euler step. It is stable at any stiffness of springs and dampers, and costs a
/// few flops per joint. Baraff & Witkin, "Large steps in cloth simulation" (1998), equation (6).
///
/// ```
/// use dynamics_core::algorithms::aba;
/// use dynamics_core::effects::{Implicit, Inertia, Viscous};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// use dynamics_core::state::State;
/// let wheel: ArmModel<f64, 1> = Model::new("wheel", [
///     Body::new("w", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(1.0).inertia([0.0, 0.0, 0.0, 0.0, 0.0, 2.0]),
/// ]);
/// let turning = State { q: [0.0], qd: [1.0], qdd: [0.0] };
/// let (scene, h) = ((Inertia, Viscous([50.0])), 0.1);
/// let [qdd] = aba(&wheel, &turning, &[0.0], &Implicit::new(&wheel, &turning, &scene, h))?;
/// assert!((1.0 + h * qdd - 1.0 / (1.0 + h * 50.0 / 2.0)).abs() < 1e-15); // slows down, never turns back
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[doc(alias = "linearly implicit")]
#[doc(alias = "backward Euler")]
#[derive(Clone, Copy, Debug)]
pub struct Implicit<'a, E, R, const V: usize> {
    effects: &'a E,
    end: AtEndOfStep<R, V>,
}

impl<'a, E, R: Real, const V: usize> Implicit<'a, E, R, V> {
    /// `effects` for a step of `h` seconds from `state`.
    #[cfg_attr(optimised, inline(always))]
    pub fn new<D, const B: usize, const Q: usize>(
        robot: &D,
        state: &State<R, Q, V>,
        effects: &'a E,
        h: R,
    ) -> Self
    where
        D: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        let mut derivatives = [TorqueDerivatives::default(); V];
        for link in robot.links() {
            for k in link.coordinates() {
                if let Some(derivatives) = derivatives.get_mut(k) {
                    effects.derivatives(k, joint_state(&link, state, k), derivatives);
                }
            }
        }
        let end = AtEndOfStep { h, derivatives };
        Self { effects, end }
    }

    /// The same for motors of the torques `tau`, N·m or N, on which load-dependent friction
    /// depends.
    #[cfg_attr(optimised, inline(always))]
    pub fn under<D, const B: usize, const Q: usize>(
        robot: &D,
        state: &State<R, Q, V>,
        effects: &'a E,
        tau: &[R; V],
        h: R,
    ) -> Self
    where
        D: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        let mut implicit = Self::new(robot, state, effects, h);
        if const { E::LOAD_DEPENDENT } {
            for link in robot.links() {
                for k in link.coordinates() {
                    let at = joint_state(&link, state, k);
                    if let Some(derivatives) = implicit.end.derivatives.get_mut(k) {
                        add_load_slope(effects, k, at, entry(tau, k), derivatives);
                    }
                }
            }
        }
        implicit
    }
}

/// The factors of q̈ and of q̇, from the derivatives of each joint's torque.
#[derive(Clone, Copy, Debug)]
struct AtEndOfStep<R, const V: usize> {
    h: R,
    derivatives: [TorqueDerivatives<R>; V],
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for AtEndOfStep<R, V> {
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        *tau += self.h * (entry(&self.derivatives, joint).dq * at.qd);
    }

    #[cfg_attr(optimised, inline(always))]
    fn inertia(&self, joint: usize) -> Option<R> {
        let derivatives = entry(&self.derivatives, joint);
        Some(self.h * (derivatives.dqd + self.h * derivatives.dq))
    }
}

delegate_effect! {
    impl[R: Real, E: Effect<R, B, V>, const B: usize, const V: usize]
    Effect<R, B, V> for Implicit<'_, E, R, V>,
    |this| { E => *this.effects, AtEndOfStep<R, V> => this.end }
}
