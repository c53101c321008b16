//! Joint motions that move a body as wanted, by damped least squares.
//!
//! With the columns c_j = (ω_j, v_j/ℓ) of the joints that are free, the motion p_j that each makes
//! anyway and the damping λ, the motions of the joints are p_j + c_jᵀ x, where
//!
//! ```text
//! (Σ_j c_j c_jᵀ + λ² 1) x = v − Σ_j c_j p_j
//! ```
//!
//! In a direction of the singular value σ they have the share σ²/(σ² + λ²) of the wanted motion v,
//! and their length is at most |v| / 2λ. Nakamura & Hanafusa, "Inverse kinematic solutions with
//! singularity robustness for robot manipulator control" (1986).

use crate::estimate::tip_wrench::add_rows;
use dynamics_core::algorithms::shifted_solution;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Motion;

/// A motion as (ω, v/ℓ), where `per_length` is 1/ℓ.
#[inline(always)]
pub(super) fn scaled<R: Real>(motion: Motion<R>, per_length: R) -> [R; 6] {
    let ([a, b, c], [x, y, z]) = (motion.ang.array(), (motion.lin * per_length).array());
    [a, b, c, x, y, z]
}

/// a·b.
#[inline(always)]
pub(super) fn dot<R: Real>(a: &[R; 6], b: &[R; 6]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (a, b)| sum + *a * *b)
}

/// x of the joints (c_j, p_j), where `square` is λ².
#[inline(always)]
pub(super) fn damped_motion<R: Real, const V: usize>(
    joints: &[([R; 6], R); V],
    square: R,
    v: &[R; 6],
) -> [R; 6] {
    let (mut a, mut b) = ([[R::ZERO; 6]; 6], [R::ZERO; 6]);
    // In two parts, since the sums of the whole matrix are more than the M4F has registers.
    add_rows::<R, V, 0, 2>(joints, &mut a, &mut b);
    add_rows::<R, V, 2, 6>(joints, &mut a, &mut b);
    shifted_solution(&a, square, &core::array::from_fn(|i| v[i] - b[i]))
}
