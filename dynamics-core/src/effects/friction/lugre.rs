//! LuGre friction: bristles that deflect before they slide.
//!
//! ż = q̇ − σ₀ |q̇| z / g(q̇), τ = σ₀ z + σ₁ ż + σ₂ q̇, g(q̇) = F_c + (F_s − F_c) e^{−(q̇/v_s)²}:
//! Canudas de Wit, Olsson, Åström & Lischinsky, "A new model for control of systems with friction"
//! (1995), equations (1) to (4). One bristle a joint: z is in rad or m.

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, JointState, TorqueDerivatives, Width};
use crate::scalar::Real;
use crate::state::entry;

/// LuGre friction of each joint, with the deflection of its bristles.
///
/// Memory: `bristle`, V numbers, advanced by the plant (implicitly: z₊ = (z + h q̇)/(1 + h σ₀ |q̇|
/// / g), so that no step makes it unstable). The model is passive (it returns no more than the σ₀
/// z²/2 that its bristles store) while σ₁ ≤ 4 g / |q̇|, which may be violated by fast joints. With
/// σ₁ near √(σ₀ M) the inertia M does not oscillate on the bristles. Cost: an exponential, a
/// division and some 20 flops per joint. Where derivatives of dynamics are computed it is
/// [`Frozen`](crate::effects::Frozen): its bristles are a state of their own.
///
/// ```
/// use dynamics_core::effects::{Effect, JointState, Lugre, Width};
/// let mut friction = Lugre {
///     stiffness: [1e5_f64], damping: [300.0], viscous: [0.4],
///     sliding: [1.0], excess: [0.5], stribeck_speed: Width::new(0.01), bristle: [0.0],
/// };
/// let creeping = JointState::new(0.0, 1e-6);
/// Effect::<f64, 1, 1>::advance(&mut friction, 0, creeping, 1.0);
/// assert!((friction.bristle[0] - 1e-6).abs() < 1e-7); // bends with the joint
/// for _ in 0..100 {
///     Effect::<f64, 1, 1>::advance(&mut friction, 0, creeping, 1.0);
/// }
/// assert!((friction.bristle[0] - 1.5 / 1e5).abs() < 1e-7); // slides at g = F_s
/// ```
#[doc(alias = "stick-slip")]
#[doc(alias = "presliding")]
#[doc(alias = "bristle")]
#[doc(alias = "LuGre")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lugre<R, const V: usize> {
    /// Stiffness σ₀ of the bristles, N·m/rad or N/m.
    pub stiffness: [R; V],
    /// Damping σ₁ of the bristles, N·m·s/rad or N·s/m.
    pub damping: [R; V],
    /// Viscous friction σ₂, N·m·s/rad or N·s/m.
    pub viscous: [R; V],
    /// Sliding friction F_c, N·m or N.
    pub sliding: [R; V],
    /// Stiction less sliding friction F_s − F_c, N·m or N.
    pub excess: [R; V],
    /// Stribeck's speed v_s, rad/s or m/s.
    pub stribeck_speed: Width<R>,
    /// Deflection z of the bristles, rad or m; zero when relaxed.
    pub bristle: [R; V],
}

impl<R: Real, const V: usize> Lugre<R, V> {
    /// σ₀ / g(q̇): the reciprocal of the deflection at which bristles slide.
    #[cfg_attr(optimised, inline(always))]
    fn deflection_inv(&self, joint: usize, qd: R) -> R {
        let (at, u) = (|values| entry::<R>(values, joint), qd * self.stribeck_speed.inverse());
        at(&self.stiffness) / (at(&self.sliding) + at(&self.excess) * (u * u).exp_neg())
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Lugre<R, V> {
    const ONCE: Once = Once::of(Kind::Lugre);

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        let of = |values| entry::<R>(values, joint);
        let z = of(&self.bristle);
        let rate = at.qd - at.qd.abs() * self.deflection_inv(joint, at.qd) * z;
        *tau += of(&self.stiffness) * z + of(&self.damping) * rate + of(&self.viscous) * at.qd;
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        let of = |values| entry::<R>(values, joint);
        // The sign of q̇ without a comparison; 0 at rest, where the bristles bend with the joint.
        let sign = at.qd / (at.qd.abs() + R::MIN_POSITIVE);
        // dz/dq = 1 − σ₀ z sgn(q̇) / g: 1 where they stick, 0 where they slide.
        let bends = R::ONE - sign * self.deflection_inv(joint, at.qd) * of(&self.bristle);
        derivatives.dq += of(&self.stiffness) * crate::scalar::positive_part(bends);
        derivatives.dqd +=
            of(&self.damping) * crate::scalar::positive_part(bends) + of(&self.viscous);
    }

    #[cfg_attr(optimised, inline(always))]
    fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
        let slip = h * at.qd.abs() * self.deflection_inv(joint, at.qd);
        if let Some(z) = self.bristle.get_mut(joint) {
            *z = (*z + h * at.qd) / (R::ONE + slip);
        }
    }
}
