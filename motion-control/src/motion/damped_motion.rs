//! Joint motions that move a body as wanted, by damped least squares.
//!
//! With the columns c_j = (ω_j, v_j/ℓ) of the joints that are free and the damping λ, the motions of
//! the joints are c_jᵀ x, where
//!
//! ```text
//! (Σ_j c_j c_jᵀ + λ² 1) x = v
//! ```
//!
//! In a direction of the singular value σ they have the share σ²/(σ² + λ²) of the wanted motion v,
//! and their length is at most |v| / 2λ. Nakamura & Hanafusa, "Inverse kinematic solutions with
//! singularity robustness for robot manipulator control" (1986).

use crate::estimate::tip_wrench::squares;
use dynamics_core::algorithms::shifted_solution;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};

/// The damping λ², `square`, at the length ℓ.
#[derive(Clone, Copy)]
pub(super) struct Damping<R> {
    pub(super) square: R,
    pub(super) length: R,
}

/// x as a force, of which J_jᵀ x are the motions, by the columns J_j of the joints that are free.
///
/// The factor 1/ℓ of lengths is left out of columns and x, and is its square in the damping instead.
#[inline(never)]
pub(super) fn damped_motion<R: Real, const V: usize>(
    columns: &[Motion<R>; V],
    free: &[bool; V],
    Damping { square, length }: Damping<R>,
    v: &Motion<R>,
) -> Force<R> {
    let entries = |motion: &Motion<R>| {
        let ([a, b, c], [x, y, z]) = (motion.ang.array(), motion.lin.array());
        [a, b, c, x, y, z]
    };
    let free = columns.iter().zip(free).map(|(column, free)| free.then(|| entries(column)));
    let along = square * length * length;
    let shifts = [square, square, square, along, along, along];
    let [a, b, c, x, y, z] = shifted_solution(squares(free), shifts, entries(v));
    Force::new(R::Vec3::new(a, b, c), R::Vec3::new(x, y, z))
}

/// The square of (ω, v/ℓ).
#[inline(always)]
pub(super) fn square<R: Real>(motion: Motion<R>, per_length: R) -> R {
    let lin = motion.lin * per_length;
    motion.ang.dot(motion.ang) + lin.dot(lin)
}
