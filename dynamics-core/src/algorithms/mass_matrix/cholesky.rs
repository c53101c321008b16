//! M = Lᵀ L, without the entries that are zero by the branches of the tree.
//!
//! Featherstone, RBDA (2008), section 6.5, table 6.4. [`ltdl`](crate::algorithms::ltdl()) computes
//! the factors without roots, and is preferable, except where a root of M is needed: M⁻¹ = L⁻¹ L⁻ᵀ.

use crate::algorithms::MassMatrix;
use crate::algorithms::NotPositiveDefinite;
use crate::algorithms::mass_matrix::{Sizes, check, parent};
use crate::model::RobotModel;
use crate::scalar::Real;

/// M = Lᵀ L, L lower triangular with a positive diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cholesky<R, const V: usize> {
    /// L below the diagonal; the rest is not used.
    rows: [[R; V]; V],
    /// The reciprocals of L's diagonal, 1/(√kg·m) or 1/√kg.
    l_inv: [R; V],
}

/// The factor L of M = Lᵀ L, with the reciprocals of its diagonal, for [`Cholesky::solve`].
///
/// ```text
/// M = Lᵀ L      M⁻¹ = L⁻¹ L⁻ᵀ
/// ```
///
/// # Shape
/// V × V and V.
///
/// # Cost
/// V roots and, on a chain, V (V² − 1)/3 + V (V − 1)/2 other flops, less on a tree.
///
/// # Source
/// Featherstone, RBDA (2008), table 6.4.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{cholesky, crba};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let m = crba(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// let x = cholesky(&Ur5e::MODEL, &m)?.solve(&Ur5e::MODEL, &[1.0; 6]);
/// assert!(m.mul_vec(&x).iter().all(|tau| (tau - 1.0).abs() < 1e-12));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// As [`ltdl`](crate::algorithms::ltdl()).
#[doc(alias = "LTL")]
#[cfg_attr(optimised, inline(always))]
pub fn cholesky<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    m: &MassMatrix<R, V>,
) -> Result<Cholesky<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
{
    let lambda = &robot.model().lambda;
    let (mut rows, mut l_inv) = (m.rows, [R::ZERO; V]);
    let mut sizes = Sizes::of(robot, m);
    for k in (0..V).rev() {
        let (ancestors, at) = rows.split_at_mut(k);
        let (Some(row), Some(l_inv)) = (at.first_mut(), l_inv.get_mut(k)) else {
            break;
        };
        let pivot = row.get(k).copied().unwrap_or_default();
        check(pivot, sizes.noise(k), k)?;
        *l_inv = pivot.rsqrt();
        let mut i = parent(lambda, k);
        while let Some(l_ki) = row.get_mut(i) {
            *l_ki *= *l_inv;
            if !D::SINGLE {
                sizes.add_error_of(k, i, *l_ki * *l_inv);
            }
            i = parent(lambda, i);
        }
        i = parent(lambda, k);
        while let (Some(row_i), Some(&l_ki)) = (ancestors.get_mut(i), row.get(i)) {
            let mut j = i;
            while let (Some(m_ij), Some(&l_kj)) = (row_i.get_mut(j), row.get(j)) {
                *m_ij -= l_ki * l_kj;
                j = parent(lambda, j);
            }
            i = parent(lambda, i);
        }
    }
    Ok(Cholesky { rows, l_inv })
}

impl<R: Real, const V: usize> Cholesky<R, V> {
    /// The factor whose L has these rows, √kg·m or √kg, of which the entries below the diagonal are
    /// read, and these reciprocals of its diagonal.
    #[must_use]
    pub const fn from_rows(rows: [[R; V]; V], l_inv: [R; V]) -> Self {
        Self { rows, l_inv }
    }

    /// L_ij below the diagonal, √kg·m or √kg; zero elsewhere.
    pub fn get(&self, i: usize, j: usize) -> R {
        let row = self.rows.get(i).filter(|_| j < i);
        row.and_then(|row| row.get(j)).copied().unwrap_or_default()
    }

    /// The reciprocals of L's diagonal, 1/(√kg·m) or 1/√kg.
    ///
    /// ```
    /// use dynamics_core::algorithms::{Cholesky, cholesky, crba};
    /// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
    /// let factor = cholesky(&Ur5e::MODEL, &crba(&Ur5e::MODEL, &[0.3; 6], &RIGID_BODY))?;
    /// let rows = core::array::from_fn(|i| core::array::from_fn(|j| factor.get(i, j)));
    /// let same = Cholesky::from_rows(rows, *factor.l_inv());
    /// assert_eq!(same.solve(&Ur5e::MODEL, &[1.0; 6]), factor.solve(&Ur5e::MODEL, &[1.0; 6]));
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    pub fn l_inv(&self) -> &[R; V] {
        &self.l_inv
    }

    /// x with M x = τ: L⁻¹ L⁻ᵀ τ. Cost: 2 V² flops on a chain, less on a tree.
    #[cfg_attr(optimised, inline(always))]
    pub fn solve<D, const B: usize, const Q: usize>(&self, robot: &D, tau: &[R; V]) -> [R; V]
    where
        D: RobotModel<R, B, Q, V>,
    {
        let (lambda, mut x) = (&robot.model().lambda, *tau);
        for (i, (row, &l_inv)) in self.rows.iter().zip(&self.l_inv).enumerate().rev() {
            let (ancestors, at) = x.split_at_mut(i);
            let Some(x_i) = at.first_mut() else {
                break;
            };
            *x_i *= l_inv;
            let mut j = parent(lambda, i);
            while let (Some(x_j), Some(&l)) = (ancestors.get_mut(j), row.get(j)) {
                *x_j -= l * *x_i;
                j = parent(lambda, j);
            }
        }
        for (i, (row, &l_inv)) in self.rows.iter().zip(&self.l_inv).enumerate() {
            let (ancestors, at) = x.split_at_mut(i);
            let Some(x_i) = at.first_mut() else {
                break;
            };
            let mut j = parent(lambda, i);
            while let (Some(&x_j), Some(&l)) = (ancestors.get(j), row.get(j)) {
                *x_i -= l * x_j;
                j = parent(lambda, j);
            }
            *x_i *= l_inv;
        }
        x
    }
}
