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
use dynamics_core::spatial::{Force, Motion};

/// x as a force, of which J_jᵀ x are the motions without p; `p` of joints that are not `free` does
/// not count, `square` is λ², and `per_length` 1/ℓ.
#[inline(always)]
pub(super) fn damped_motion<R: Real, const V: usize>(
    jacobian: &[Motion<R>; V],
    (p, free): (&[R; V], &[bool; V]),
    (square, per_length): (R, R),
    v: Motion<R>,
) -> Force<R> {
    let scaled = |motion: Motion<R>| {
        let ([a, b, c], [x, y, z]) = (motion.ang.array(), (motion.lin * per_length).array());
        [a, b, c, x, y, z]
    };
    let mut joints = [([R::ZERO; 6], R::ZERO); V];
    for j in 0..V {
        if free[j] {
            joints[j] = (scaled(jacobian[j]), p[j]);
        }
    }
    let (mut a, mut b, v) = ([[R::ZERO; 6]; 6], [R::ZERO; 6], scaled(v));
    // In two parts, since the sums of the whole matrix are more than the M4F has registers.
    add_rows::<R, V, 0, 2>(&joints, &mut a, &mut b);
    add_rows::<R, V, 2, 6>(&joints, &mut a, &mut b);
    let [a, b, c, x, y, z] = shifted_solution(&a, square, &core::array::from_fn(|i| v[i] - b[i]));
    Force::new(R::Vec3::new(a, b, c), R::Vec3::new(x, y, z) * per_length)
}

/// The square of (ω, v/ℓ).
#[inline(always)]
pub(super) fn square<R: Real>(motion: Motion<R>, per_length: R) -> R {
    let lin = motion.lin * per_length;
    motion.ang.dot(motion.ang) + lin.dot(lin)
}
