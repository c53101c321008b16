//! Limits of u and x that are linear.

use dynamics_core::scalar::Real;

/// α u + β x ≤ γ.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfPlane<R> {
    pub(super) alpha: R,
    pub(super) beta: R,
    pub(super) gamma: R,
}

impl<R: Real> HalfPlane<R> {
    /// A limit of u and of x at the end of the segment, where x is greater by 2 Δ u.
    pub(super) fn at_end(self, across: R) -> Self {
        Self { alpha: self.alpha + across * self.beta, ..self }
    }
}

/// An upper and a lower limit with the same α.
pub(super) fn both<R: Real>(
    alpha: R,
    [up, low]: [R; 2],
    [above, below]: [R; 2],
) -> [HalfPlane<R>; 2] {
    [(alpha, up, above), (-alpha, low, below)].map(|(alpha, beta, gamma)| HalfPlane {
        alpha,
        beta,
        gamma,
    })
}
