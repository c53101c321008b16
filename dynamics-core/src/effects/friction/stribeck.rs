//! Stribeck's effect: friction that falls from stiction to sliding, τ = (F_s − F_c) e^{−(q̇/v_s)²}
//! s(q̇/w).
//!
//! Bo & Pavelescu (1982); Armstrong-Hélouvry (1991), chapter 2. It is used together with
//! [`Coulomb`](crate::effects::Coulomb), which has F_c, and has the same smooth sign s.

use crate::effects::once::{Kind, Once};
use crate::effects::{
    Effect, JointState, TorqueDerivatives, Width, smooth_sign, smooth_sign_slope,
};
use crate::scalar::Real;
use crate::state::entry;

/// The friction of each joint at rest in excess of its sliding friction.
///
/// Cost: an exponential, 20 flops, and 12 more per joint. The friction causes stick-slip where it
/// decreases with speed; a step is implicit only where it increases.
///
/// ```
/// use dynamics_core::effects::{Effect, JointState, Stribeck, Width};
/// let stribeck = Stribeck { excess: [2.0_f64], stribeck_speed: Width::new(0.1), width: Width::new(1e-4) };
/// let mut tau = 0.0;
/// Effect::<f64, 1, 1>::torque(&stribeck, 0, JointState::new(0.0, 0.1), &mut tau);
/// assert!((tau - 2.0 / 1.0_f64.exp()).abs() < 1e-15);
/// ```
#[doc(alias = "stiction")]
#[doc(alias = "static friction")]
#[doc(alias = "stick-slip")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stribeck<R, const V: usize> {
    /// Stiction less sliding friction F_s − F_c of each joint, N·m or N.
    pub excess: [R; V],
    /// The speed v_s at which it has decreased to 1/e, rad/s or m/s.
    pub stribeck_speed: Width<R>,
    /// The speed w below which friction fades, rad/s or m/s; well below v_s.
    pub width: Width<R>,
}

impl<R: Real, const V: usize> Stribeck<R, V> {
    /// (F_s − F_c) e^{−(q̇/v_s)²}.
    #[cfg_attr(optimised, inline(always))]
    fn left(&self, joint: usize, qd: R) -> R {
        let u = qd * self.stribeck_speed.inverse();
        entry(&self.excess, joint) * (u * u).exp_neg()
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Stribeck<R, V> {
    const DIFFERENTIABLE: bool = true;
    const ONCE: Once = Once::of(Kind::Stribeck);

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        *tau += self.left(joint, at.qd) * smooth_sign(at.qd * self.width.inverse());
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        let rise = self.width.inverse() * smooth_sign_slope(at.qd * self.width.inverse());
        derivatives.dqd += self.left(joint, at.qd) * rise;
    }

    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        Effect::<R, B, V>::derivatives(self, joint, at, slopes);
        // The fall of e^{−(q̇/v_s)²}, with which an implicit step would not be the stabler one.
        let [fade, u] = [self.stribeck_speed, self.width].map(|width| at.qd * width.inverse());
        let fall = (fade + fade) * self.stribeck_speed.inverse();
        slopes.dqd -= fall * self.left(joint, at.qd) * smooth_sign(u);
    }
}
