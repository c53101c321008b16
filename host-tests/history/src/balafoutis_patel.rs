//! Balafoutis & Patel (1989; 1991, section 5.3): Newton's and Euler's equations with Cartesian tensors and augmented
//! links, O(n):
//!
//! ```text
//! ω_i = A_iᵀ (ω_{i−1} + z q̇_i),   ω̇_i = A_iᵀ (ω̇_{i−1} + z q̈_i + ω_{i−1} × z q̇_i)
//! Ω_i = ω̇~_i + ω~_i ω~_i
//! s̈_i = A_iᵀ s̈_{i−1} + Ω_i p*_i,   s̈_0 = −g
//! f_i = Ω_i u_i + A_{i+1} f_{i+1}
//! η_i = dual(Ω_i K_i − K_i Ω_iᵀ) + u_i × A_iᵀ s̈_{i−1} + A_{i+1} η_{i+1} + p*_i × A_{i+1} f_{i+1}
//! τ_i = η_i · A_iᵀ z
//! ```
//!
//! A link is augmented by the masses of all links behind it, put in its outer origin: u_i, K_i: `augmented_first`,
//! `augmented_second`, ∫ ρ dm and ∫ ρ ρᵀ dm about the origin of frame i − 1. What is left of the force on a link is f_i;
//! the rest, the mass from there on times s̈_{i−1}, is in u_i and K_i. ω~ is the tensor of ω ×, dual its inverse.
//! Rotations are two planar ones, of 8 products and 4 sums.

use crate::chain::{Chain, State};
use crate::matrix::{Mat, cross, dot, mul_vec, plus, times};
use crate::number::Number;

/// The torques of the joints.
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let zero = [T::ZERO; 3];
    let mut wrench = [(zero, zero); N];
    let (mut w, mut wd, mut sdd) = (zero, zero, chain.gravity.map(|g| -g));
    for (i, link) in chain.links.iter().enumerate() {
        let (qd, qdd) = (state.qd[i], state.qdd[i]);
        let back = |v: &[T; 3]| link.turn_back(state.cos[i], state.sin[i], v);
        if i == 0 {
            let axis = [T::ZERO, link.sin_alpha, link.cos_alpha];
            w = times(&axis, qd);
            wd = times(&axis, qdd);
        } else {
            let spun = [wd[0] + w[1] * qd, wd[1] - w[0] * qd, wd[2] + qdd];
            w = back(&[w[0], w[1], w[2] + qd]);
            wd = back(&spun);
        }
        let turning = tensor(&w, &wd);
        let before = back(&sdd);
        sdd = plus(&before, &mul_vec(&turning, &link.p));
        let moment = plus(
            &moment(&turning, &link.augmented_second),
            &cross(&link.augmented_first, &before),
        );
        wrench[i] = (mul_vec(&turning, &link.augmented_first), moment);
    }
    let mut tau = [T::ZERO; N];
    let (mut f, mut eta) = (zero, zero);
    for (i, link) in chain.links.iter().enumerate().rev() {
        (f, eta) = if i + 1 == N {
            wrench[i]
        } else {
            let turn = |v: &[T; 3]| chain.links[i + 1].turn(state.cos[i + 1], state.sin[i + 1], v);
            let behind = turn(&f);
            let carried = plus(&turn(&eta), &cross(&link.p, &behind));
            (plus(&wrench[i].0, &behind), plus(&wrench[i].1, &carried))
        };
        tau[i] = link.sin_alpha * eta[1] + link.cos_alpha * eta[2];
    }
    tau
}

/// Ω = ω̇~ + ω~ ω~: 6 products, 9 sums.
#[inline(always)]
fn tensor<T: Number>(w: &[T; 3], wd: &[T; 3]) -> Mat<T, 3> {
    let [xx, yy, zz] = [0, 1, 2].map(|i| w[i] * w[i]);
    let (xy, xz, yz) = (w[0] * w[1], w[0] * w[2], w[1] * w[2]);
    [
        [-(yy + zz), xy - wd[2], xz + wd[1]],
        [xy + wd[2], -(xx + zz), yz - wd[0]],
        [xz - wd[1], yz + wd[0], -(xx + yy)],
    ]
}

/// dual(Ω K − K Ωᵀ), the sum of ρ × Ω ρ dm: 18 products, 15 sums.
#[inline(always)]
fn moment<T: Number>(turning: &Mat<T, 3>, k: &Mat<T, 3>) -> [T; 3] {
    let entry = |i: usize, j: usize| dot(&turning[i], &k[j]);
    [
        entry(2, 1) - entry(1, 2),
        entry(0, 2) - entry(2, 0),
        entry(1, 0) - entry(0, 1),
    ]
}
