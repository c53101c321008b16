//! M = Lᵀ D L and M x = τ, without the entries that are zero by the branches of the tree.
//!
//! Featherstone, RBDA (2008), section 6.5, tables 6.3 and 6.4: from the tips to the base, so that
//! no zero is filled. All sums run over the ancestors of a joint, λ(i), λ(λ(i)) …

use super::compile::{Compiled, CompiledRobot, JointPair};
use super::pivot_noise::Singular;
use super::tree_matrix::{TreeLtdl, TreeMatrix, place};
use super::{Engine, Index, only_if};
use crate::algorithms::{Ltdl, MassMatrix};
use crate::algorithms::{MATRIX_ROUNDINGS, NotPositiveDefinite};
use crate::model::Robot;
use crate::scalar::Real;

impl<T, K> Engine<T, K> {
    /// The factors of M = Lᵀ D L, for [`Engine::solve`].
    ///
    /// # Cost
    /// One division for each joint, and n (n² − 1)/3 + n (n − 1)/2 flops for a chain of n joints,
    /// less on a tree; the same instructions for all data. Inlined, as [`Engine::solve`] is: where
    /// one follows the other, the factors stay in registers.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), table 6.3.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e};
    /// let m = Engine::<Ur5e>::crba(&[0.0_f32, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
    /// let x = Engine::<Ur5e>::solve(&Engine::<Ur5e>::ltdl(&m)?, &[1.0; 6]);
    /// let first: f32 = (0..6).map(|j| m.get(0, j) * x[j]).sum();
    /// assert!((first - 1.0).abs() < 1e-4);
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names the outermost joint whose pivot is NaN or does not exceed 32
    /// roundings of M_ii, as [`ltdl`](crate::algorithms::ltdl()) does: it moves no inertia when its
    /// descendants are free.
    #[cfg_attr(optimised, inline(always))]
    pub fn ltdl<R: Real, const B: usize, const Q: usize, const V: usize>(
        m: &MassMatrix<R, V>,
    ) -> Result<Ltdl<R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
    {
        let mut rows = m.rows;
        let noise = noise::<R, CompiledRobot<T, B, Q, V>, V, false>(&rows);
        let d_inv =
            decompose::<R, CompiledRobot<T, B, Q, V>, V, false>(&mut rows, &noise, &[false; V])?;
        Ok(Ltdl { rows, d_inv })
    }

