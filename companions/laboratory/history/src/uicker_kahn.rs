//! Uicker (1965) and Kahn (1969): Lagrange's equations over 4 × 4 matrices, O(n⁴). Hollerbach
//! (1980), equation (3):
//!
//! ```text
//! τ_i = Σ_{j ≥ i} [ Σ_{k ≤ j} tr(∂W_j/∂q_i J_j ∂W_jᵀ/∂q_k) q̈_k
//!                 + Σ_{k ≤ j} Σ_{l ≤ j} tr(∂W_j/∂q_i J_j ∂²W_jᵀ/∂q_k∂q_l) q̇_k q̇_l − m_j gᵀ ∂W_j/∂q_i r_j ]
//! ```
//!
//! W_j: `w`, from frame j to the base; ∂W_j/∂q_i: `dw[i]`; ∂²W_j/∂q_k∂q_l: `ddw[k][l]`, l ≤ k; J_j:
//! `pseudo_inertia`.
//!
//! The count: one product for W_j, for each ∂W_j/∂q_i and for each ∂²W_j/∂q_k∂q_l; those of the
//! inertia terms form ∂W_j/∂q_i J_j once for all k and use the symmetry in i and k; those of the
//! velocity terms form it anew for all k and l and use no symmetry, as the leading terms of the
//! published count do (130 products for each i, j, k, l).

use core::array::from_fn;

use crate::chain::{Chain, State};
use crate::matrix::{Mat, derivative, dot, mul, mul_vec, trace_of_product};
use crate::number::Number;

#[inline(never)]
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let mut tau = [T::ZERO; N];
    let mut inertia = [[T::ZERO; N]; N];
    let mut w = [[T::ZERO; 4]; 4];
    let mut dw = [[[T::ZERO; 4]; 4]; N];
    let mut ddw = [[[[T::ZERO; 4]; 4]; N]; N];
    let [x, y, z] = chain.gravity;
    let gravity = [x, y, z, T::ZERO];
    for (j, link) in chain.links.iter().enumerate() {
        let a = link.transform(state.cos[j], state.sin[j]);
        step(j, &a, &mut w, &mut dw, &mut ddw);
        for i in 0..=j {
            let dw_j = mul(&dw[i], &link.pseudo_inertia);
            for k in 0..=i {
                let term = trace_of_product(&dw_j, &dw[k]);
                inertia[i][k] = if i == j { term } else { inertia[i][k] + term };
            }
            for k in 0..=j {
                for l in 0..=j {
                    let second = &ddw[k.max(l)][k.min(l)];
                    let dw_j = mul(&dw[i], &link.pseudo_inertia);
                    let speeds = state.qd[k] * state.qd[l];
                    let term = trace_of_product(&dw_j, second) * speeds;
                    tau[i] = if (i, k, l) == (j, 0, 0) { term } else { tau[i] + term };
                }
            }
            let weight = link.mass * dot(&gravity, &mul_vec(&dw[i], &link.com_4()));
            tau[i] = tau[i] - weight;
        }
    }
    from_fn(|i| (0..N).fold(tau[i], |tau, k| tau + inertia[i.max(k)][i.min(k)] * state.qdd[k]))
}

/// From W_{j−1} and its derivatives to those of W_j.
#[inline(always)]
fn step<T: Number, const N: usize>(
    j: usize,
    a: &Mat<T, 4>,
    w: &mut Mat<T, 4>,
    dw: &mut [Mat<T, 4>; N],
    ddw: &mut [[Mat<T, 4>; N]; N],
) {
    let da = derivative(a);
    let dda = derivative(&da);
    for (k, row) in ddw.iter_mut().enumerate().take(j) {
        for second in row.iter_mut().take(k + 1) {
            *second = mul(second, a);
        }
    }
    for l in 0..j {
        ddw[j][l] = mul(&dw[l], &da);
        dw[l] = mul(&dw[l], a);
    }
    // W_0 is the identity.
    ddw[j][j] = if j == 0 { dda } else { mul(w, &dda) };
    dw[j] = if j == 0 { da } else { mul(w, &da) };
    *w = if j == 0 { *a } else { mul(w, a) };
}
