//! Coulomb friction with a smooth sign: τ = F s(q̇ / w).
//!
//! s is the cubic u (3 − u²) / 2 on |u| ≤ 1 and the sign beyond: continuous with its slope, ±F to
//! a rounding outside the width, and neither a comparison nor a division.

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, JointState, TorqueDerivatives, Width};
use crate::scalar::Real;

/// Coulomb friction of each joint.
///
/// ```
/// use dynamics_core::effects::{Coulomb, Width};
/// // 4 N·m, full beyond 0.02 rad/s
/// const DRY: Coulomb<f32, 1> = Coulomb { torque: [4.0], width: Width::f32(0.02) };
/// ```
#[doc(alias = "dry friction")]
#[doc(alias = "kinetic friction")]
#[doc(alias = "sliding friction")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coulomb<R, const V: usize> {
    /// Sliding friction F of each joint, N·m or N.
    pub torque: [R; V],
    /// The speed w below which friction fades, rad/s or m/s.
    pub width: Width<R>,
}

/// u (3 − u²) / 2 with u limited to ±1: the sign of u with a smooth passage through zero. A NaN
/// counts as 0.
///
/// ```
/// use dynamics_core::effects::smooth_sign;
/// assert_eq!(smooth_sign(0.5_f32), 0.6875);
/// assert_eq!(smooth_sign(-7.0_f32), -1.0);
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn smooth_sign<R: Real>(u: R) -> R {
    sliding(R::ONE, u * R::from_f64(R::MAX_TRUNC))
}

/// ds/du = 3 (1 − u²) / 2 within the width, 0 beyond, of the sign s of [`smooth_sign`].
///
/// ```
/// use dynamics_core::effects::smooth_sign_slope;
/// assert_eq!((smooth_sign_slope(0.0_f32), smooth_sign_slope(2.0_f32)), (1.5, 0.0));
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn smooth_sign_slope<R: Real>(u: R) -> R {
    let unit = R::from_f64(const { 1.0 / R::MAX_TRUNC });
    let u = (u * R::from_f64(R::MAX_TRUNC)).trunc_saturating() * unit;
    R::from_f64(1.5) * (R::ONE - u * u)
}

/// s(q̇ / w) by the same first steps as [`Coulomb`], which the compiler then takes once for both.
#[cfg_attr(optimised, inline(always))]
pub(super) fn sign_beyond<R: Real>(width: Width<R>, qd: R) -> R {
    sliding(R::ONE, qd * (width.inverse() * R::from_f64(R::MAX_TRUNC)))
}

/// F s(u), given u in units of 1/`MAX_TRUNC`: where a conversion to an integer and back limits it.
#[cfg_attr(optimised, inline(always))]
fn sliding<R: Real>(force: R, scaled: R) -> R {
    let unit = const { 1.0 / R::MAX_TRUNC };
    let u = scaled.trunc_saturating();
    let steep = force * R::from_f64(1.5 * unit);
    let bend = force * R::from_f64(0.5 * unit * unit * unit);
    u * (steep - bend * (u * u))
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Coulomb<R, V> {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::Coulomb);

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        if let Some(&torque) = self.torque.get(joint) {
            // The factors that constants leave constant stand first.
            *tau += sliding(torque, at.qd * (self.width.inverse() * R::from_f64(R::MAX_TRUNC)));
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        if let Some(&torque) = self.torque.get(joint) {
            let w_inv = self.width.inverse();
            derivatives.dqd += torque * w_inv * smooth_sign_slope(at.qd * w_inv);
        }
    }
}
