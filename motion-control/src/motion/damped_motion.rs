//! Joint motions that move a body as wanted, by damped least squares.
//!
//! With the columns c_j = (ω_j, v_j/ℓ) of the joints that are free and the damping λ, rad,
//!
//! ```text
//! A = Σ_j c_j c_jᵀ      (A + λ² 1) x₁ = b      (A + λ² 1) x_k+1 = λ² x_k      x = Σ_k x_k
//! ```
//!
//! and the motions of the joints are c_jᵀ x: iterated Tikhonov regularisation. In a direction of
//! the singular value σ, K solutions have the share 1 − (λ²/(σ² + λ²))ᴷ of the motion that is
//! wanted. It rises smoothly from 0 at the singularity to 1, and the motion of the joints is at
//! most √K/λ times |b| for every σ, 1.01/λ for K = 3. A is factored once.

use dynamics_core::scalar::{Real, Vector, positive_part};
use dynamics_core::spatial::Motion;

/// A motion as (ω, v/ℓ), where `per_length` is 1/ℓ.
#[inline(always)]
pub(crate) fn scaled<R: Real>(motion: Motion<R>, per_length: R) -> [R; 6] {
    let ([a, b, c], [x, y, z]) = (motion.ang.array(), (motion.lin * per_length).array());
    [a, b, c, x, y, z]
}

/// a·b.
#[inline(always)]
pub(crate) fn dot<R: Real>(a: &[R; 6], b: &[R; 6]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (a, b)| sum + *a * *b)
}

/// x by K solutions, of the columns of the joints that are `free` and of the square λ².
///
/// No pivot is less than λ²: those that rounding makes less are replaced by it.
#[inline(never)]
pub(crate) fn damped_motion<R: Real, const V: usize, const K: usize>(
    columns: &[[R; 6]; V],
    free: &[bool; V],
    square: R,
    b: &[R; 6],
) -> [R; 6] {
    let mut a = [[R::ZERO; 6]; 6];
    // In two parts, since the sums of the whole matrix are more than the M4F has registers.
    add_rows::<R, V, 0, 2>(columns, free, &mut a);
    add_rows::<R, V, 2, 6>(columns, free, &mut a);
    let mut d_inv = [R::ZERO; 6];
    for k in 0..6 {
        let row = a[k];
        d_inv[k] = R::ONE / (positive_part(row[k]) + square);
        for i in k + 1..6 {
            let l = row[i] * d_inv[k];
            for j in i..6 {
                a[i][j] -= l * row[j];
            }
            a[k][i] = l; // of Lᵀ
        }
    }
    let (mut x, mut sum) = (*b, [R::ZERO; 6]);
    for k in 0..K {
        let weight = if k == 0 { R::ONE } else { square };
        x = solve(&a, &d_inv, x.map(|x| x * weight));
        for (sum, x) in sum.iter_mut().zip(x) {
            *sum += x;
        }
    }
    sum
}

/// x with L D Lᵀ x = b.
#[inline(always)]
fn solve<R: Real>(l: &[[R; 6]; 6], d_inv: &[R; 6], mut x: [R; 6]) -> [R; 6] {
    for k in 0..6 {
        for i in k + 1..6 {
            x[i] -= l[k][i] * x[k];
        }
    }
    for k in (0..6).rev() {
        x[k] *= d_inv[k];
        for i in k + 1..6 {
            x[k] -= l[k][i] * x[i];
        }
    }
    x
}

/// The rows of Σ c cᵀ from the diagonal on.
#[inline(always)]
fn add_rows<R: Real, const V: usize, const FROM: usize, const TO: usize>(
    columns: &[[R; 6]; V],
    free: &[bool; V],
    a: &mut [[R; 6]; 6],
) {
    let mut rows = [[R::ZERO; 6]; 6];
    for (c, free) in columns.iter().zip(free) {
        if *free {
            for i in FROM..TO {
                for j in i..6 {
                    rows[i][j] += c[i] * c[j];
                }
            }
        }
    }
    a[FROM..TO].copy_from_slice(&rows[FROM..TO]);
}
