//! Cogging: the detent torque between a motor's magnets and its slots, by harmonics of its angle.
//!
//! τ = Σ_k a_k cos(k n q) + b_k sin(k n q), n periods a turn of the joint: Hanselman, *Brushless
//! Permanent Magnet Motor Design* (2003), chapter 5. The multiples come from one sine and cosine by
//! the addition theorems.

use crate::effects::{Effect, JointState, TorqueDerivatives};
use crate::scalar::Real;
use crate::scalar::positive_part;
use crate::state::entry;

/// Cogging torque of each joint's motor, by H harmonics.
///
/// The motor must supply the mapped torque. Cost: a sine and cosine, and 8 flops a harmonic.
/// Accuracy: n q should stay within 10⁴ rad; an f32 q resolves the phase to 6·10⁻⁸ n q.
///
/// ```
/// use dynamics_core::effects::{Cogging, Effect, JointState};
/// // 0.2 N·m at the joint, 12 slots behind a gear of 50, and a third of it twice as often
/// let cogging = Cogging { per_turn: [600.0_f64], cos: [[0.0, 0.0]], sin: [[0.2, 0.07]] };
/// let (mut tau, q) = (0.0, 0.002_f64);
/// Effect::<f64, 1, 1>::torque(&cogging, 0, JointState::new(q, 0.0), &mut tau);
/// assert!((tau - 0.2 * (600.0 * q).sin() - 0.07 * (1200.0 * q).sin()).abs() < 1e-14);
/// ```
#[doc(alias = "detent torque")]
#[doc(alias = "torque ripple")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cogging<R, const H: usize, const V: usize> {
    /// Periods n per turn of the joint: gear ratio times the least common multiple of poles and
    /// slots.
    pub per_turn: [R; V],
    /// Amplitudes a_k of the cosines, N·m or N; k from 1.
    pub cos: [[R; H]; V],
    /// Amplitudes b_k of the sines, N·m or N; k from 1.
    pub sin: [[R; H]; V],
}

impl<R: Real, const H: usize, const V: usize> Cogging<R, H, V> {
    /// τ and dτ/dq.
    #[cfg_attr(optimised, inline(always))]
    fn at(&self, joint: usize, q: R) -> (R, R) {
        let n = entry(&self.per_turn, joint);
        let (s, c) = (n * q).sin_cos();
        let (mut sin, mut cos, mut times) = (s, c, n);
        let (mut tau, mut slope) = (R::ZERO, R::ZERO);
        if let (Some(a), Some(b)) = (self.cos.get(joint), self.sin.get(joint)) {
            for (&a, &b) in a.iter().zip(b) {
                tau += a * cos + b * sin;
                slope += times * (b * cos - a * sin);
                (sin, cos) = (sin * c + cos * s, cos * c - sin * s);
                times += n;
            }
        }
        (tau, slope)
    }
}

impl<R: Real, const H: usize, const B: usize, const V: usize> Effect<R, B, V> for Cogging<R, H, V> {
    const DIFFERENTIABLE: bool = true;

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        *tau += self.at(joint, at.q).0;
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        // If it pushes away from a slot, an implicit step would not be the stabler one.
        derivatives.dq += positive_part(self.at(joint, at.q).1);
    }

    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        slopes.dq += self.at(joint, at.q).1;
    }
}
