//! The joint-space inertia matrix M(q).

mod cholesky;
mod ltdl;
mod spatial_operator;

pub use cholesky::{Cholesky, cholesky};
pub(crate) use ltdl::{MATRIX_ROUNDINGS, ltdl_in_place};
pub(super) use ltdl::{Sizes, check, parent};
pub use ltdl::{inverse, ltdl, solve};
pub use spatial_operator::{spatial_operator_inverse, spatial_operator_ltdl};

use crate::scalar::Real;

/// M(q), symmetric, V × V: kg·m² between revolute joints, kg between prismatic ones, kg·m mixed.
///
/// Row i holds the torques of all joints that accelerate joint i alone by one, without gravity and
/// velocities. M is positive definite. Source: Featherstone, RBDA (2008), chapter 6. The equation
/// of motion and the kinetic energy are
///
/// ```text
/// M(q) q̈ + C(q, q̇) = τ      T = ½ q̇ᵀ M(q) q̇
/// ```
///
/// ```
/// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e};
/// let m = Engine::<Ur5e>::crba(&[0.0_f32, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// assert!(m.get(1, 1) > m.get(5, 5) && m.get(5, 5) > 0.0);
/// assert_eq!(m.get(0, 3), m.get(3, 0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassMatrix<R, const V: usize> {
    pub(crate) rows: [[R; V]; V],
}

impl<R: Real, const V: usize> MassMatrix<R, V> {
    /// The matrix of zeros, kg·m² or kg.
    pub const ZERO: Self = Self { rows: [[R::ZERO; V]; V] };

    /// A matrix of these rows, of which the entries up to the diagonal are read: kg·m² or kg.
    ///
    /// ```
    /// use dynamics_core::algorithms::MassMatrix;
    /// let m = MassMatrix::from_rows([[2.0, 0.0], [0.5, 1.0]]);
    /// assert_eq!(m.get(0, 1), 0.5);
    /// ```
    #[must_use]
    pub fn from_rows(rows: [[R; V]; V]) -> Self {
        Self { rows }.mirrored()
    }

    /// M_ij; zero beyond the matrix.
    #[cfg_attr(optimised, inline(always))]
    pub fn get(&self, i: usize, j: usize) -> R {
        let row = self.rows.get(i).and_then(|row| row.get(j));
        row.copied().unwrap_or_default()
    }

    /// Row i.
    #[cfg_attr(optimised, inline(always))]
    pub fn row(&self, i: usize) -> Option<&[R; V]> {
        self.rows.get(i)
    }

    /// M x: torques of accelerations, N·m or N of rad/s² or m/s². 2 V² − V flops.
    pub fn mul_vec(&self, x: &[R; V]) -> [R; V] {
        self.rows.map(|row| {
            let products = row.iter().zip(x).map(|(&m, &x)| m * x);
            products.fold(R::ZERO, |sum, product| sum + product)
        })
    }

    /// M + diag(d): with d = h b, the matrix of an implicit step of h seconds with a damping b.
    ///
    /// ```
    /// use dynamics_core::algorithms::{forward_dynamics, ltdl, rnea, solve};
    /// use dynamics_core::effects::{Coriolis, Gravity, Inertia, Viscous};
    /// use dynamics_core::{Core, model::Robot, robots::Ur5e, state::State};
    ///
    /// // A damping so stiff that an explicit step of 10 ms overshoots: q̇ is thrown back beyond zero.
    /// let (h, b) = (0.01, [200.0_f64; 6]);
    /// let scene = (Gravity::EARTH, Inertia, Coriolis, Viscous(b));
    /// let state = State { qd: [0.1; 6], ..State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]) };
    /// let tau = [0.0; 6];
    /// let explicit = forward_dynamics(&Ur5e::MODEL, &state, &tau, &scene)?;
    /// assert!(state.qd[5] + h * explicit[5] < -100.0);
    ///
    /// // (M + h b) q̈ = τ − C(q, q̇) − b q̇ takes the damping at the end of the step: q̇ dies out.
    /// let bias = rnea(&Ur5e::MODEL, &state, &scene); // its q̈ is zero
    /// let m = Core::<Ur5e>::crba(&state.q, &scene).plus_diagonal(&b.map(|b| h * b));
    /// let rest = core::array::from_fn(|i| tau[i] - bias[i]);
    /// let implicit = solve(&Ur5e::MODEL, &ltdl(&Ur5e::MODEL, &m)?, &rest);
    /// assert!((state.qd[5] + h * implicit[5]).abs() < 0.1);
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    #[must_use]
    pub fn plus_diagonal(mut self, d: &[R; V]) -> Self {
        for (i, &d) in d.iter().enumerate() {
            if let Some(diagonal) = self.diagonal_mut(i) {
                *diagonal += d;
            }
        }
        self
    }

