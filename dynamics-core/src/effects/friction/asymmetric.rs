//! Coulomb friction that differs with direction: τ = (F₊ + F₋)/2 s + (F₊ − F₋)/2 s².
//!
//! s = s(q̇ / w) is the smooth sign of [`Coulomb`](crate::effects::Coulomb): F₊ where it is 1, −F₋
//! where it is −1, and since |F₊ − F₋| ≤ F₊ + F₋ never of the sign of a drive. Gears load their
//! flanks differently: Armstrong-Hélouvry, *Control of Machines with Friction* (1991), chapter 4.

use crate::effects::once::{Kind, Once};
use crate::effects::{
    Effect, JointState, TorqueDerivatives, Width, smooth_sign, smooth_sign_slope,
};
use crate::scalar::Real;
use crate::state::entry;

/// Coulomb friction of each joint, forward and backward, N·m or N.
///
/// Cost: four flops a joint more than [`Coulomb`](crate::effects::Coulomb).
///
/// ```
/// use dynamics_core::effects::{AsymmetricCoulomb, Width};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let dry = AsymmetricCoulomb { forward: [5.0_f32; 6], backward: [3.0; 6], width: Width::new(0.02) };
/// let moving = State { qd: [1.0, -1.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0; 6]) };
/// let tau = Core::<Ur5e>::rnea(&moving, &dry);
/// assert_eq!(tau[..3], [5.0, -3.0, 0.0]);
/// ```
#[doc(alias = "direction-dependent friction")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsymmetricCoulomb<R, const V: usize> {
    /// Sliding friction F₊ at q̇ > 0, N·m or N.
    pub forward: [R; V],
    /// Sliding friction F₋ at q̇ < 0, N·m or N; positive.
    pub backward: [R; V],
    /// The speed w below which friction fades, rad/s or m/s.
    pub width: Width<R>,
}

impl<R: Real, const V: usize> AsymmetricCoulomb<R, V> {
    /// Half of F₊ + F₋ and of F₊ − F₋.
    #[cfg_attr(optimised, inline(always))]
    fn halves(&self, joint: usize) -> (R, R) {
        let half = R::from_f64(0.5);
        let (ahead, back) = (entry(&self.forward, joint), entry(&self.backward, joint));
        (half * (ahead + back), half * (ahead - back))
    }

    /// dτ/dq̇.
    #[cfg_attr(optimised, inline(always))]
    fn slope(&self, joint: usize, qd: R) -> R {
        let ((even, odd), u) = (self.halves(joint), qd * self.width.inverse());
        (even + (odd + odd) * smooth_sign(u)) * smooth_sign_slope(u) * self.width.inverse()
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for AsymmetricCoulomb<R, V> {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::AsymmetricCoulomb);

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        let ((even, odd), s) = (self.halves(joint), smooth_sign(at.qd * self.width.inverse()));
        *tau += s * (even + odd * s);
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        // If friction falls with speed, an implicit step would not be the stabler one.
        derivatives.dqd += crate::scalar::positive_part(self.slope(joint, at.qd));
    }

    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        slopes.dqd += self.slope(joint, at.qd);
    }
}
