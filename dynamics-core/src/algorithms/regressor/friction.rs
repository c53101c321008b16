//! The columns of friction in the regressor.

use crate::effects::{Width, smooth_sign};
use crate::scalar::Real;

/// The regressor of viscous and Coulomb friction of each coordinate: q̇ and the smooth sign s(q̇ /
/// w).
///
/// The torque of both at coordinate j is the product of row j with (b, F): of
/// [`Viscous`](crate::effects::Viscous), N·m·s/rad or N·s/m, and of
/// [`Coulomb`](crate::effects::Coulomb) of the same width, N·m or N. Friction of other coordinates
/// has no part in it.
///
/// ```text
/// τ_j = b_j q̇_j + F_j s(q̇_j / w)
/// ```
///
/// # Shape
/// V × 2.
///
/// # Cost
/// 6 flops for each coordinate.
///
/// # Source
/// Swevers, Verdonck & De Schutter, "Dynamic model identification for industrial robots" (2007),
/// (1).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::friction_regressor;
/// use dynamics_core::effects::{Coulomb, Viscous, Width};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let (state, width) = (State { qd: [0.01; 6], ..State::at([0.0_f64; 6]) }, Width::new(0.02));
/// let [[viscous, coulomb], ..] = friction_regressor(&state.qd, width);
/// let friction = (Viscous([5.0; 6]), Coulomb { torque: [4.0; 6], width });
/// let tau = Core::<Ur5e>::rnea(&state, &friction)[0];
/// assert!((5.0 * viscous + 4.0 * coulomb - tau).abs() < 1e-12);
/// ```
#[inline]
#[must_use]
pub fn friction_regressor<R: Real, const V: usize>(qd: &[R; V], width: Width<R>) -> [[R; 2]; V] {
    qd.map(|qd| [qd, smooth_sign(qd * width.inverse())])
}