    /// Sets M_ij and M_ji.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn set(&mut self, i: usize, j: usize, value: R) {
        if let Some(entry) = self.rows.get_mut(i).and_then(|row| row.get_mut(j)) {
            *entry = value;
        }
        if let Some(entry) = self.rows.get_mut(j).and_then(|row| row.get_mut(i)) {
            *entry = value;
        }
    }

    /// The symmetric matrix of which the triangle up to the diagonal is written.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn mirrored(mut self) -> Self {
        if V > UNROLLED {
            self.mirror();
        } else {
            mirror(&mut self.rows);
        }
        self
    }

    /// Writes the triangle up to the diagonal into the other, in a call.
    #[inline(never)]
    pub(crate) fn mirror(&mut self) {
        mirror(&mut self.rows);
    }

    /// M_ii.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn diagonal_mut(&mut self, i: usize) -> Option<&mut R> {
        self.rows.get_mut(i).and_then(|row| row.get_mut(i))
    }
}

/// The largest order whose copies the compiler writes out in place.
pub(crate) const UNROLLED: usize = 8;

/// Writes the triangle up to the diagonal into the other.
#[cfg_attr(optimised, inline(always))]
fn mirror<R: Copy, const V: usize>(rows: &mut [[R; V]; V]) {
    for i in 1..V {
        let Some((above, [row, ..])) = rows.split_at_mut_checked(i) else {
            break;
        };
        for (column, &entry) in above.iter_mut().zip(&*row) {
            if let Some(mirror) = column.get_mut(i) {
                *mirror = entry;
            }
        }
    }
}

/// M = Lᵀ D L: L lower triangular with a unit diagonal, D diagonal and positive.
///
/// Featherstone, RBDA (2008), section 6.5: L is zero wherever M is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ltdl<R, const V: usize> {
    /// L below the diagonal; the rest is not used.
    pub(crate) rows: [[R; V]; V],
    /// The reciprocals of D.
    pub(crate) d_inv: [R; V],
}

impl<R: Real, const V: usize> Ltdl<R, V> {
    /// The factors whose L has these rows, of which the entries below the diagonal are read, and
    /// these reciprocals of D, 1/(kg·m²) or 1/kg.
    ///
    /// ```
    /// use dynamics_core::{Core, Ltdl, effects::RIGID_BODY, robots::Ur5e};
    /// let factors = Core::<Ur5e>::ltdl(&Core::<Ur5e>::crba(&[0.3_f64; 6], &RIGID_BODY))?;
    /// let rows = core::array::from_fn(|i| core::array::from_fn(|j| factors.get(i, j)));
    /// let same = Ltdl::from_rows(rows, *factors.d_inv());
    /// assert_eq!(Core::<Ur5e>::solve(&same, &[1.0; 6]), Core::<Ur5e>::solve(&factors, &[1.0; 6]));
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    #[must_use]
    pub const fn from_rows(rows: [[R; V]; V], d_inv: [R; V]) -> Self {
        Self { rows, d_inv }
    }

    /// L_ij: one on the diagonal, zero above it and beyond the matrix.
    #[cfg_attr(optimised, inline(always))]
    pub fn get(&self, i: usize, j: usize) -> R {
        match self.rows.get(i).and_then(|row| row.get(j)) {
            Some(_) if i == j => R::ONE,
            Some(&l) if j < i => l,
            _ => R::ZERO,
        }
    }

    /// The reciprocals of D: the acceleration of each coordinate under a unit torque when its
    /// ancestors are fixed and its descendants are free.
    #[cfg_attr(optimised, inline(always))]
    pub fn d_inv(&self) -> &[R; V] {
        &self.d_inv
    }
}
