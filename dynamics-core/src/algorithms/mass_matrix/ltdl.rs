//! M = Lᵀ D L and M x = τ, without the entries that are zero by the branches of the tree.
//!
//! Featherstone, RBDA (2008), section 6.5, tables 6.3 and 6.5: from the tips to the base, so that
//! no zero is filled. All loops run over the ancestors of a coordinate, λ(i), λ(λ(i)) …

use crate::algorithms::NotPositiveDefinite;
use crate::algorithms::{Ltdl, MassMatrix};
use crate::model::{BASE, RobotModel};
use crate::scalar::Real;
use crate::state::entry;

/// The number of roundings of M_ii that a pivot must exceed: less is a rounding error of zero. Up
/// to 30 were measured for singular M; a straight chain of 64 rods, in f32, has 61.
pub(crate) const MATRIX_ROUNDINGS: f64 = 32.0;

/// The factors L and D of M = Lᵀ D L, with the reciprocals of D, for [`solve`] and [`inverse`].
///
/// L is zero where M is zero. An implicit joint damping is a sum on M's diagonal,
/// [`MassMatrix::plus_diagonal`].
///
/// For each coordinate k from the last to the first, and its ancestors i and j:
///
/// ```text
/// D_k = M_kk      L_ki = M_ki / D_k      M_ij ← M_ij − L_ki D_k L_kj
/// ```
///
/// # Shape
/// V × V and V.
///
/// # Cost
/// V divisions and, on a chain, V (V² − 1)/3 + V (V − 1)/2 other flops; on a tree of branches of
/// depth d at most V d² + V d.
///
/// # Source
/// Featherstone, RBDA (2008), table 6.3.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{crba, ltdl, solve};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let m = crba(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// let x = solve(&Ur5e::MODEL, &ltdl(&Ur5e::MODEL, &m)?, &[1.0; 6]);
/// assert!(m.mul_vec(&x).iter().all(|tau| (tau - 1.0).abs() < 1e-12));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names the outermost coordinate whose pivot is NaN or does not exceed 32
/// roundings of M_ii: it moves no inertia when its descendants are free. Within a joint of several
/// coordinates the rounding errors of each are propagated to those before it. M does not contain
/// the distances of the frames in which it was computed: if they are much larger than those of the
/// moving masses, the rounding error of a singular M may be larger than this bound; the articulated
/// bodies of [`aba`](crate::algorithms::aba()) and
/// [`spatial_operator_ltdl`](crate::algorithms::spatial_operator_ltdl()) reject it.
#[doc(alias = "LTL")]
#[doc(alias = "factor")]
#[cfg_attr(optimised, inline(always))]
pub fn ltdl<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    m: &MassMatrix<R, V>,
) -> Result<Ltdl<R, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
{
    let lambda = &robot.model().lambda;
    let (mut rows, mut d_inv) = (m.rows, [R::ZERO; V]);
    let mut sizes = Sizes::of(robot, m);
    for k in (0..V).rev() {
        let (ancestors, at) = rows.split_at_mut(k);
        let (Some(row), Some(d_inv)) = (at.first_mut(), d_inv.get_mut(k)) else {
            break;
        };
        let pivot = row.get(k).copied().unwrap_or_default();
        check(pivot, sizes.noise(k), k)?;
        *d_inv = R::ONE / pivot;
        let mut i = parent(lambda, k);
        while let Some(row_i) = ancestors.get_mut(i) {
            let l = row.get(i).copied().unwrap_or_default() * *d_inv;
            if !D::SINGLE {
                sizes.add_error_of(k, i, l);
            }
            let mut j = i;
            while let (Some(m_ij), Some(&m_kj)) = (row_i.get_mut(j), row.get(j)) {
                *m_ij -= l * m_kj;
                j = parent(lambda, j);
            }
            if let Some(entry) = row.get_mut(i) {
                *entry = l;
            }
            i = parent(lambda, i);
        }
    }
    Ok(Ltdl { rows, d_inv })
}

/// The same in the place of M, D on its diagonal: without copies of the matrix, which take as long
/// as the factors of a tree with many branches. [`ltdl`] does not call it, since the machine code
/// of trees without loops would change.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn ltdl_in_place<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    m: &mut MassMatrix<R, V>,
) -> Result<(), NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
{
    let lambda = &robot.model().lambda;
    let mut sizes = Sizes::of(robot, m);
    for k in (0..V).rev() {
        let (ancestors, at) = m.rows.split_at_mut(k);
        let Some(row) = at.first_mut() else {
            break;
        };
        let pivot = entry(row, k);
        check(pivot, sizes.noise(k), k)?;
        let d_inv = R::ONE / pivot;
        let mut i = parent(lambda, k);
        while let Some(row_i) = ancestors.get_mut(i) {
            let l = entry(row, i) * d_inv;
            if !D::SINGLE {
                sizes.add_error_of(k, i, l);
            }
            let mut j = i;
            while let (Some(m_ij), Some(&m_kj)) = (row_i.get_mut(j), row.get(j)) {
                *m_ij -= l * m_kj;
                j = parent(lambda, j);
            }
            if let Some(entry) = row.get_mut(i) {
                *entry = l;
            }
            i = parent(lambda, i);
        }
    }
    Ok(())
}

