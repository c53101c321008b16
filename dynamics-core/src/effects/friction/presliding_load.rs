//! Friction of gears in proportion to the transmitted torque, with a direction that follows the
//! motion over a distance: ż = (q̇ − |q̇| z) / h, F = μₐ |τ_m| z + μ_d τ_m z².
//!
//! τ_m is the motor's torque. Of strain-wave and cycloidal gears, measured while they drive and are
//! driven, it fits better than three forms of LuGre with up to eight parameters: google-deepmind/
//! mujoco, issue 3528, comment of 2026-09-18 (four parameters with the viscous one). With τ = τ_m −
//! F, the torque for all else, and m = μₐ z, d = μ_d z² it is a |τ| + b τ, a = m / N, 1 + b = (1 −
//! d) / N, N = (1 − d)² − m².

use crate::effects::once::{Kind, Once};
use crate::effects::{Effect, JointState, LoadFactors, hook};
use crate::scalar::Real;
use crate::state::entry;

/// Friction of each joint's gear in proportion to the motor's torque, that holds at rest.
///
/// As [`LoadFriction`](crate::effects::LoadFriction), with memory in place of a width: z is the
/// direction of the last motion, and a joint that turns back has its full friction again after a
/// few h. While z is ±1, the gear's efficiency is 1 − μₐ − μ_d while the motor drives the load, and
/// 1/(1 + μₐ − μ_d) while the load drives the motor. It is passive for |μ_d| ≤ μₐ, and solvable for
/// μₐ + |μ_d| < 1. [`Viscous`](crate::effects::Viscous) friction is the fourth parameter of the
/// law.
///
/// Memory: `direction`, V numbers from −1 to 1, advanced by the plant or, from measured velocities,
/// by the controller, implicitly: z₊ = (z + t q̇/h) / (1 + t |q̇|/h) for a step t. A joint of the
/// inertia M that sticks has the stiffness μₐ |τ| / h, and steps are stable below 2 √(M h / (μₐ
/// |τ|)).
///
/// Cost: a division and some 12 flops a joint; in forward dynamics a division more.
///
/// ```
/// use dynamics_core::effects::{Effect, Gravity, JointState, PreslidingLoadFriction};
/// use dynamics_core::{Core, robots::Ur5e, state::State};
/// let mut gears = PreslidingLoadFriction {
///     magnitude: [0.25_f64; 6], torque: [0.05; 6], deflection: [2e-3; 6], direction: [0.0; 6],
/// };
/// let arm = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
/// let torque = |gears| Core::<Ur5e>::rnea(&arm, &(Gravity::EARTH, gears))[1];
/// let holding = torque(gears); // negative, and without friction: nothing has moved yet
/// for _ in 0..100 {
///     Effect::<f64, 6, 6>::advance(&mut gears, 1, JointState::new(0.0, -0.1), 1e-2);
/// }
/// assert!((torque(gears) * (1.0 - 0.25 - 0.05) - holding).abs() < 1e-9); // the motor has lifted
/// ```
#[doc(alias = "gear efficiency")]
#[doc(alias = "elasto-plastic friction")]
#[doc(alias = "harmonic drive")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreslidingLoadFriction<R, const V: usize> {
    /// Friction μₐ per torque of the motor, the mean of both directions.
    pub magnitude: [R; V],
    /// Half of the difference μ_d of the friction between driving and being driven.
    pub torque: [R; V],
    /// The distance h over which the friction follows a new direction, rad or m.
    pub deflection: [R; V],
    /// The direction z, −1 to 1; zero before the first motion.
    pub direction: [R; V],
}

impl<R: Real, const V: usize> PreslidingLoadFriction<R, V> {
    /// a = m / N and b = (1 − d) / N − 1.
    #[cfg_attr(optimised, inline(always))]
    fn factors(&self, joint: usize, _: JointState<R>, add: &mut LoadFactors<R>) {
        let z = entry(&self.direction, joint);
        let m = entry(&self.magnitude, joint) * z;
        let rest = R::ONE - entry(&self.torque, joint) * (z * z);
        let square = m * m;
        let inverse = R::ONE / (rest * rest - square);
        add.magnitude += m * inverse;
        add.torque += (rest * (R::ONE - rest) + square) * inverse;
    }

    /// z does not depend on the velocity of the same instant.
    #[cfg_attr(optimised, inline(always))]
    fn slopes(&self, _: usize, _: JointState<R>, _: &mut LoadFactors<R>) {}
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for PreslidingLoadFriction<R, V> {
    const ONCE: Once = Once::of(Kind::PreslidingLoadFriction);
    const LOAD_FRICTION: hook::LoadFriction<Self, R> =
        hook::LoadFriction::new(Self::factors, Self::slopes);

    #[cfg_attr(optimised, inline(always))]
    fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
        let moved = h * at.qd / entry(&self.deflection, joint);
        if let Some(z) = self.direction.get_mut(joint) {
            *z = (*z + moved) / (R::ONE + moved.abs());
        }
    }
}
