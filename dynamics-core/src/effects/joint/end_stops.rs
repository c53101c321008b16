//! Joint stops: springs and dampers beyond the limits.
//!
//! At depth p = max(0, q − q_max) the stop pushes back with max(0, k p + b c q̇), c growing from 0
//! to 1 with the depth: continuous at first touch, and it never pulls. The lower stop is its mirror
//! image. Hunt & Crossley, "Coefficient of restitution interpreted as damping in vibroimpact"
//! (1975).

use crate::effects::{
    Effect, JointState, TorqueDerivatives, Width, smooth_sign, smooth_sign_slope,
};
use crate::scalar::Real;
use crate::scalar::positive_part;
use crate::state::entry;

/// End stops of each joint at the ends of its travel.
///
/// The motor supplies the torque against them. End stops are stiff: integrate the plant implicitly
/// ([`crate::sim::linearly_implicit`]). In the step in which a joint leaves a stop, the
/// linearisation may then retard it. In such steps ∂τ/∂q is k alone: the term b c′(p) q̇, by which
/// the damping grows with the depth, is omitted, since it is negative while a joint leaves. Cost:
/// 30 flops per joint, no comparison.
///
/// ```
/// use dynamics_core::effects::{EndStops, Width};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let stops = EndStops {
///     lower: [-2.0_f32; 6], upper: [2.0; 6], stiffness: 1e4, damping: 50.0, damping_depth: Width::new(1e-3),
/// };
/// let tau = Core::<Ur5e>::rnea(&State::at([0.0, 2.5, -2.5, 2.0, -2.0, 1.0]), &stops);
/// assert_eq!(tau, [0.0, 5e3, -5e3, 0.0, 0.0, 0.0]);
/// ```
#[doc(alias = "joint limit")]
#[doc(alias = "hard stop")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndStops<R, const V: usize> {
    /// Least position, rad or m.
    pub lower: [R; V],
    /// Greatest position, rad or m.
    pub upper: [R; V],
    /// Stiffness k of a stop, N·m/rad or N/m.
    pub stiffness: R,
    /// Damping b of a stop, N·m·s/rad or N·s/m.
    pub damping: R,
    /// The depth from which on the damping has its full value, rad or m.
    pub damping_depth: Width<R>,
}

/// The torque of one stop, and its derivatives with respect to depth and rate.
struct Push<R> {
    force: R,
    derivatives: TorqueDerivatives<R>,
    /// The part of ∂τ/∂q by which the damping grows with the depth.
    growth: R,
}

impl<R: Real, const V: usize> EndStops<R, V> {
    /// The stop `beyond` which a joint moves outwards with `rate`.
    #[cfg_attr(optimised, inline(always))]
    fn push(&self, beyond: R, rate: R) -> Push<R> {
        let depth = positive_part(beyond);
        let u = depth * self.damping_depth.inverse();
        let b = self.damping * smooth_sign(u);
        let force = positive_part(self.stiffness * depth + b * rate);
        // 1 where it pushes, else 0, without a comparison.
        let active = force / (force + R::MIN_POSITIVE);
        Push {
            force,
            derivatives: TorqueDerivatives { dq: self.stiffness * active, dqd: b * active },
            growth: self.damping
                * smooth_sign_slope(u)
                * self.damping_depth.inverse()
                * rate
                * active,
        }
    }

    /// The stops at the upper and at the lower end.
    #[cfg_attr(optimised, inline(always))]
    fn ends(&self, joint: usize, at: JointState<R>) -> [Push<R>; 2] {
        [
            self.push(at.q - entry(&self.upper, joint), at.qd),
            self.push(entry(&self.lower, joint) - at.q, -at.qd),
        ]
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for EndStops<R, V> {
    const DIFFERENTIABLE: bool = true;

    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        let [upper, lower] = self.ends(joint, at);
        *tau += upper.force - lower.force;
    }

    #[cfg_attr(optimised, inline(always))]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        for push in self.ends(joint, at) {
            derivatives.dq += push.derivatives.dq;
            derivatives.dqd += push.derivatives.dqd;
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        Effect::<R, B, V>::derivatives(self, joint, at, slopes);
        for push in self.ends(joint, at) {
            slopes.dq += push.growth;
        }
    }
}
