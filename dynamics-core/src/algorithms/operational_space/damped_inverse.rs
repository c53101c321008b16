//! The inverse of a symmetric matrix, damped near singularities.
//!
//! The damping begins smoothly (after Nakamura & Hanafusa, 1986, and Chiaverini, 1997): the inverse
//! of an eigenvalue λ below the threshold ε is replaced by a function that has the value and slope
//! of 1/λ at ε and goes to zero with λ:
//!
//! ```text
//! 1/λ becomes λ / (λ² + (ε − λ)²) for λ < ε
//! ```
//!
//! The threshold is proportional to the sum of the eigenvalues, which, unlike the largest one, is
//! smooth. Whether an eigenvalue is below the threshold is decided without eigenvalues: A − ε 1
//! then has a negative pivot (Sylvester's law of inertia).

use super::eigen::eigen;
use crate::scalar::{Real, positive_part};
use crate::state::all_finite;

/// The threshold below which a direction of small mobility is damped.
///
/// ```
/// use dynamics_core::algorithms::Damping;
/// let several = Damping::relative(1e-3_f32);
/// let only_one = Damping::relative(0.0).with_max_inertia(1000.0_f32); // a task of one direction
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping<R> {
    relative: R,
    least: R,
}

impl<R: Real> Damping<R> {
    /// A threshold ε in eigenvalues of Λ⁻¹, relative to their sum; 10⁻³ suits f32.
    ///
    /// In a task of one direction the only eigenvalue is the sum: use
    /// [`Damping::with_max_inertia`].
    pub fn relative(relative: R) -> Self {
        let least = R::ZERO;
        Self { relative, least }
    }

    /// Adds an absolute threshold to ε, which damps inertias above `inertia`, kg: for tasks whose
    /// directions may all become singular.
    pub fn with_max_inertia(mut self, inertia: R) -> Self {
        self.least = R::ONE / inertia;
        self
    }
}

/// The distance of a configuration from a singularity of a task.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Conditioning<R> {
    /// No direction of the task is singular: Λ is exact.
    Regular,
    /// A direction is nearly singular: Λ is damped along it.
    Damped {
        /// The least eigenvalue of Λ⁻¹ over the threshold: one where damping begins, zero at the
        /// singularity.
        smallest: R,
    },
}

/// The inverse of a symmetric matrix A with no negative eigenvalue, and whether it had to be
/// damped.
///
/// The inverse of an eigenvalue λ below the threshold ε goes to zero with λ, without a jump in
/// value or slope. An input that is not finite gives an output that is not finite and not
/// `Regular`.
///
/// ```text
/// A⁻¹  = Σ_k g(λ_k) w_k w_kᵀ
/// g(λ) = 1/λ                     for λ ≥ ε
///        λ / (λ² + (ε − λ)²)     for λ < ε
/// ```
///
/// with the eigenvectors w of A.
///
/// # Shape
/// M × M.
///
/// # Cost
/// 4 M³ + M² flops and 2 M divisions without damping; with damping 3 M (M − 1) (18 M + 50) + 2 M³
/// more flops, with 3 M (M − 1) divisions, in f64 a sixth more.
///
/// # Source
/// After Nakamura & Hanafusa (1986) and Chiaverini (1997).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{Conditioning, Damping, damped_inverse};
/// let damping = Damping::relative(1e-3_f32);
/// let (inverse, how) = damped_inverse(&[[2.0, 0.0], [0.0, 4.0]], damping);
/// assert_eq!((inverse, how), ([[0.5, 0.0], [0.0, 0.25]], Conditioning::Regular));
/// let (inverse, how) = damped_inverse(&[[2.0, 0.0], [0.0, 0.0]], damping);
/// assert_eq!((inverse, how), ([[0.5, 0.0], [0.0, 0.0]], Conditioning::Damped { smallest: 0.0 }));
/// ```
#[doc(alias = "damped least squares")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn damped_inverse<R: Real, const M: usize>(
    a: &[[R; M]; M],
    damping: Damping<R>,
) -> ([[R; M]; M], Conditioning<R>) {
    let mut sum = R::ZERO;
    for (i, row) in a.iter().enumerate() {
        sum += row[i];
    }
    let threshold = damping.relative * sum + damping.least;
    if let (Some(_), Some(pivots)) = (eliminate(a, threshold), eliminate(a, R::ZERO)) {
        return (pivots.inverse(), Conditioning::Regular);
    }

    let (values, vectors) = eigen(*a);
    let mut smallest = sum;
    let mut inverse = [[R::ZERO; M]; M];
    for (&value, vector) in values.iter().zip(&vectors) {
        // Rounding may make a zero negative.
        let value = if value < R::ZERO { R::ZERO } else { value };
        smallest = if value < smallest { value } else { smallest };
        add(&mut inverse, reciprocal(value, threshold), vector);
    }
    let regular = smallest >= threshold && smallest > R::ZERO;
    let conditioning = if regular && all_finite(&values) {
        Conditioning::Regular
    } else {
        let smallest = reciprocal(threshold, R::ZERO) * smallest;
        Conditioning::Damped { smallest }
    };
    (inverse, conditioning)
}

