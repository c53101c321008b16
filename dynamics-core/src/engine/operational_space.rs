//! Operational space: the inertia of a task of one or several bodies, by the engine's J, M and its
//! factors.
//!
//! Khatib, "A unified approach for motion and force control of robot manipulators: the operational
//! space formulation" (1987): Λ⁻¹ = J M⁻¹ Jᵀ, with M = Lᵀ D L the sum of y yᵀ/d over the columns y
//! of J L⁻¹.

use core::borrow::Borrow;

use super::compile::{Compiled, CompiledRobot, JointAndBody, JointPair};
use super::{Engine, only_if};
use crate::algorithms::{
    Damping, Frame, NotPositiveDefinite, OperationalSpace, OsimInverse, task_jacobian,
};
use crate::effects::Effect;
use crate::model::{OnBody, Robot};
use crate::scalar::Real;
use crate::spatial::{Force, Motion};
use crate::state::{Configuration, JointTrig};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The operational-space inertia of a task on a body along some directions, expressed in a
    /// [`Frame`], as [`crate::algorithms::operational_space`] computes it.
    ///
    /// # Cost
    /// The cost of [`Engine::crba`], [`Engine::ltdl`] and [`Engine::jacobian`], M times
    /// [`Engine::solve`], 2 M² V flops and [`damped_inverse`](crate::algorithms::damped_inverse());
    /// without damping the same instructions for all data.
    ///
    /// # Source
    /// Khatib (1987).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::algorithms::{Damping, frame};
    /// use dynamics_core::{Engine, effects::RIGID_BODY, glam::DVec3, model::{OnBody, Robot}, robots::Ur5e, spatial::Force};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let q = [0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0];
    /// let place = DVec3::AXES.map(|axis| Force::new(DVec3::ZERO, axis)); // the hand's position
    /// let hand = (OnBody::<WRIST>, frame::LocalWorldAligned);
    /// let task = Engine::<Ur5e>::operational_space(&q, hand, &place, &RIGID_BODY, Damping::relative(1e-3))?;
    /// assert!(task.inertia[2][2] > 1.0); // kg, vertically
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// As [`Engine::ltdl`]. A singular configuration is not an error: the results are finite, and
    /// [`OperationalSpace::conditioning`] reports it.
    #[doc(alias = "end effector")]
    #[doc(alias = "OSIM")]
    #[inline(never)]
    pub fn operational_space<
        R: Real,
        const M: usize,
        const BODY: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        q: &impl Configuration<R, Q>,
        (body, frame): (OnBody<BODY>, impl Frame),
        directions: &[Force<R>; M],
        effects: &impl Effect<R, B, V>,
        damping: Damping<R>,
    ) -> Result<OperationalSpace<R, M, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
    {
        let trig = q.trig_or(Self::trig_source());
        let trig: &JointTrig<R, Q> = trig.borrow();
        let rows = task_jacobian(&Self::jacobian(trig, body, frame), directions);
        Self::of_rows(trig, rows, effects, damping)
    }

    /// The operational-space inertia of the task whose Jacobian has these rows: of one body, or of
    /// several bodies that are moved together.
    ///
    /// # Cost
    /// The cost of [`Engine::crba`] and [`Engine::ltdl`], M times [`Engine::solve`], 2 M² V flops
    /// and [`damped_inverse`](crate::algorithms::damped_inverse()); without damping the same
    /// instructions for all data.
    ///
    /// # Source
    /// Khatib (1987); of several bodies, Chang & Khatib (2000).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::algorithms::{Damping, frame::LocalWorldAligned, task_jacobian};
    /// use dynamics_core::{Engine, effects::RIGID_BODY, glam::DVec3, model::{OnBody, Robot}, robots::A1, spatial::Force};
    /// let trig = Engine::<A1>::joint_trig(&[0.0, 0.7, -1.4, 0.0, 0.7, -1.4, 0.0, 0.7, -1.4, 0.0, 0.7, -1.4]);
    /// let up = [Force::new(DVec3::ZERO, DVec3::Z)];
    /// let foot = |j| task_jacobian(&j, &up)[0];
    /// let rows = [
    ///     foot(Engine::<A1>::jacobian(&trig, OnBody::<{ A1::MODEL.body("FR_foot") }>, LocalWorldAligned)),
    ///     foot(Engine::<A1>::jacobian(&trig, OnBody::<{ A1::MODEL.body("RL_foot") }>, LocalWorldAligned)),
    /// ];
    /// let feet = Engine::<A1>::operational_space_of_rows(&trig, rows, &RIGID_BODY, Damping::relative(1e-3))?;
    /// assert_eq!(feet.mobility[0][1], 0.0); // on a base that does not move, no foot moves the other
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// As [`Engine::operational_space`].
    #[inline(never)]
    pub fn operational_space_of_rows<
        R: Real,
        E,
        const M: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        q: &impl Configuration<R, Q>,
        rows: [[R; V]; M],
        effects: &E,
        damping: Damping<R>,
    ) -> Result<OperationalSpace<R, M, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = q.trig_or(Self::trig_source());
        Self::of_rows(trig.borrow(), rows, effects, damping)
    }

    /// The inverse operational-space inertia Λ⁻¹ = J M⁻¹ Jᵀ of a body in a [`Frame`], as
    /// [`crate::algorithms::osim_inverse`] computes it.
    ///
    /// # Cost
    /// The cost of [`Engine::crba`], [`Engine::ltdl`] and [`Engine::jacobian`]; for each joint that
    /// moves the body 60 flops, and 12 for each such joint before it. The same instructions for all
    /// data.
    ///
    /// # Source
    /// Khatib (1987).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms::frame, effects::RIGID_BODY, model::{OnBody, Robot}, robots::Ur5e};
    /// use dynamics_core::{glam::DVec3, spatial::{Force, Motion}};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let q = [0.0, -1.2, 1.5, 0.3, 0.0, 0.0];
    /// let push = Force::new(DVec3::ZERO, DVec3::X * 10.0);
    /// let hand = Engine::<Ur5e>::osim_inverse(&q, OnBody::<WRIST>, frame::LocalWorldAligned, &RIGID_BODY)?;
    /// let a: Motion<f64> = hand * push;
    /// assert!(a.lin.x > 0.0);
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// As [`Engine::ltdl`].
    #[doc(alias = "mobility")]
    #[doc(alias = "OSIM")]
    #[inline(never)]
    pub fn osim_inverse<
        R: Real,
        E,
        const BODY: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        q: &impl Configuration<R, Q>,
        body: OnBody<BODY>,
        frame: impl Frame,
        effects: &E,
    ) -> Result<OsimInverse<R>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = q.trig_or(Self::trig_source());
        let trig: &JointTrig<R, Q> = trig.borrow();
        let factors = Self::ltdl(&Self::crba(trig, effects))?;
        let mut columns = Self::jacobian(trig, body, frame);
        Ok(mobility::<R, CompiledRobot<T, B, Q, V>, V, BODY>(
            &factors.rows,
            &factors.d_inv,
            &mut columns,
        ))
    }

    #[cfg_attr(optimised, inline(always))]
    fn of_rows<R: Real, E, const M: usize, const B: usize, const Q: usize, const V: usize>(
        trig: &JointTrig<R, Q>,
        rows: [[R; V]; M],
        effects: &E,
        damping: Damping<R>,
    ) -> Result<OperationalSpace<R, M, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        let factors = Self::ltdl(&Self::crba(trig, effects))?;
        let solve = |tau: &_| Self::solve(&factors, tau);
        Ok(OperationalSpace::new(rows, solve, damping))
    }
}

