//! Balafoutis, Patel & Misra (1988); Balafoutis & Patel (1991): Newton's and Euler's equations with
//! Cartesian tensors and augmented links, O(n):
//!
//! ```text
//! ω_i = A_iᵀ (ω_{i−1} + z q̇_i),   ω̇_i = A_iᵀ (ω̇_{i−1} + z q̈_i + ω_{i−1} × z q̇_i)
//! Ω_i = ω̇~_i + ω~_i ω~_i
//! s̈_i = A_iᵀ s̈_{i−1} + Ω_i p*_i,   s̈_0 = −g
//! f_i = Ω_i u_i + A_{i+1} f_{i+1}
//! η_i = dual(Ω_i K_i − K_i Ω_iᵀ) + u_i × A_iᵀ s̈_{i−1} + A_{i+1} η_{i+1} + p*_i × A_{i+1} f_{i+1}
//! τ_i = (A_i η_i) · z
//! ```
//!
//! A link is augmented by the masses of all links behind it, put in its outer origin: u_i, K_i:
//! `augmented_first`, `augmented_second`, ∫ ρ dm and ∫ ρ ρᵀ dm about the origin of frame i − 1. f_i
//! is the force on a link without the mass from there on times s̈_{i−1}, whose moment is in u_i and
//! K_i. ω~ is the tensor of ω ×, dual its inverse. Rotations are two planar ones, of 8 products and
//! 4 sums.

use core::array::from_fn;

use crate::chain::{Chain, State};
use crate::matrix::{Mat, cross, mul_vec, plus};
use crate::number::Number;

#[inline(never)]
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let zero = [T::ZERO; 3];
    let mut wrench = [(zero, zero); N];
    let (mut w, mut wd, mut sdd) = (zero, zero, chain.gravity.map(|g| -g));
    for (i, link) in chain.links.iter().enumerate() {
        let (qd, qdd) = (state.qd[i], state.qdd[i]);
        let back = |v: &[T; 3]| link.turn_back(state.cos[i], state.sin[i], v);
        if i == 0 {
            let about_axis = |x| [T::ZERO, link.sin_alpha * x, link.cos_alpha * x];
            (w, wd) = (about_axis(qd), about_axis(qdd));
        } else {
            let spun = [wd[0] + w[1] * qd, wd[1] - w[0] * qd, wd[2] + qdd];
            w = back(&[w[0], w[1], w[2] + qd]);
            wd = back(&spun);
        }
        let turning = tensor(&w, &wd);
        let before = back(&sdd);
        sdd = plus(&before, &mul_vec(&turning, &link.p));
        let moment =
            plus(&moment(&turning, &link.augmented_second), &cross(&link.augmented_first, &before));
        // Only the torque of the first link is needed.
        let force = if i > 0 { mul_vec(&turning, &link.augmented_first) } else { zero };
        wrench[i] = (force, moment);
    }
    let mut tau = [T::ZERO; N];
    let (mut f, mut eta) = wrench[N - 1];
    for i in (1..N).rev() {
        let turn = |v: &[T; 3]| chain.links[i].turn(state.cos[i], state.sin[i], v);
        (f, eta) = (turn(&f), turn(&eta));
        tau[i] = eta[2];
        let (force, moment) = &wrench[i - 1];
        eta = plus(moment, &plus(&eta, &cross(&chain.links[i - 1].p, &f)));
        if i > 1 {
            f = plus(force, &f);
        }
    }
    let first = &chain.links[0];
    tau[0] = first.sin_alpha * eta[1] + first.cos_alpha * eta[2];
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

/// dual(Ω K − K Ωᵀ), the integral of ρ × Ω ρ dm: 15 products, 15 sums, by the symmetry of K.
#[inline(always)]
fn moment<T: Number>(turning: &Mat<T, 3>, k: &Mat<T, 3>) -> [T; 3] {
    from_fn(|x| {
        let (y, z) = ((x + 1) % 3, (x + 2) % 3);
        let (o, yz) = (turning, turning[z][z] - turning[y][y]);
        o[z][x] * k[x][y] - o[y][x] * k[x][z] + o[z][y] * k[y][y] - o[y][z] * k[z][z] + yz * k[y][z]
    })
}
