//! Waters (1979): Lagrange's equations over 4 × 4 matrices with velocities and accelerations by
//! recursion, O(n²). Hollerbach (1980), equations (4) and (5):
//!
//! ```text
//! Ẇ_j = Ẇ_{j−1} A_j + W_{j−1} ∂A_j/∂q_j q̇_j
//! Ẅ_j = Ẅ_{j−1} A_j + 2 Ẇ_{j−1} ∂A_j/∂q_j q̇_j + W_{j−1} ∂²A_j/∂q_j² q̇_j² + W_{j−1} ∂A_j/∂q_j q̈_j
//! τ_i = Σ_{j ≥ i} [ tr(∂W_j/∂q_i J_j Ẅ_jᵀ) − m_j gᵀ ∂W_j/∂q_i r_j ]
//! ```
//!
//! W_j: `w`; Ẇ_j, Ẅ_j: `wd`, `wdd`; ∂W_j/∂q_i: `dw[i]`; J_j: `pseudo_inertia`.
//!
//! The count forms each product of the equations when they name it: W_{j−1} ∂A_j three times, J_j
//! Ẅ_jᵀ for each i.

use crate::chain::{Chain, State};
use crate::matrix::{Mat, derivative, dot, mul, mul_vec, scaled, sum, trace_of_product};
use crate::number::Number;

#[inline(never)]
pub fn torques<T: Number, const N: usize>(chain: &Chain<T, N>, state: &State<T, N>) -> [T; N] {
    let mut tau = [T::ZERO; N];
    let mut dw = [[[T::ZERO; 4]; 4]; N];
    let mut motion = Turning::default();
    let [x, y, z] = chain.gravity;
    let gravity = [x, y, z, T::ZERO];
    for (j, link) in chain.links.iter().enumerate() {
        let a = link.transform(state.cos[j], state.sin[j]);
        for dw in &mut dw[..j] {
            *dw = mul(dw, &a);
        }
        let da = derivative(&a);
        dw[j] = if j == 0 { da } else { mul(&motion.w, &da) };
        motion = motion.next(j == 0, &a, state.qd[j], state.qdd[j]);
        for i in 0..=j {
            let dw_j = mul(&dw[i], &link.pseudo_inertia);
            let term = trace_of_product(&dw_j, &motion.wdd);
            let weight = link.mass * dot(&gravity, &mul_vec(&dw[i], &link.com_4()));
            let term = term - weight;
            tau[i] = if i == j { term } else { tau[i] + term };
        }
    }
    tau
}

/// W, Ẇ and Ẅ of a link.
#[derive(Clone, Copy)]
pub struct Turning<T, const D: usize> {
    /// W.
    pub w: Mat<T, D>,
    /// Ẇ.
    pub wd: Mat<T, D>,
    /// Ẅ.
    pub wdd: Mat<T, D>,
}

impl<T: Number, const D: usize> Default for Turning<T, D> {
    fn default() -> Self {
        let zero = [[T::ZERO; D]; D];
        Self { w: zero, wd: zero, wdd: zero }
    }
}

impl<T: Number, const D: usize> Turning<T, D> {
    /// Those of the next link, which is the first of the chain or another.
    #[inline(always)]
    pub fn next(&self, first: bool, a: &Mat<T, D>, qd: T, qdd: T) -> Self {
        let da = derivative(a);
        let dda = derivative(&da);
        let speed = qd * qd;
        if first {
            // W_0 is the identity, at rest.
            return Self {
                w: *a,
                wd: scaled(&da, qd),
                wdd: sum(&scaled(&dda, speed), &scaled(&da, qdd)),
            };
        }
        let twice = T::of(2.0) * qd;
        let inherited = mul(&self.wdd, a);
        let crossed = scaled(&mul(&self.wd, &da), twice);
        let centripetal = scaled(&mul(&self.w, &dda), speed);
        let own = scaled(&mul(&self.w, &da), qdd);
        Self {
            w: mul(&self.w, a),
            wd: sum(&mul(&self.wd, a), &scaled(&mul(&self.w, &da), qd)),
            wdd: sum(&sum(&inherited, &crossed), &sum(&centripetal, &own)),
        }
    }
}
