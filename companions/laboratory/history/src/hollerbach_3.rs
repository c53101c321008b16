//! Hollerbach (1980): Lagrange's equations over 3 × 3 matrices with recursions in both directions,
//! O(n). Equations (12) to (17), with Ẅ_j of [`crate::waters`] over rotations alone:
//!
//! ```text
//! p̈_i = p̈_{i−1} + Ẅ_i p*_i
//! e_i = e_{i+1} + m_i p̈_i + Ẅ_i n_i
//! D_i = A_{i+1} D_{i+1} + p*_i e_iᵀ + n_i p̈_iᵀ + J_i Ẅ_iᵀ
//! c_i = A_{i+1} c_{i+1} + (n_i + p*_i Σ_{j ≥ i} m_j)
//! τ_i = tr(∂W_i/∂q_i D_i) − gᵀ ∂W_i/∂q_i c_i
//! ```
//!
//! n_i, J_i: `first_moment`, `second_moment`, about the origin of frame i. Hollerbach's origin of
//! link i is on its own joint's axis; with Denavit and Hartenberg's frames, whose origin i is at
//! the link's outer end, D_i and c_i are about the origin of frame i − 1, and p*_i e_iᵀ takes the
//! place of his ⁱp_{i+1} e_{i+1}ᵀ.

use crate::chain::{Chain, State};
use crate::matrix::{
    derivative, dot, mul, mul_transposed, mul_vec, outer, plus, sum, times, trace_of_product,
    transposed,
};
use crate::number::Number;
use crate::waters::Turning;

#[inline(never)]
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let zero = [[T::ZERO; 3]; 3];
    let (mut a, mut dw, mut wdd) = ([zero; N], [zero; N], [zero; N]);
    let mut pdd = [[T::ZERO; 3]; N];
    let mut motion = Turning::default();
    for (j, link) in chain.links.iter().enumerate() {
        a[j] = link.rotation(state.cos[j], state.sin[j]);
        let da = derivative(&a[j]);
        dw[j] = if j == 0 { da } else { mul(&motion.w, &da) };
        motion = motion.next(j == 0, &a[j], state.qd[j], state.qdd[j]);
        wdd[j] = motion.wdd;
        let own = mul_vec(&wdd[j], &link.p);
        pdd[j] = if j == 0 { own } else { plus(&pdd[j - 1], &own) };
    }
    let mut tau = [T::ZERO; N];
    let (mut d, mut c, mut e) = (zero, [T::ZERO; 3], [T::ZERO; 3]);
    for (i, link) in chain.links.iter().enumerate().rev() {
        let own = plus(&times(&pdd[i], link.mass), &mul_vec(&wdd[i], &link.first_moment));
        e = if i + 1 == N { own } else { plus(&e, &own) };
        let turning = mul_transposed(&link.second_moment, &wdd[i]);
        let own = sum(&sum(&outer(&link.p, &e), &outer(&link.first_moment, &pdd[i])), &turning);
        if i + 1 == N {
            (d, c) = (own, link.augmented_first);
        } else {
            d = sum(&mul(&a[i + 1], &d), &own);
            c = plus(&mul_vec(&a[i + 1], &c), &link.augmented_first);
        }
        let weight = dot(&chain.gravity, &mul_vec(&dw[i], &c));
        tau[i] = trace_of_product(&dw[i], &transposed(&d)) - weight;
    }
    tau
}
