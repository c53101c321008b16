//! Hollerbach (1980): Lagrange's equations over 4 × 4 matrices with recursions in both directions,
//! O(n). Equations (7) to (9), with Ẅ_j of [`crate::waters`]:
//!
//! ```text
//! D_i = J_i Ẅ_iᵀ + A_{i+1} D_{i+1}
//! c_i = m_i r_i + A_{i+1} c_{i+1}
//! τ_i = tr(∂W_i/∂q_i D_i) − gᵀ ∂W_i/∂q_i c_i
//! ```
//!
//! J_i: `pseudo_inertia`; ∂W_i/∂q_i = W_{i−1} ∂A_i/∂q_i: `dw`; m_i r_i: `first_moment_4`.

use crate::chain::{Chain, State};
use crate::matrix::{
    derivative, dot, mul, mul_transposed, mul_vec, plus, sum, trace_of_product, transposed,
};
use crate::number::Number;
use crate::waters::Turning;

#[inline(never)]
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let zero = [[T::ZERO; 4]; 4];
    let (mut a, mut dw, mut wdd) = ([zero; N], [zero; N], [zero; N]);
    let mut motion = Turning::default();
    for (j, link) in chain.links.iter().enumerate() {
        a[j] = link.transform(state.cos[j], state.sin[j]);
        let da = derivative(&a[j]);
        dw[j] = if j == 0 { da } else { mul(&motion.w, &da) };
        motion = motion.next(j == 0, &a[j], state.qd[j], state.qdd[j]);
        wdd[j] = motion.wdd;
    }
    let mut tau = [T::ZERO; N];
    let [x, y, z] = chain.gravity;
    let gravity = [x, y, z, T::ZERO];
    let (mut d, mut c) = (zero, [T::ZERO; 4]);
    for (i, link) in chain.links.iter().enumerate().rev() {
        let own = mul_transposed(&link.pseudo_inertia, &wdd[i]);
        if i + 1 == N {
            (d, c) = (own, link.first_moment_4);
        } else {
            d = sum(&own, &mul(&a[i + 1], &d));
            c = plus(&link.first_moment_4, &mul_vec(&a[i + 1], &c));
        }
        tau[i] = trace_of_product(&dw[i], &transposed(&d)) - dot(&gravity, &mul_vec(&dw[i], &c));
    }
    tau
}