/// The solution x of M x = τ: accelerations of torques, rad/s² or m/s² of N·m or N.
///
/// ```text
/// Lᵀ y = τ      D z = y      L x = z
/// ```
///
/// # Shape
/// V.
///
/// # Cost
/// 2 V² − V flops on a chain, less on a tree.
///
/// # Source
/// Featherstone, RBDA (2008), table 6.5.
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn solve<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    factor: &Ltdl<R, V>,
    tau: &[R; V],
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
{
    let (lambda, mut x) = (&robot.model().lambda, *tau);
    // Lᵀ y = τ
    for (i, row) in factor.rows.iter().enumerate().rev() {
        let (ancestors, at) = x.split_at_mut(i);
        let x_i = at.first().copied().unwrap_or_default();
        let mut j = parent(lambda, i);
        while let (Some(x_j), Some(&l)) = (ancestors.get_mut(j), row.get(j)) {
            *x_j -= l * x_i;
            j = parent(lambda, j);
        }
    }
    // D z = y and L x = z
    for (i, (row, &d_inv)) in factor.rows.iter().zip(&factor.d_inv).enumerate() {
        let (ancestors, at) = x.split_at_mut(i);
        let Some(x_i) = at.first_mut() else {
            break;
        };
        *x_i *= d_inv;
        let mut j = parent(lambda, i);
        while let (Some(&x_j), Some(&l)) = (ancestors.get(j), row.get(j)) {
            *x_i -= l * x_j;
            j = parent(lambda, j);
        }
    }
    x
}

/// The inverse M⁻¹, a column at a time: accelerations of unit torques.
///
/// Unlike M it has zeros only between separate roots.
///
/// # Shape
/// V × V.
///
/// # Cost
/// V solutions: 2 V³ flops on a chain.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{crba, inverse, ltdl};
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let m = crba(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// let m_inv = inverse(&Ur5e::MODEL, &ltdl(&Ur5e::MODEL, &m)?);
/// assert!(m_inv.get(5, 5) * m.get(5, 5) > 1.0); // the other joints give way
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn inverse<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    factor: &Ltdl<R, V>,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
{
    let mut m_inv = MassMatrix::ZERO;
    for j in 0..V {
        let unit = core::array::from_fn(|i| if i == j { R::ONE } else { R::ZERO });
        let column = solve(robot, factor, &unit);
        for (i, &x) in column.iter().enumerate().skip(j) {
            m_inv.set(i, j, x);
        }
    }
    m_inv
}

/// The bounds of the pivots of M.
pub(crate) struct Sizes<R, const V: usize> {
    /// M_ii, and within a joint the errors propagated from the coordinates after it.
    sizes: [R; V],
    /// The first coordinate of the joint that each one belongs to.
    firsts: [usize; V],
}

impl<R: Real, const V: usize> Sizes<R, V> {
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of<D, const B: usize, const Q: usize>(robot: &D, m: &MassMatrix<R, V>) -> Self
    where
        D: RobotModel<R, B, Q, V>,
    {
        let mut firsts = [0; V];
        if !D::SINGLE {
            for link in robot.links() {
                let joint = link.coordinates();
                let own = firsts.get_mut(joint.clone()).unwrap_or_default();
                own.fill(joint.start);
            }
        }
        let sizes = core::array::from_fn(|k| m.get(k, k));
        Self { sizes, firsts }
    }

    /// The rounding error of pivot `k`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn noise(&self, k: usize) -> R {
        entry(&self.sizes, k) * (R::EPSILON * R::from_f64(MATRIX_ROUNDINGS))
    }

    /// Row `k`, subtracted `l` times from row `i`, adds its rounding errors if both are of one
    /// joint.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn add_error_of(&mut self, k: usize, i: usize, l: R) {
        let size = entry(&self.sizes, k);
        if i >= entry(&self.firsts, k)
            && let Some(inherited) = self.sizes.get_mut(i)
        {
            *inherited += l * l * size;
        }
    }
}

/// Whether a pivot is a number and more than a rounding error.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn check<R: Real>(pivot: R, noise: R, joint: usize) -> Result<(), NotPositiveDefinite> {
    // Comparisons that a NaN fails too, and that zero on zero does.
    if pivot > noise && pivot > R::ZERO && pivot.is_finite() {
        return Ok(());
    }
    Err(NotPositiveDefinite { joint })
}

/// λ of a coordinate.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn parent<const V: usize>(lambda: &[usize; V], i: usize) -> usize {
    lambda.get(i).copied().unwrap_or(BASE)
}
