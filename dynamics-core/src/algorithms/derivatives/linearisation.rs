//! A robot near a state as a linear system, in continuous time and over a tick.
//!
//! Åström & Wittenmark, *Computer-Controlled Systems* (1997), section 3.2: the hold of order zero.

use super::AccelerationGradient;
use crate::algorithms::solve;
use crate::model::RobotModel;
use crate::scalar::Real;

/// The linear system of small deviations δq, δq̇ of V coordinates from a state, under U inputs δu.
///
/// ```text
/// d/dt [δq; δq̇] = [0 1; ∂q̈/∂q ∂q̈/∂q̇] [δq; δq̇] + [0; ∂q̈/∂u] δu
/// ```
///
/// That of a robot with a motor at each coordinate is made from the derivatives of forward
/// dynamics, here of an arm that hangs still under the torques that carry it:
///
/// ```
/// use dynamics_core::algorithms::{Linearisation, forward_dynamics_derivatives, rnea};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]);
/// let holding = rnea(&Ur5e::MODEL, &state, &RIGID_BODY);
/// let by = forward_dynamics_derivatives(&Ur5e::MODEL, &state, &holding, &RIGID_BODY)?;
/// let arm = Linearisation::new(&Ur5e::MODEL, &by);
/// // 1 N·m more at the base for a tick of 2 ms turns it by δq̈ h² / 2.
/// let [dq, _] = arm.after(&[[0.0; 6]; 2], &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 2e-3);
/// assert!((dq[0] / (0.5 * arm.du[0][0] * 4e-6) - 1.0).abs() < 1e-3);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[doc(alias = "state-space model")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearisation<R, const V: usize, const U: usize = V> {
    /// ∂q̈/∂q, 1/s² between revolute joints.
    pub dq: [[R; V]; V],
    /// ∂q̈/∂q̇, 1/s between revolute joints.
    pub dqd: [[R; V]; V],
    /// ∂q̈/∂u, by rows of q̈: 1/(kg·m²) of a torque.
    pub du: [[R; U]; V],
}

impl<R: Real, const V: usize> Linearisation<R, V> {
    /// That of a robot with a motor at each coordinate: ∂q̈/∂u = M⁻¹.
    pub fn new<D, const B: usize, const Q: usize>(
        robot: &D,
        by: &AccelerationGradient<R, V>,
    ) -> Self
    where
        D: RobotModel<R, B, Q, V>,
    {
        let unit = |k| core::array::from_fn(|j| if j == k { R::ONE } else { R::ZERO });
        // M⁻¹ is symmetric: its rows are its columns.
        let du = core::array::from_fn(|k| solve(robot, &by.factors, &unit(k)));
        Self { dq: by.dq, dqd: by.dqd, du }
    }
}

impl<R: Real, const V: usize, const U: usize> Linearisation<R, V, U> {
    /// [δq̇; δq̈] of [δq; δq̇] under δu.
    pub fn rates(&self, [q, qd]: &[[R; V]; 2], u: &[R; U]) -> [[R; V]; 2] {
        let qdd = core::array::from_fn(|i| {
            let terms = (self.dq.get(i).zip(self.dqd.get(i))).zip(self.du.get(i));
            terms.map_or(R::ZERO, |((dq, dqd), du)| dot(dq, q) + dot(dqd, qd) + dot(du, u))
        });
        [*qd, qdd]
    }

    /// [δq; δq̇] after a tick of h seconds in which δu is held: exact but for rounding.
    ///
    /// The columns of the system in discrete time, δx⁺ = Φ δx + Γ δu, are those of unit vectors.
    ///
    /// ```text
    /// δx⁺ = δx + Σ hᵏ/k! Aᵏ⁻¹ (A δx + B δu)      k = 1, 2, …
    /// ```
    ///
    /// # Cost
    /// 2 V (2 V + U) flops, and 4 V² for each further term; 24 terms, which are enough while h
    /// times the fastest rate of the system is below 2.
    pub fn after(&self, state: &[[R; V]; 2], u: &[R; U], h: R) -> [[R; V]; 2] {
        let (mut end, still) = (*state, [R::ZERO; U]);
        let mut term = scaled(self.rates(state, u), h);
        for k in 2..26 {
            for (end, term) in end.iter_mut().zip(&term) {
                for (end, &term) in end.iter_mut().zip(term) {
                    *end += term;
                }
            }
            term = scaled(self.rates(&term, &still), h / R::from_f64(f64::from(k)));
        }
        end
    }
}

fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (&a, &b)| sum + a * b)
}

fn scaled<R: Real, const V: usize>(x: [[R; V]; 2], by: R) -> [[R; V]; 2] {
    x.map(|x| x.map(|x| x * by))
}
