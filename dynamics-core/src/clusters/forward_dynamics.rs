//! Forward dynamics of a robot with clusters by the engine: M_y ÿ = τ_y − C_y, with M and the bias
//! of the tree.
//!
//! Featherstone, RBDA (2008), section 8.5: M_y = Gᵀ M G, and C_y is inverse dynamics at ÿ = 0, Gᵀ
//! ID(γ(y), G ẏ, Ġ ẏ). For the few independent coordinates of legs and arms cheaper than
//! articulated bodies, [`Clustered::aba`].

use super::aba::ForwardError;
use super::clustered::{evaluate, sealed::Tree};
use super::description::sealed::Set;
use super::layout::NONE;
use super::places::TreeLayout;
use super::{ClusterError, ClusterProblem, Clustered, ClusteredRobot, TreeMotion};
use crate::Engine;
use crate::algorithms::{MATRIX_ROUNDINGS, MassMatrix, NotPositiveDefinite};
use crate::effects::{Effect, no_load_friction};
use crate::scalar::Real;
use crate::state::State;
use crate::trig::Kernel;

impl<T, K> Clustered<Engine<T, K>> {
    /// ÿ = FD(y, ẏ, τ_y): the independent accelerations, rad/s² or m/s², under the effects of the
    /// scene, as `Clustered<Core<T>>::aba` computes them.
    ///
    /// `y.qdd` is not read. τ_y are torques at y: those of motors elsewhere go through
    /// [`TreeMotion::from_motors`].
    ///
    /// # Shape
    /// Y.
    ///
    /// # Cost
    /// The cost of [`Clustered::rnea`], of the tree's [`Engine::crba`] and of
    /// [`TreeMotion::inertia`], and Y³/3 flops; the same instructions for all data, but at
    /// singularities.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), section 8.5.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::clusters::{Clustered, ClusteredRobot, Differential, Driven};
    /// use dynamics_core::{Engine, effects::RIGID_BODY, model::{ArmModel, Robot}, robots::Ur5e, state::State};
    /// struct Arm;
    /// impl Robot<6, 6, 6> for Arm {
    ///     const MODEL: ArmModel<f64, 6> = Ur5e::MODEL;
    /// }
    /// impl ClusteredRobot<6, 6, 6, 6, 6> for Arm {
    ///     type Clusters = (Driven<Differential, 2, 2>,);
    ///     const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1.0])),);
    ///     const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
    /// }
    /// let y = State { q: [0.1, -1.2, 1.5, 0.3, 0.9, 0.2], qd: [0.5; 6], qdd: [1.0; 6] };
    /// let tau = Clustered::<Engine<Arm>>::rnea(&y, &RIGID_BODY)?;
    /// let ydd = Clustered::<Engine<Arm>>::forward_dynamics(&y, &tau, &RIGID_BODY)?;
    /// assert!(ydd.iter().all(|ydd| (ydd - 1.0_f64).abs() < 1e-9));
    /// # Ok::<(), dynamics_core::clusters::ForwardError>(())
    /// ```
    ///
    /// # Errors
    /// [`ForwardError`] names the cluster that no configuration closes at y, or the cluster or
    /// joint of a coordinate of y whose pivot is NaN or does not exceed 32 roundings of its entry
    /// on the diagonal of M_y: it moves no inertia.
    #[inline(never)]
    pub fn forward_dynamics<
        R,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
        tau: &[R; Y],
        effects: &E,
    ) -> Result<[R; Y], ForwardError>
    where
        R: Real,
        T: ClusteredRobot<B, Q, V, P, Y>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        no_load_friction::<R, E, B, V>();
        const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
        let coasting = State { qdd: [R::ZERO; Y], ..*y };
        let mut motion = evaluate::<R, Engine<T, K>, B, Q, V, P, Y>(&coasting)?;
        if !E::VELOCITY_PRODUCTS {
            // Ġ ẏ is a product of velocities.
            motion.tree.qdd = [R::ZERO; V];
        }
        let bias = <Engine<T, K> as Tree<R, B, Q, V>>::rnea(&motion.trig, &motion.tree, effects);
        let mut rest = *tau;
        for (rest, bias) in rest.iter_mut().zip(motion.torque(&bias)) {
            *rest -= bias;
        }
        let m = motion.inertia(&Engine::<T, K>::crba(motion.configuration(), effects));
        match solve(m, rest) {
            Ok(ydd) => Ok(TreeMotion::<R, T, B, Q, V, P, Y>::finite(ydd)?),
            Err(k) => Err(no_inertia::<T, B, Q, V, P, Y>(k)),
        }
    }
}

/// x with M x = b by M = L D Lᵀ, or the first coordinate whose pivot is none.
#[cfg_attr(optimised, inline(always))]
fn solve<R: Real, const Y: usize>(m: MassMatrix<R, Y>, b: [R; Y]) -> Result<[R; Y], usize> {
    let (mut rows, mut x, mut d_inv) = (m.rows, b, [R::ZERO; Y]);
    for k in 0..Y {
        let (pivot_row, done) = (rows[k], x[k]);
        let least = m.rows[k][k] * (R::EPSILON * R::from_f64(MATRIX_ROUNDINGS));
        // False of a NaN, too.
        if !((pivot_row[k] > least) & pivot_row[k].is_finite()) {
            return Err(k);
        }
        d_inv[k] = R::ONE / pivot_row[k];
        for i in k + 1..Y {
            let l = pivot_row[i] * d_inv[k];
            for j in i..Y {
                rows[i][j] -= l * pivot_row[j];
            }
            x[i] -= l * done;
        }
    }
    for k in (0..Y).rev() {
        for j in k + 1..Y {
            x[k] -= rows[k][j] * x[j];
        }
        x[k] *= d_inv[k];
    }
    Ok(x)
}

/// The cluster or joint of the k-th velocity in y.
#[cold]
#[inline(never)]
fn no_inertia<T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>(
    k: usize,
) -> ForwardError
where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    let layout = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT;
    if let Some(joint) = layout.free.iter().position(|&place| place == k) {
        return ForwardError::Joint(NotPositiveDefinite { joint });
    }
    let mut clusters = layout.first.iter().zip(&layout.count);
    let found = clusters
        .position(|(&[_, first], &count)| first != NONE && (first..first + count).contains(&k));
    ForwardError::Cluster(ClusterError {
        cluster: found.map_or(T::MODEL.name, |c| T::CLUSTERS.name(c)),
        problem: ClusterProblem::NoInertia,
    })
}
