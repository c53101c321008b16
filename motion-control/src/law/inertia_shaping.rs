//! Less apparent inertia of an arm without torque sensors: the observed external torques,
//! amplified.
//!
//! With r the external torques of a momentum observer of bandwidth K, an amplification k and a
//! damping d:
//!
//! ```text
//! τ = k dead(r) − d q̇, limited      dead(r) = r − clamp(r, ±δ)      r = K/(s + K) τ_ext
//! ```
//!
//! One joint of inertia M has towards the hand, where the dead band and the limit do not act, the
//! impedance
//!
//! ```text
//! Z(s) = τ_ext / q̇ = (M s + d) (s + K) / (s + K (1 + k))
//! Re Z(jω) ≥ 0 for all ω  ⟺  d ≥ k K M
//! |Z(jω)|² / (ω M)² = (1 + x k²) (1 + x) / (1 + x (1 + k)²)      x = (K/ω)², with d = k K M
//! ```
//!
//! Below K/(1 + k) the joint is a damper d/(1 + k), above K it has its inertia. Colgate & Hogan,
//! "Robust control of dynamically interacting systems" (1988), have the condition: a passive
//! impedance is stable in contact with everything passive. The least of the last line is 3/4, at k
//! = 1 and ω = √2 K: a passive joint is at most 13 % lighter, and heavier below K √(k/2).

use crate::entry;
use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::algorithms::MassMatrix;
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// The parameters of [`InertiaShaping`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct InertiaShapingConfig<R, const V: usize> {
    /// k: slow pushes act with 1 + k of their torque.
    pub amplification: R,
    /// δ of each joint, N·m or N: external torques up to here are errors of the model, and are not
    /// amplified.
    pub dead_band: [R; V],
    /// d of each joint, N·m·s/rad or N·s/m; [`InertiaShaping::passive_damping`] has the least one
    /// of a passive arm.
    pub damping: [R; V],
    /// The greatest torque of each joint, N·m or N.
    pub torque: [R; V],
}

/// The law of an arm that a hand moves with less than its inertia: torques to add to those of
/// [`HandGuiding`](crate::law::HandGuiding).
///
/// It amplifies what a [`MomentumObserver`](crate::estimate::MomentumObserver) finds. The observer
/// lags, and an amplified lag pushes a stiff hand to and fro: without enough damping the arm
/// oscillates in contact. With enough of it, the arm is hardly lighter: by at most 13 % at one
/// frequency of the motion. Less damping relies on the damping of the hand.
///
/// ```
/// use dynamics_core::Core;
/// use motion_control::law::{InertiaShaping, InertiaShapingConfig};
/// use dynamics_core::effects::{Armature, RIGID_BODY};
/// use dynamics_core::robots::Ur5e;
/// let q = [0.0_f32, -1.57, 1.57, -1.57, -1.57, 0.0];
/// let m = Core::<Ur5e>::crba(&q, &(RIGID_BODY, Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25])));
/// let shaping = InertiaShaping::try_new(InertiaShapingConfig {
///     amplification: 1.0,
///     dead_band: [2.0, 4.0, 3.0, 0.5, 0.5, 0.5],
///     damping: InertiaShaping::passive_damping(1.0, 5.0, &m), // of an observer of 5 rad/s
///     torque: [30.0, 30.0, 20.0, 5.0, 5.0, 5.0],
/// })?;
/// let external = [6.0, 0.0, 0.0, 0.0, 0.0, 0.0]; // MomentumObserver::external_torque
/// assert_eq!(shaping.torque(&external, &[0.0; 6])[0], 4.0);
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "inertia reduction")]
#[doc(alias = "apparent inertia")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertiaShaping<R, const V: usize> {
    config: InertiaShapingConfig<R, V>,
}

impl<R: Real, const V: usize> InertiaShapingConfig<R, V> {
    /// Checks that all numbers are finite and not negative.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names the number.
    pub fn check(&self) -> Result<(), ConfigError> {
        let not_negative = |x: &R| x.is_finite() & (*x >= R::ZERO);
        let amplification = not_negative(&self.amplification);
        ConfigParameter::Amplification.require(amplification)?;
        let joints = [&self.dead_band, &self.damping, &self.torque];
        let all = joints.into_iter().flatten().all(not_negative);
        ConfigParameter::ShapedJoint.require(all)
    }
}

impl<R: Real, const V: usize> InertiaShaping<R, V> {
    /// The law of this configuration.
    ///
    /// # Errors
    /// [`ConfigError`], as [`InertiaShapingConfig::check`].
    pub fn try_new(config: InertiaShapingConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self { config })
    }

    /// The least damping of each joint with which an arm of the mass matrix M is passive, N·m·s/rad
    /// or N·s/m, for this amplification and this bandwidth of the observer, rad/s: k K Σ_j |M_ij|.
    ///
    /// D − k K M is then dominated by its diagonal, and therefore positive semidefinite
    /// (Gershgorin, 1931). It holds at the posture of M; take the largest of the postures in which
    /// the arm is guided.
    #[must_use]
    pub fn passive_damping(amplification: R, bandwidth: R, m: &MassMatrix<R, V>) -> [R; V] {
        core::array::from_fn(|i| {
            let row = (0..V).map(|j| m.get(i, j).abs());
            amplification * bandwidth * row.fold(R::ZERO, |sum, entry| sum + entry)
        })
    }

    /// The torques to add, N·m or N, from the external torques of the observer and the estimated
    /// velocities: finite whatever the arguments are. A number that is not finite counts as zero.
    ///
    /// # Cost
    /// 5 flops and 4 comparisons a joint, the same for all data.
    #[inline]
    #[must_use]
    pub fn torque(&self, external: &[R; V], qd: &[R; V]) -> [R; V] {
        let config = &self.config;
        core::array::from_fn(|i| {
            let [r, qd] = [entry(external, i), entry(qd, i)];
            let (r, qd) =
                (R::either(r.is_finite(), r, R::ZERO), R::either(qd.is_finite(), qd, R::ZERO));
            let band = entry(&config.dead_band, i);
            let beyond = r - r.clamped(-band, band);
            let tau = config.amplification * beyond - entry(&config.damping, i) * qd;
            let most = entry(&config.torque, i);
            // An overflow on both sides would be a NaN.
            R::either(tau.is_finite(), tau, R::ZERO).clamped(-most, most)
        })
    }
}
