//! The torques of one cluster's motors, by elimination, and damped near a dead point.

use super::ClusterProblem;
use crate::algorithms::shifted_inverse;
use crate::engine::{Index, for_each_joint};
use crate::scalar::Real;
use crate::state::{all_finite, entry};

/// Rows are exchanged where an entry below the pivot is more than this many times as large.
const PIVOT: f64 = 4.0;

/// The torques of the motors, and whether they are at a dead point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorTorques<R, const Y: usize> {
    /// The torque of each motor in the places of y, N·m or N.
    pub tau: [R; Y],
    /// The name of the first cluster whose motors are at or near a dead point: its torques are
    /// damped.
    pub singular: Option<&'static str>,
}

/// τ_a, and whether it is damped, from G_a by rows, τ at y and the reciprocals of the rates below
/// which it is damped.
#[cfg_attr(optimised, inline(always))]
pub(super) fn solve<R: Real, const N: usize>(
    g: &[[R; N]; N],
    tau: &[R; N],
    per: &[R; N],
) -> Result<([R; N], bool), ClusterProblem> {
    let (exact, regular) = eliminate(transposed(g), *tau, per);
    let solution = if regular {
        (exact, false)
    } else {
        damped(g, tau, per).map_or((exact, false), |damped| (damped, true))
    };
    if all_finite(&solution.0) { Ok(solution) } else { Err(ClusterProblem::NotFinite) }
}

/// x with A x = b, by elimination with row pivots, and whether ς is more than one for certain.
///
/// For rows of unit length the sum of squares of A⁻¹ is at most N / det² A, by the inequality of
/// the means for its singular values; rows of length r divide it by their least r². The determinant
/// is the product of the pivots.
#[allow(
    clippy::needless_range_loop,
    reason = "iterators that skip entries are not unrolled: 3000 cycles of six motors, in place of \
        1220"
)]
#[cfg_attr(optimised, inline(always))]
fn eliminate<R: Real, const N: usize>(
    mut a: [[R; N]; N],
    mut b: [R; N],
    per: &[R; N],
) -> ([R; N], bool) {
    let lengths = a.each_ref().map(|row| dot(row, row));
    let mut squares = R::from_f64(N as f64);
    let mut inv = [R::ZERO; N];
    // Not a loop, which might not be unrolled: the matrix is then addressed entry by entry.
    for_each_joint!(K, {
        if Index::<K, N>::IS_BELOW {
            for i in K + 1..N {
                if a[i][K].abs() > a[K][K].abs() * R::from_f64(PIVOT) {
                    a.swap(i, K);
                    b.swap(i, K);
                }
            }
            inv[K] = R::ONE / a[K][K];
            squares *= lengths[K] * (inv[K] * inv[K]);
            for i in K + 1..N {
                let l = a[i][K] * inv[K];
                for j in K + 1..N {
                    a[i][j] -= l * a[K][j];
                }
                b[i] -= l * b[K];
            }
        }
    });
    for_each_joint!(J, {
        if Index::<J, N>::IS_BELOW {
            let k = const { N.saturating_sub(J + 1) };
            for j in k + 1..N {
                b[k] -= a[k][j] * b[j];
            }
            b[k] *= inv[k];
        }
    });
    let mut regular = true;
    for (length, &per) in lengths.iter().zip(per) {
        // False of a NaN, too.
        regular &= squares < *length * (per * per);
    }
    (b, regular)
}

#[cfg_attr(optimised, inline(always))]
fn transposed<R: Real, const N: usize>(g: &[[R; N]; N]) -> [[R; N]; N] {
    core::array::from_fn(|k| g.each_ref().map(|motor| motor[k]))
}

/// Aᵀ (A Aᵀ + λ² 1)⁻¹ b with λ² = 1 − ς², rows over the rates; nothing where ς is one or more.
#[cold]
#[inline(never)]
fn damped<R: Real, const N: usize>(g: &[[R; N]; N], tau: &[R; N], per: &[R; N]) -> Option<[R; N]> {
    let (mut a, mut b) = (transposed(g), *tau);
    for ((row, b), &per) in a.iter_mut().zip(&mut b).zip(per) {
        *row = row.map(|x| x * per);
        *b *= per;
    }
    let products = a.map(|x| a.map(|y| dot(&x, &y)));
    let trace = shifted_inverse(&products, R::ZERO).map(|inverse| {
        let diagonal = inverse.iter().enumerate().map(|(k, row)| entry(row, k));
        diagonal.fold(R::ZERO, |sum, x| sum + x)
    });
    let damping = match trace {
        Some(trace) if trace.is_finite() && trace > R::ZERO => R::ONE - R::ONE / trace,
        _ => R::ONE,
    };
    if damping <= R::ZERO {
        return None;
    }
    let inverse = shifted_inverse(&products, damping)?;
    let weights = inverse.map(|row| dot(&row, &b));
    let mut x = [R::ZERO; N];
    for (row, &weight) in a.iter().zip(&weights) {
        for (x, &entry) in x.iter_mut().zip(row) {
            *x += weight * entry;
        }
    }
    Some(x)
}

fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(R::ZERO, |sum, product| sum + product)
}