/// Λ⁻¹ of a body from the columns of its J, which become those of J L⁻¹, in place.
#[cfg_attr(optimised, inline(always))]
fn mobility<R: Real, T: Compiled, const V: usize, const BODY: usize>(
    l: &[[R; V]; V],
    d_inv: &[R; V],
    columns: &mut [Motion<R>; V],
) -> OsimInverse<R> {
    let mut mobility = OsimInverse::ZERO;
    for_each_joint_reversed!(I, {
        if JointAndBody::<T, I, BODY>::SUPPORTS
            && let Some(scatter) = const {
                only_if(
                    JointAndBody::<T, I, BODY>::SUPPORTS,
                    scatter::<R, T, V, I> as fn(&[[R; V]; V], &mut [Motion<R>; V]),
                )
            }
        {
            mobility = mobility.plus_square(columns[I], d_inv[I]);
            scatter(l, columns);
        }
    });
    mobility
}

/// Subtracts from the columns of joint I's ancestors its own, times their entries of L.
#[cfg_attr(optimised, inline(always))]
fn scatter<R: Real, T: Compiled, const V: usize, const I: usize>(
    l: &[[R; V]; V],
    columns: &mut [Motion<R>; V],
) {
    for_each_joint!(J, {
        if JointPair::<T, J, I>::IS_ANCESTOR {
            columns[J] -= columns[I] * l[I][J];
        }
    });
}
