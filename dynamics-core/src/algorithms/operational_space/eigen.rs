//! Eigenvalues and eigenvectors of a small symmetric matrix.
//!
//! Jacobi's method: Golub & Van Loan, *Matrix Computations*, section 8.5.

use crate::scalar::Real;

/// Sweeps over all off-diagonal entries: the number that 6×6 matrices of any condition needed for
/// full accuracy, and one more.
#[cfg_attr(optimised, inline(always))]
fn sweeps<R: Real>() -> usize {
    if R::EPSILON > R::from_f64(1e-10) { 6 } else { 7 }
}

/// Eigenvalues and eigenvectors (by rows) of a symmetric matrix, unordered.
#[cfg_attr(optimised, inline(always))]
#[doc(hidden)]
pub fn eigen<R: Real, const M: usize>(mut a: [[R; M]; M]) -> ([R; M], [[R; M]; M]) {
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

/// Rotates rows p and q by an angle.
#[cfg_attr(optimised, inline(always))]
fn turn<R: Real, const M: usize>(rows: &mut [[R; M]; M], p: usize, q: usize, c: R, s: R) {
    let (x, y) = (rows[p], rows[q]);
    for (k, (x, y)) in x.into_iter().zip(y).enumerate() {
        (rows[p][k], rows[q][k]) = (c * x - s * y, s * x + c * y);
    }
}

/// Cosine and sine of the smallest rotation that makes [app apq; apq aqq] diagonal; none if it is
/// diagonal.
#[cfg_attr(optimised, inline(always))]
fn rotation<R: Real>(app: R, apq: R, aqq: R) -> (R, R) {
    let (apart, twice) = (aqq - app, apq + apq);
    let squared = apart * apart + twice * twice;
    let far = apart.abs() + squared * squared.rsqrt();
    let signed = if apart < R::ZERO { -twice } else { twice };
    let t = if far == R::ZERO { R::ZERO } else { signed / far };
    let c = (R::ONE + t * t).rsqrt();
    (c, t * c)
}
