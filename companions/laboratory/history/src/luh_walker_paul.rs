//! Luh, Walker & Paul (1980): the recursive Newton-Euler equations in link coordinates, O(n); table
//! 1, for joints that turn:
//!
//! ```text
//! ω_i = A_iᵀ (ω_{i−1} + z q̇_i)
//! ω̇_i = A_iᵀ (ω̇_{i−1} + z q̈_i + ω_{i−1} × z q̇_i)
//! v̇_i = ω̇_i × p*_i + ω_i × (ω_i × p*_i) + A_iᵀ v̇_{i−1}
//! v̂̇_i = ω̇_i × s_i + ω_i × (ω_i × s_i) + v̇_i
//! F_i = m_i v̂̇_i,   N_i = J_i ω̇_i + ω_i × J_i ω_i
//! f_i = A_{i+1} f_{i+1} + F_i
//! n_i = A_{i+1} [n_{i+1} + (A_{i+1}ᵀ p*_i) × f_{i+1}] + (p*_i + s_i) × F_i + N_i
//! τ_i = n_i · (A_iᵀ z),   ω_0 = ω̇_0 = 0,   v̇_0 = −g
//! ```
//!
//! A_i: `rotation`, from frame i to frame i − 1; p*, s, J: `p`, `s`, `inertia`; p* + s is a
//! constant of the link. The source's viscous friction b_i q̇_i is left out. z is (0, 0, 1): sums
//! and products with its zeros are omitted.

use crate::chain::{Chain, Link, State};
use crate::matrix::{Mat, cross, dot, mul_vec, plus, times, transpose_mul_vec};
use crate::number::Number;

#[inline(never)]
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let zero = [T::ZERO; 3];
    let mut a = [[zero; 3]; N];
    let mut wrench = [(zero, zero); N];
    let (mut w, mut wd, mut vd) = (zero, zero, chain.gravity.map(|g| -g));
    for (i, link) in chain.links.iter().enumerate() {
        a[i] = link.rotation(state.cos[i], state.sin[i]);
        let (qd, qdd) = (state.qd[i], state.qdd[i]);
        vd = transpose_mul_vec(&a[i], &vd);
        if i == 0 {
            w = times(&a[0][2], qd);
            wd = times(&a[0][2], qdd);
        } else {
            let spun = [wd[0] + w[1] * qd, wd[1] - w[0] * qd, wd[2] + qdd];
            w = transpose_mul_vec(&a[i], &[w[0], w[1], w[2] + qd]);
            wd = transpose_mul_vec(&a[i], &spun);
        }
        let shift = |r| plus(&cross(&wd, r), &cross(&w, &cross(&w, r)));
        vd = plus(&shift(&link.p), &vd);
        let com = plus(&shift(&link.s), &vd);
        let turned = cross(&w, &mul_vec(&link.inertia, &w));
        wrench[i] = (times(&com, link.mass), plus(&mul_vec(&link.inertia, &wd), &turned));
    }
    inward(&chain.links, &a, &wrench, 0)
}

/// τ from joint `last` on, of the F and N of the links from there on.
#[inline(always)]
pub fn inward<T: Number, const N: usize>(
    links: &[Link<T>; N],
    a: &[Mat<T, 3>; N],
    wrench: &[([T; 3], [T; 3]); N],
    last: usize,
) -> [T; N] {
    let mut tau = [T::ZERO; N];
    let (mut f, mut n) = ([T::ZERO; 3], [T::ZERO; 3]);
    for i in (last..N).rev() {
        let (link, (force, moment)) = (&links[i], &wrench[i]);
        let own = plus(&cross(&link.p_plus_s, force), moment);
        (f, n) = if i + 1 == N {
            (*force, own)
        } else {
            let a = &a[i + 1];
            let lever = plus(&n, &cross(&transpose_mul_vec(a, &link.p), &f));
            (plus(&mul_vec(a, &f), force), plus(&mul_vec(a, &lever), &own))
        };
        // Row 3 of A_i is A_iᵀ z.
        tau[i] = dot(&n, &a[i][2]);
    }
    tau
}
