//! Base parameters by selection: the columns of the regressor that explain the torques of a motion.
//!
//! With Y = [Y_s Y_d] and Y_d = Y_s K, τ = Y_s (θ_s + K θ_d): the torque needs the columns of the
//! selection alone, and what they multiply are the base parameters β = K_β θ, K_β = [1 K]. Gautier,
//! "Numerical calculation of the base inertial parameters of robots" (1991), selects by QR with
//! pivots; here YᵀY is eliminated with pivots, which are the same columns.

use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// A pivot below this share of the first one is rounding.
const RANK: f64 = 1e-13;

/// The sum Yᵀ Y of the rows of a motion, by N columns: the ten parameters of each body, then those
/// of each joint. On the host.
///
/// ```
/// use motion_control::estimate::{Excitation, SelectedParameters};
/// let mut motion: Excitation<3> = Excitation::new();
/// for t in 0..10 {
///     let t = f64::from(t);
///     motion.add(&[t, 2.0 * t, t * t], 0.1); // the second parameter is not distinguished from the first
/// }
/// // Three parameters of joints, no body.
/// let base: SelectedParameters<f64, 2, 3> = motion.select::<_, 0, _>(&[1.0; 3], 0.3).expect("two independent columns");
/// assert_eq!(base.columns, [1, 2]);
/// assert_eq!(motion.select::<f64, 0, 3>(&[1.0; 3], 0.3), Err(2));
/// ```
#[doc(alias = "identifiability")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excitation<const N: usize>([[f64; N]; N]);

impl<const N: usize> Default for Excitation<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Excitation<N> {
    /// Without a row.
    #[must_use]
    pub const fn new() -> Self {
        Self([[0.0; N]; N])
    }

    /// Adds the row of a joint, whose torque has noise of this standard deviation.
    pub fn add(&mut self, row: &[f64; N], noise: f64) {
        for (sums, a) in self.0.iter_mut().zip(row) {
            for (sum, b) in sums.iter_mut().zip(row) {
                *sum += a * b / (noise * noise);
            }
        }
    }

    /// The P base parameters that most change the torques, if each nominal parameter of a joint and
    /// each pseudo-inertia of the B bodies has this relative standard deviation in every direction.
    ///
    /// If fewer than all base parameters are selected, the torques of the others remain those of
    /// the nominal model. A parameter of a joint that is zero remains zero.
    ///
    /// # Errors
    /// The number of independent columns of the motion, if there are fewer than P.
    ///
    /// # Source
    /// Gautier (1991); Pham & Gautier, "Essential parameters of robots" (1991); the metric of
    /// pseudo-inertias J after Lee, Wensing & Park, "Geometric robot dynamic identification"
    /// (2020): the covariance of a change of J is that of J^½ Z J^½.
    pub fn select<R: Real, const B: usize, const P: usize>(
        &self,
        nominal: &[f64; N],
        share: f64,
    ) -> Result<SelectedParameters<R, P, N>, usize> {
        let covariance = covariance::<B, N>(nominal, share);
        let (mut a, mut free) = (self.0, [true; N]);
        let (mut columns, mut first) = ([0; P], 0.0);
        for (rank, column) in columns.iter_mut().enumerate() {
            let (mut k, mut most) = (0, 0.0);
            for i in (0..N).filter(|&i| free[i]) {
                let effect = a[i][i] * covariance[i][i];
                if effect > most {
                    (k, most) = (i, effect);
                }
            }
            first = if rank == 0 { most } else { first };
            if most <= RANK * first {
                return Err(rank);
            }
            (*column, free[k]) = (k, false);
            sweep(&mut a, k);
        }
        columns.sort_unstable();
        // Row k of K_β, its covariance with the N parameters, and that with the other rows.
        let of = |row: usize, i: usize| match free[i] {
            true => a[columns[row]][i],
            false => f64::from(u8::from(columns[row] == i)),
        };
        let with: [[f64; P]; N] =
            covariance.map(|row| core::array::from_fn(|k| (0..N).map(|i| row[i] * of(k, i)).sum()));
        let mut own: [[f64; P]; P] = core::array::from_fn(|k| {
            core::array::from_fn(|l| (0..N).map(|i| of(k, i) * with[i][l]).sum())
        });
        let prior = core::array::from_fn(|k| R::from_f64(own[k][k].sqrt()));
        (0..P).for_each(|k| sweep(&mut own, k));
        let spread = with.map(|row| {
            core::array::from_fn(|l| R::from_f64((0..P).map(|k| row[k] * own[k][l]).sum()))
        });
        Ok(SelectedParameters { columns, prior, spread })
    }
}

/// The covariance of the parameters: of the bodies' entries J_ij and J_kl ½ s² (J_ik J_jl + J_il
/// J_jk).
fn covariance<const B: usize, const N: usize>(nominal: &[f64; N], share: f64) -> [[f64; N]; N] {
    /// Each parameter as a sum of entries of J with signs; the last three are those of Σ.
    const ENTRIES: [&[(usize, usize, f64)]; 10] = [
        &[(3, 3, 1.0)],
        &[(0, 3, 1.0)],
        &[(1, 3, 1.0)],
        &[(2, 3, 1.0)],
        &[(1, 1, 1.0), (2, 2, 1.0)],
        &[(0, 1, -1.0)],
        &[(0, 0, 1.0), (2, 2, 1.0)],
        &[(0, 2, -1.0)],
        &[(1, 2, -1.0)],
        &[(0, 0, 1.0), (1, 1, 1.0)],
    ];
    let mut covariance = [[0.0; N]; N];
    let square = share * share;
    for (i, row) in covariance.iter_mut().enumerate() {
        row[i] = nominal[i] * nominal[i] * square;
    }
    for (body, phi) in bodies::<f64, B>(nominal).enumerate() {
        let inertia = pseudo_inertia(phi);
        for (a, first) in ENTRIES.iter().enumerate() {
            for (b, second) in ENTRIES.iter().enumerate() {
                let mut sum = 0.0;
                for &(i, j, sign) in *first {
                    for &(k, l, other) in *second {
                        let product = inertia[i][k] * inertia[j][l] + inertia[i][l] * inertia[j][k];
                        sum += 0.5 * square * sign * other * product;
                    }
                }
                covariance[10 * body + a][10 * body + b] = sum;
            }
        }
    }
    covariance
}