    /// The solution x of M x = τ: accelerations of torques, rad/s² or m/s² of N·m or N.
    ///
    /// # Cost
    /// 2 n² − n flops for a chain of n joints, less on a tree.
    ///
    /// # Source
    /// RBDA (2008), table 6.4.
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn solve<R: Real, const B: usize, const Q: usize, const V: usize>(
        factor: &Ltdl<R, V>,
        tau: &[R; V],
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
    {
        let mut x = *tau;
        substitute::<R, CompiledRobot<T, B, Q, V>, V, false>(&factor.rows, &factor.d_inv, &mut x);
        x
    }

    /// The factors of M = Lᵀ D L in the place of M: the same bits as [`Engine::ltdl`] without a
    /// copy of the matrix. M is gone then; the next [`Engine::tree_crba`] writes it again.
    ///
    /// # Cost
    /// As [`Engine::ltdl`].
    ///
    /// # Source
    /// Featherstone, RBDA (2008), table 6.3.
    ///
    /// # Example
    /// That of [`TreeLtdl`].
    ///
    /// # Errors
    /// As [`Engine::ltdl`].
    #[cfg_attr(optimised, inline(always))]
    pub fn tree_ltdl<R: Real, const B: usize, const Q: usize, const V: usize>(
        m: &mut TreeMatrix<T, R, V>,
    ) -> Result<TreeLtdl<'_, T, R, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
    {
        let noise = noise::<R, CompiledRobot<T, B, Q, V>, V, true>(&m.entries);
        let d_inv = decompose::<R, CompiledRobot<T, B, Q, V>, V, true>(
            &mut m.entries,
            &noise,
            &[false; V],
        )?;
        Ok(TreeLtdl { m, d_inv })
    }

    /// The solution x of M x = τ by these factors: accelerations of torques, rad/s² or m/s² of N·m
    /// or N.
    ///
    /// # Cost
    /// As [`Engine::solve`].
    ///
    /// # Source
    /// RBDA (2008), table 6.4.
    ///
    /// # Example
    /// That of [`TreeLtdl`].
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn tree_solve<R: Real, const B: usize, const Q: usize, const V: usize>(
        factor: &TreeLtdl<'_, T, R, V>,
        tau: &[R; V],
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
    {
        let mut x = *tau;
        let TreeLtdl { m, d_inv } = factor;
        substitute::<R, CompiledRobot<T, B, Q, V>, V, true>(&m.entries, d_inv, &mut x);
        x
    }
}

/// Entry (I, j) of a triangle by rows of V, or of one whose entries of the tree stand one behind
/// the other.
#[cfg_attr(optimised, inline(always))]
fn entry<R: Copy, T: Compiled, const V: usize, const PACKED: bool, const I: usize>(
    m: &[[R; V]; V],
    j: usize,
) -> R {
    if PACKED { m.as_flattened()[place::<T, I>(j)] } else { m[I][j] }
}

/// [`entry`] to write.
#[cfg_attr(optimised, inline(always))]
fn entry_mut<R, T: Compiled, const V: usize, const PACKED: bool, const I: usize>(
    m: &mut [[R; V]; V],
    j: usize,
) -> &mut R {
    if PACKED { &mut m.as_flattened_mut()[place::<T, I>(j)] } else { &mut m[I][j] }
}

/// The number that each pivot of M must exceed.
#[cfg_attr(optimised, inline(always))]
fn noise<R: Real, T: Compiled, const V: usize, const PACKED: bool>(m: &[[R; V]; V]) -> [R; V] {
    let mut noise = [R::ZERO; V];
    for_each_joint!(J, {
        if Index::<J, V>::IS_BELOW {
            let diagonal = entry::<R, T, V, PACKED, J>(m, J);
            noise[J] = diagonal * (R::EPSILON * R::from_f64(MATRIX_ROUNDINGS)) + R::MIN_POSITIVE;
        }
    });
    noise
}

/// M's lower triangle becomes L; returns the reciprocals of D, whose pivots must exceed `noise`.
/// Those that are certain to, in any state of numbers, are looked at only if that of a joint on the
/// base does not, to which a NaN spreads.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn decompose<R: Real, T, const V: usize, const PACKED: bool>(
    m: &mut [[R; V]; V],
    noise: &[R; V],
    certain: &[bool; V],
) -> Result<[R; V], NotPositiveDefinite>
where
    T: Compiled,
{
    let (mut d_inv, mut singular) = ([R::ZERO; V], Singular::default());
    for_each_joint_reversed!(K, {
        if Index::<K, V>::IS_BELOW
            && let Some(eliminate) =
                const { only_if(K < V, eliminate::<R, T, V, PACKED, K> as fn(&mut [[R; V]; V], R)) }
        {
            let pivot = entry::<R, T, V, PACKED, K>(m, K);
            if !certain[K] {
                singular.note::<R, K>(pivot, noise[K]);
            }
            d_inv[K] = R::ONE / pivot;
            eliminate(m, d_inv[K]);
        }
    });
    if singular.is_any() {
        for_each_joint!(K, {
            if Index::<K, V>::IS_BELOW && certain[K] {
                singular.note::<R, K>(d_inv[K], -R::ONE);
            }
        });
        singular.outermost()?;
    }
    Ok(d_inv)
}

/// Row K of L, and its share of the rows of its ancestors.
#[cfg_attr(optimised, inline(always))]
fn eliminate<R: Real, T, const V: usize, const PACKED: bool, const K: usize>(
    m: &mut [[R; V]; V],
    d_inv: R,
) where
    T: Compiled,
{
    for_each_joint_reversed!(I, {
        if JointPair::<T, I, K>::IS_ANCESTOR
            && let Some(subtract) = const {
                only_if(
                    JointPair::<T, I, K>::IS_ANCESTOR,
                    subtract::<R, T, V, PACKED, K, I> as fn(&mut [[R; V]; V], R),
                )
            }
        {
            let l = entry::<R, T, V, PACKED, K>(m, I) * d_inv;
            subtract(m, l);
            *entry_mut::<R, T, V, PACKED, K>(m, I) = l;
        }
    });
}

/// Row I less `l` times row K.
#[cfg_attr(optimised, inline(always))]
fn subtract<R: Real, T, const V: usize, const PACKED: bool, const K: usize, const I: usize>(
    m: &mut [[R; V]; V],
    l: R,
) where
    T: Compiled,
{
    for_each_joint!(J, {
        if JointPair::<T, J, I>::SUPPORTS {
            let product = l * entry::<R, T, V, PACKED, K>(m, J);
            *entry_mut::<R, T, V, PACKED, I>(m, J) -= product;
        }
    });
}

/// A function of one row.
type Row<R, const V: usize> = fn(&[[R; V]; V], &mut [R; V]);

/// Lᵀ y = τ, D z = y, L x = z, in place.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn substitute<R: Real, T, const V: usize, const PACKED: bool>(
    l: &[[R; V]; V],
    d_inv: &[R; V],
    x: &mut [R; V],
) where
    T: Compiled,
{
    for_each_joint_reversed!(I, {
        if Index::<I, V>::IS_BELOW
            && let Some(scatter) =
                const { only_if(I < V, scatter::<R, T, V, PACKED, I> as Row<R, V>) }
        {
            scatter(l, x);
        }
    });
    for_each_joint!(I, {
        if Index::<I, V>::IS_BELOW
            && let Some(gather) =
                const { only_if(I < V, gather::<R, T, V, PACKED, I> as Row<R, V>) }
        {
            x[I] *= d_inv[I];
            gather(l, x);
        }
    });
}

/// Subtracts from x_I the products with the entries of its ancestors.
#[cfg_attr(optimised, inline(always))]
fn scatter<R: Real, T, const V: usize, const PACKED: bool, const I: usize>(
    l: &[[R; V]; V],
    x: &mut [R; V],
) where
    T: Compiled,
{
    for_each_joint!(J, {
        if JointPair::<T, J, I>::IS_ANCESTOR {
            x[J] -= entry::<R, T, V, PACKED, I>(l, J) * x[I];
        }
    });
}

/// Subtracts the products with x_I from the entries of its ancestors.
#[cfg_attr(optimised, inline(always))]
fn gather<R: Real, T, const V: usize, const PACKED: bool, const I: usize>(
    l: &[[R; V]; V],
    x: &mut [R; V],
) where
    T: Compiled,
{
    for_each_joint!(J, {
        if JointPair::<T, J, I>::IS_ANCESTOR {
            x[I] -= entry::<R, T, V, PACKED, I>(l, J) * x[J];
        }
    });
}
