//! The joint-space inertia matrix M(q).

use crate::scalar::Real;

/// M(q), symmetric, V × V: kg·m² between revolute joints, kg between prismatic ones, kg·m mixed.
///
/// Row i holds the torques of all joints that accelerate joint i alone by one, without gravity and
/// velocities; ½ q̇ᵀ M q̇ is the kinetic energy. Positive definite. Source: Featherstone, RBDA (2008),
/// chapter 6.
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
    pub(crate) const ZERO: Self = Self {
        rows: [[R::ZERO; V]; V],
    };

    /// M_ij; zero beyond the matrix.
    #[inline(always)]
    pub fn get(&self, i: usize, j: usize) -> R {
        let row = self.rows.get(i).and_then(|row| row.get(j));
        row.copied().unwrap_or_default()
    }

    /// Row i.
    #[inline(always)]
    pub fn row(&self, i: usize) -> Option<&[R; V]> {
        self.rows.get(i)
    }
}

/// M = Lᵀ D L: L lower triangular with a unit diagonal, D diagonal and positive.
///
/// Featherstone, RBDA (2008), section 6.5: L is zero wherever M is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor<R, const V: usize> {
    /// L below the diagonal; the rest is not used.
    pub(crate) rows: [[R; V]; V],
    /// The reciprocals of D.
    pub(crate) per_d: [R; V],
}
