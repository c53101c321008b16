//! M(q) without the entries that the tree fixes, one entry behind the other.

use core::marker::PhantomData;

use super::compile::{Compiled, CompiledJoint, CompiledRobot};
use crate::algorithms::MassMatrix;
use crate::model::Robot;
use crate::scalar::Real;

/// M(q) of the robot T up to the diagonal, without the entries that are zero by the branches of
/// its tree: kg·m² between revolute joints, kg between prismatic ones, kg·m mixed.
///
/// A tick stores no zero and nothing twice: [`Engine::tree_crba`](crate::Engine::tree_crba) writes
/// it, [`Engine::tree_ltdl`](crate::Engine::tree_ltdl) factors it in its place. It is for trees with
/// branches and for many joints; the factors of an arm of six stay in registers with
/// [`Engine::ltdl`](crate::Engine::ltdl). Source: Featherstone, RBDA (2008), section 6.4.
///
/// ```
/// use dynamics_core::{Engine, TreeMatrix, effects::RIGID_BODY, robots::A1};
/// let mut m = TreeMatrix::ZERO;
/// Engine::<A1>::tree_crba(&[0.3_f32; 12], &RIGID_BODY, &mut m);
/// let m = m.square();
/// assert!(m.get(2, 0) == m.get(0, 2) && m.get(2, 0) != 0.0);
/// assert_eq!(m.get(3, 0), 0.0); // of two legs
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeMatrix<T, R, const V: usize> {
    /// By rows, the entries of a joint's ancestors and its own, from the first place on.
    pub(super) entries: [[R; V]; V],
    robot: PhantomData<T>,
}

impl<T, R: Real, const V: usize> TreeMatrix<T, R, V> {
    /// The matrix of zeros, kg·m² or kg.
    pub const ZERO: Self = Self { entries: [[R::ZERO; V]; V], robot: PhantomData };

    /// The whole of M, with both triangles and all zeros.
    #[must_use]
    pub fn square<const B: usize, const Q: usize>(&self) -> MassMatrix<R, V>
    where
        T: Robot<B, Q, V>,
    {
        let mut rows = [[R::ZERO; V]; V];
        let mut entries = self.entries.as_flattened().iter();
        for (row, support) in rows.iter_mut().zip(CompiledRobot::<T, B, Q, V>::SUPPORT) {
            for (j, entry) in row.iter_mut().enumerate() {
                if support & (1 << j) != 0 {
                    *entry = entries.next().copied().unwrap_or_default();
                }
            }
        }
        MassMatrix::from_rows(rows)
    }
}

/// M = Lᵀ D L in the place of a [`TreeMatrix`]: L lower triangular with a unit diagonal, D diagonal
/// and positive. Source: Featherstone, RBDA (2008), section 6.5.
///
/// ```
/// use dynamics_core::{Engine, TreeMatrix, effects::RIGID_BODY, robots::A1};
/// let mut m = TreeMatrix::ZERO; // once, before the loop
/// Engine::<A1>::tree_crba(&[0.3_f32; 12], &RIGID_BODY, &mut m);
/// let x = Engine::<A1>::tree_solve(&Engine::<A1>::tree_ltdl(&mut m)?, &[1.0; 12]);
/// # let m = Engine::<A1>::crba(&[0.3_f32; 12], &RIGID_BODY);
/// # assert_eq!(x, Engine::<A1>::solve(&Engine::<A1>::ltdl(&m)?, &[1.0; 12]));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[derive(Debug)]
pub struct TreeLtdl<'m, T, R, const V: usize> {
    /// L beside the diagonal, which is not used.
    pub(super) m: &'m TreeMatrix<T, R, V>,
    /// The reciprocals of D.
    pub(super) d_inv: [R; V],
}

/// The number of entries before that of joint I and its ancestor j, or its own.
#[cfg_attr(optimised, inline(always))]
pub(super) fn place<T: Compiled, const I: usize>(j: usize) -> usize {
    let before = T::SUPPORT[I] & ((1 << j) - 1);
    CompiledJoint::<T, I>::ROW + before.count_ones() as usize
}