/// Sweeps a symmetric matrix by pivot k: Goodnight, "A tutorial on the SWEEP operator" (1979). The
/// swept columns then hold the inverse of their block, the others of the swept rows its products
/// with them, the rest what remains of them.
fn sweep<const N: usize>(a: &mut [[f64; N]; N], k: usize) {
    let pivot = a[k];
    let per = 1.0 / pivot[k];
    for (i, row) in a.iter_mut().enumerate() {
        let share = row[k] * per;
        for (x, p) in row.iter_mut().zip(pivot) {
            *x = if i == k { p * per } else { *x - share * p };
        }
        row[k] = if i == k { per } else { -share };
    }
}

/// P base parameters of an arm among the N parameters of its bodies and joints: constants for the
/// tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelectedParameters<R, const P: usize, const N: usize> {
    /// The columns of the regressor that they multiply: those of the bodies first, then those of
    /// the joints, joint by joint.
    pub columns: [usize; P],
    /// The standard deviation of each, from those of the N parameters.
    pub prior: [R; P],
    /// The smallest change of the N parameters per unit of each base parameter, smallest in terms
    /// of their standard deviations.
    pub spread: [[R; P]; N],
}

impl<R: Real, const P: usize, const N: usize> SelectedParameters<R, P, N> {
    /// The row of a joint: from its [`regressor_row`](dynamics_core::algorithms::regressor_row),
    /// and the F columns of its own friction and armature. P selections, no flops.
    #[inline(always)]
    #[must_use]
    pub fn row<const B: usize, const F: usize>(
        &self,
        joint: usize,
        bodies: &[[R; 10]; B],
        own: &[R; F],
    ) -> [R; P] {
        self.columns.map(|column| picked(column, joint, bodies, own))
    }

    /// The bodies of which a parameter is among them: for
    /// [`regressor_row_of_bodies`](dynamics_core::algorithms::regressor_row_of_bodies).
    #[must_use]
    pub fn bodies<const B: usize>(&self) -> [bool; B] {
        let mut bodies = [false; B];
        for column in self.columns {
            if let Some(is_in) = bodies.get_mut(column / 10) {
                *is_in = true;
            }
        }
        bodies
    }

    /// The number of them that are parameters of each joint, of `each` that a joint has; the others
    /// are of the `bodies`:
    /// [`ParameterEstimatorConfig::own`](super::ParameterEstimatorConfig::own).
    ///
    /// ```
    /// use motion_control::estimate::SelectedParameters;
    /// // The mass of the first of two bodies, Coulomb friction of the first of two joints, both frictions of the second.
    /// let base = SelectedParameters::<f32, 4, 24> { columns: [0, 21, 22, 23], prior: [1.0; 4], spread: [[0.0; 4]; 24] };
    /// assert_eq!((base.own(2, 2), base.bodies()), ([1, 2], [true, false]));
    /// ```
    #[must_use]
    pub fn own<const V: usize>(&self, bodies: usize, each: usize) -> [u16; V] {
        let mut own = [0; V];
        for column in self.columns {
            let place = column.checked_sub(10 * bodies);
            let joint = place.and_then(|place| place.checked_div(each));
            if let Some(count) = joint.and_then(|joint| own.get_mut(joint)) {
                *count += 1;
            }
        }
        own
    }

    /// The change of the N parameters that gives the estimated base parameters.
    #[must_use]
    pub fn change(&self, estimate: &[R; P]) -> [R; N] {
        self.spread.map(|row| super::dot(&row, estimate))
    }
}

impl<const N: usize> Excitation<N> {
    /// All N columns of the row of a joint, in the order that [`SelectedParameters::row`] selects
    /// from.
    #[must_use]
    pub fn row<R: Real, const B: usize, const F: usize>(
        joint: usize,
        bodies: &[[R; 10]; B],
        own: &[R; F],
    ) -> [R; N] {
        core::array::from_fn(|column| picked(column, joint, bodies, own))
    }
}

/// One column of the row of a joint.
#[inline(always)]
fn picked<R: Real, const B: usize, const F: usize>(
    column: usize,
    joint: usize,
    bodies: &[[R; 10]; B],
    own: &[R; F],
) -> R {
    let bodies = bodies.as_flattened();
    bodies.get(column).copied().unwrap_or_else(|| {
        let place = column.wrapping_sub(bodies.len().wrapping_add(joint.wrapping_mul(F)));
        crate::entry(own, place)
    })
}

/// The parameters of each body.
pub(super) fn bodies<R, const B: usize>(all: &[R]) -> impl Iterator<Item = &[R; 10]> {
    all.as_chunks::<10>().0.iter().take(B)
}

/// \[Σ h; hᵀ m\].
pub(super) fn pseudo_inertia<R: Real>(body: &[R; 10]) -> [[R; 4]; 4] {
    let [m, x, y, z, xx, xy, yy, xz, yz, zz] = *body;
    let half = R::from_f64(0.5) * (xx + yy + zz);
    [[half - xx, -xy, -xz, x], [-xy, half - yy, -yz, y], [-xz, -yz, half - zz, z], [x, y, z, m]]
}