/// A = L D Lᵀ as L⁻¹ and D⁻¹.
struct Pivots<R, const M: usize> {
    l_inv: [[R; M]; M],
    d_inv: [R; M],
}

/// The pivots of A − shift 1, if all are positive.
#[cfg_attr(optimised, inline(always))]
fn eliminate<R: Real, const M: usize>(a: &[[R; M]; M], shift: R) -> Option<Pivots<R, M>> {
    let (mut a, mut l_inv, mut d_inv) = (*a, [[R::ZERO; M]; M], [R::ZERO; M]);
    for (k, (row, one)) in a.iter_mut().zip(&mut l_inv).enumerate() {
        (row[k], one[k]) = (row[k] - shift, R::ONE);
    }
    for k in 0..M {
        let (pivot_row, done) = (a[k], l_inv[k]);
        if !(pivot_row[k] > R::ZERO && pivot_row[k].is_finite()) {
            return None;
        }
        d_inv[k] = R::ONE / pivot_row[k];
        for (row, l_inv) in a.iter_mut().zip(&mut l_inv).skip(k + 1) {
            let l = row[k] * d_inv[k];
            for j in k + 1..M {
                row[j] -= l * pivot_row[j];
            }
            for j in 0..=k {
                l_inv[j] -= l * done[j];
            }
        }
    }
    Some(Pivots { l_inv, d_inv })
}

impl<R: Real, const M: usize> Pivots<R, M> {
    /// A⁻¹ = L⁻ᵀ D⁻¹ L⁻¹.
    #[cfg_attr(optimised, inline(always))]
    fn inverse(&self) -> [[R; M]; M] {
        let mut inverse = [[R::ZERO; M]; M];
        for (row, &d_inv) in self.l_inv.iter().zip(&self.d_inv) {
            add(&mut inverse, d_inv, row);
        }
        inverse
    }
}

/// A += w v vᵀ.
#[cfg_attr(optimised, inline(always))]
fn add<R: Real, const M: usize>(a: &mut [[R; M]; M], weight: R, vector: &[R; M]) {
    for (row, &x) in a.iter_mut().zip(vector) {
        for (entry, &y) in row.iter_mut().zip(vector) {
            *entry += weight * (x * y);
        }
    }
}

/// (A + shift 1)⁻¹ of a symmetric A, if all its pivots are positive.
#[inline(never)]
pub(crate) fn shifted_inverse<R: Real, const M: usize>(
    a: &[[R; M]; M],
    shift: R,
) -> Option<[[R; M]; M]> {
    eliminate(a, -shift).map(|pivots| pivots.inverse())
}

/// x with (A + D) x = b, of a symmetric A without negative eigenvalues, by its upper triangle, and a
/// diagonal D, the shifts.
///
/// No pivot of A + D is less than its shift: those that rounding makes less are replaced by it.
/// Unlike `eliminate`, it forms no inverse, which takes twice the flops. Inlined it keeps A in
/// registers.
#[cfg_attr(optimised, inline(always))]
#[doc(hidden)]
pub fn shifted_solution<R: Real, const M: usize>(
    mut a: [[R; M]; M],
    shifts: [R; M],
    mut x: [R; M],
) -> [R; M] {
    let mut d_inv = [R::ZERO; M];
    for k in 0..M {
        let (pivot_row, done) = (a[k], x[k]);
        d_inv[k] = R::ONE / (positive_part(pivot_row[k]) + shifts[k]);
        for i in k + 1..M {
            let l = pivot_row[i] * d_inv[k];
            for j in i..M {
                a[i][j] -= l * pivot_row[j];
            }
            x[i] -= l * done;
        }
    }
    for k in (0..M).rev() {
        for j in k + 1..M {
            x[k] -= a[k][j] * x[j];
        }
        x[k] *= d_inv[k];
    }
    x
}

/// 1/λ, damped below ε.
#[cfg_attr(optimised, inline(always))]
fn reciprocal<R: Real>(value: R, threshold: R) -> R {
    let short = threshold - value;
    let short = if short > R::ZERO { short } else { R::ZERO };
    let squares = value * value + short * short;
    if squares == R::ZERO {
        R::ZERO // λ = ε = 0
    } else {
        value / squares
    }
}
