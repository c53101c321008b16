//! The inverse of a symmetric matrix that may be singular, damped where it is.
//!
//! Jacobi's eigenvalues (Golub & Van Loan, *Matrix Computations*, section 8.5), and damping that begins
//! smoothly (after Nakamura & Hanafusa, 1986, and Chiaverini, 1997): an eigenvalue λ above the threshold ε
//! counts with 1/λ, one below with λ/(λ² + (ε − λ)²), which has the same value and slope at ε and goes to
//! zero with λ. The threshold follows the sum of the eigenvalues, which, unlike the largest, is smooth.

use crate::scalar::Real;

/// From where on a direction that hardly moves is damped.
///
/// ```
/// use dynamics_core::algorithms::Damping;
/// let several = Damping::relative(1e-3_f32);
/// let only_one = Damping::relative(0.0).heaviest(1000.0_f32); // a task of one direction
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping<R> {
    relative: R,
    least: R,
}

impl<R: Real> Damping<R> {
    /// A threshold ε in eigenvalues of Λ⁻¹, relative to their sum; 10⁻³ suits f32.
    ///
    /// A task of one direction is its own sum: it needs [`Damping::heaviest`].
    pub fn relative(relative: R) -> Self {
        let least = R::ZERO;
        Self { relative, least }
    }

    /// Adds to ε what damps inertias beyond `inertia`, kg: directions that nearly stand still although
    /// the task has no other to compare them with.
    pub fn heaviest(mut self, inertia: R) -> Self {
        self.least = R::ONE / inertia;
        self
    }
}

/// How near to singular a pose is for a task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conditioning<R> {
    /// Every direction of the task moves: Λ is exact.
    Regular,
    /// A direction hardly moves: Λ is damped along it.
    Damped {
        /// The least eigenvalue of Λ⁻¹ over the threshold: one where damping begins, zero at the
        /// singularity.
        smallest: R,
    },
}

/// Sweeps over all off-diagonal entries: what 6×6 matrices of any condition needed to reach rounding, and
/// one more.
#[inline(always)]
fn sweeps<R: Real>() -> usize {
    if R::EPSILON > R::from_f64(1e-10) {
        6
    } else {
        7
    }
}

/// A⁻¹, and whether it had to be damped: A symmetric with no negative eigenvalue.
///
/// What stands along the eigenvector of an eigenvalue below the threshold goes to zero with it, without a
/// jump in value or slope. Cost: the same whatever the data; in f32 3 M (M − 1) (18 M + 50) + 2 M³ flops, with
/// 3 M (M − 1) divisions; in f64 a sixth more. Errors: none; numbers that are not finite give such numbers. Source: the
/// module's.
///
/// ```
/// use dynamics_core::algorithms::{Conditioning, Damping, damped_inverse};
/// let damping = Damping::relative(1e-3_f32);
/// let (inverse, how) = damped_inverse(&[[2.0, 0.0], [0.0, 4.0]], damping);
/// assert_eq!((inverse, how), ([[0.5, 0.0], [0.0, 0.25]], Conditioning::Regular));
/// let (inverse, how) = damped_inverse(&[[2.0, 0.0], [0.0, 0.0]], damping);
/// assert_eq!((inverse, how), ([[0.5, 0.0], [0.0, 0.0]], Conditioning::Damped { smallest: 0.0 }));
/// ```
#[inline(always)]
pub fn damped_inverse<R: Real, const M: usize>(
    a: &[[R; M]; M],
    damping: Damping<R>,
) -> ([[R; M]; M], Conditioning<R>) {
    let mut sum = R::ZERO;
    for (i, row) in a.iter().enumerate() {
        sum += row[i];
    }
    let threshold = damping.relative * sum + damping.least;
    let (values, vectors) = eigen(*a);

    let mut smallest = values[0];
    let mut inverse = [[R::ZERO; M]; M];
    for (&value, vector) in values.iter().zip(&vectors) {
        // Rounding may leave a zero below zero.
        let value = if value < R::ZERO { R::ZERO } else { value };
        smallest = if value < smallest { value } else { smallest };
        let weight = reciprocal(value, threshold);
        for (row, &x) in inverse.iter_mut().zip(vector) {
            for (entry, &y) in row.iter_mut().zip(vector) {
                *entry += weight * (x * y);
            }
        }
    }
    let conditioning = if smallest < threshold || sum == R::ZERO {
        let per = if threshold > R::ZERO {
            R::ONE / threshold
        } else {
            R::ZERO
        };
        Conditioning::Damped {
            smallest: smallest * per,
        }
    } else {
        Conditioning::Regular
    };
    (inverse, conditioning)
}

/// 1/λ, damped below ε.
#[inline(always)]
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

/// Eigenvalues and eigenvectors (one a row) of a symmetric matrix, in no order.
#[inline(always)]
fn eigen<R: Real, const M: usize>(mut a: [[R; M]; M]) -> ([R; M], [[R; M]; M]) {
    let mut vectors = [[R::ZERO; M]; M];
    for (i, row) in vectors.iter_mut().enumerate() {
        row[i] = R::ONE;
    }
    for _ in 0..sweeps::<R>() {
        for p in 0..M {
            for q in p + 1..M {
                let (c, s) = rotation(a[p][p], a[p][q], a[q][q]);
                for row in &mut a {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                turn(&mut a, p, q, c, s);
                turn(&mut vectors, p, q, c, s);
            }
        }
    }
    let mut values = [R::ZERO; M];
    for (i, (value, row)) in values.iter_mut().zip(&a).enumerate() {
        *value = row[i];
    }
    (values, vectors)
}

/// Rows p and q turned by an angle.
#[inline(always)]
fn turn<R: Real, const M: usize>(rows: &mut [[R; M]; M], p: usize, q: usize, c: R, s: R) {
    let (x, y) = (rows[p], rows[q]);
    for (k, (x, y)) in x.into_iter().zip(y).enumerate() {
        (rows[p][k], rows[q][k]) = (c * x - s * y, s * x + c * y);
    }
}

/// Cosine and sine of the least turn that makes [app apq; apq aqq] diagonal; none if it is.
#[inline(always)]
fn rotation<R: Real>(app: R, apq: R, aqq: R) -> (R, R) {
    let (apart, twice) = (aqq - app, apq + apq);
    let squared = apart * apart + twice * twice;
    let far = apart.abs() + squared * squared.per_sqrt();
    let signed = if apart < R::ZERO { -twice } else { twice };
    let t = if far == R::ZERO {
        R::ZERO
    } else {
        signed / far
    };
    let c = (R::ONE + t * t).per_sqrt();
    (c, t * c)
}
