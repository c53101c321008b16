//! Hybrid dynamics: the torque of some coordinates is given, and the acceleration of the others.
//!
//! Featherstone, RBDA (2008), section 9.2, by bias and M: rows and columns of coordinates of given
//! acceleration are those of the identity, so that the factors of M keep their zeros and the
//! instructions do not depend on which coordinates these are.

use core::borrow::Borrow;
use core::hint::black_box;
use core::marker::PhantomData;

use super::call::Call;
use super::compile::{Compiled, CompiledRobot, JointPair};
use super::ltdl::{decompose, substitute};
use super::{Engine, Index, only_if};
use crate::algorithms::{JointResult, MassMatrix, NotPositiveDefinite, Prescribed};
use crate::effects::{Effect, load_friction, transmitted};
use crate::model::Robot;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// Torques and accelerations of all coordinates, of which one is given for each, N·m or N and
    /// rad/s² or m/s², as [`crate::algorithms::hybrid_dynamics`] computes them.
    ///
    /// `state.qdd` is not read.
    ///
    /// # Cost
    /// The cost of [`Engine::forward_dynamics`], and 4 V² flops for a chain of V joints, less on a
    /// tree; the same instructions for all data.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), section 9.2.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::algorithms::Prescribed::*;
    /// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
    /// let state = State::at([0.0_f64, -1.2, 1.5, 0.3, 0.0, 0.0]);
    /// // The base is held; the other joints are let go.
    /// let given = [Acceleration(0.0), Torque(0.0), Torque(0.0), Torque(0.0), Torque(0.0), Torque(0.0)];
    /// let response = Engine::<Ur5e>::hybrid_dynamics(&state, &given, &RIGID_BODY)?;
    /// assert!(response.qdd[0] == 0.0 && response.tau[1] == 0.0 && response.qdd[1] > 5.0);
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// As [`Engine::forward_dynamics`], of the coordinates of given torque.
    #[doc(alias = "HD")]
    #[inline(never)]
    pub fn hybrid_dynamics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        given: &[Prescribed<R>; V],
        effects: &E,
    ) -> Result<JointResult<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let call = Call {
            turns: &trig.borrow().coordinates,
            effects,
            robot: PhantomData::<CompiledRobot<T, B, Q, V>>,
        };
        call.hybrid(state.state(), given)
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn hybrid(
        self,
        state: &State<R, Q, V>,
        given: &[Prescribed<R>; V],
    ) -> Result<JointResult<R, V>, NotPositiveDefinite> {
        // One phase after the other: as one block they would need more registers than there are.
        let mut bias = self.bias(state);
        black_box(&mut bias);
        let mut m = MassMatrix::ZERO;
        self.mass_matrix::<true>(&mut m.rows);
        black_box(&mut m);

        let (mut free, mut tau, mut qdd) = ([true; V], [R::ZERO; V], [R::ZERO; V]);
        let mut pivots = self.noise();
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                (free[J], tau[J], qdd[J]) = match given[J] {
                    Prescribed::Torque(tau) => (true, tau, R::ZERO),
                    Prescribed::Acceleration(qdd) => (false, R::ZERO, qdd),
                };
                pivots[J] = R::either(free[J], pivots[J], R::ZERO);
            }
        });
        let mut rows = m.rows;
        let held = times::<R, T, V>(&m, &qdd);
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                let at = self.joint_state::<J>(state);
                let rest = transmitted(self.effects, J, at, tau[J]) - bias[J] - held[J];
                qdd[J] = R::either(free[J], rest, qdd[J]);
                if let Some(hold) =
                    const { only_if(J < V, hold::<R, T, V, J> as fn(&mut [[R; V]; V], &[bool; V])) }
                {
                    hold(&mut rows, &free);
                }
            }
        });
        let d_inv = decompose::<R, T, V, false>(&mut rows, &pivots, &[false; V])?;
        substitute::<R, T, V, false>(&rows, &d_inv, &mut qdd);

        let moved = times::<R, T, V>(&m, &qdd);
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                let at = self.joint_state::<J>(state);
                let mut motor = bias[J] + moved[J];
                load_friction(self.effects, J, at, &mut motor);
                tau[J] = R::either(free[J], tau[J], motor);
            }
        });
        Ok(JointResult { tau, qdd })
    }
}

/// Row J of M up to its diagonal, with the entries of the identity where J or the column's
/// coordinate is not free.
#[cfg_attr(optimised, inline(always))]
fn hold<R: Real, T: Compiled, const V: usize, const J: usize>(
    rows: &mut [[R; V]; V],
    free: &[bool; V],
) {
    for_each_joint!(I, {
        if JointPair::<T, I, J>::SUPPORTS {
            let fixed = if I == J { R::ONE } else { R::ZERO };
            rows[J][I] = R::either(free[I] & free[J], rows[J][I], fixed);
        }
    });
}

/// M x, without what is zero by the branches of the tree.
#[cfg_attr(optimised, inline(always))]
fn times<R: Real, T: Compiled, const V: usize>(m: &MassMatrix<R, V>, x: &[R; V]) -> [R; V] {
    let mut product = [R::ZERO; V];
    for_each_joint!(J, {
        if Index::<J, V>::IS_BELOW
            && let Some(row) =
                const { only_if(J < V, row::<R, T, V, J> as fn(&MassMatrix<R, V>, &[R; V]) -> R) }
        {
            product[J] = row(m, x);
        }
    });
    product
}

/// Row J of M times x.
#[cfg_attr(optimised, inline(always))]
fn row<R: Real, T: Compiled, const V: usize, const J: usize>(
    m: &MassMatrix<R, V>,
    x: &[R; V],
) -> R {
    let mut sum = m.rows[J][J] * x[J];
    for_each_joint!(I, {
        if JointPair::<T, I, J>::IS_ANCESTOR || JointPair::<T, J, I>::IS_ANCESTOR {
            sum += m.rows[J][I] * x[I];
        }
    });
    sum
}
