//! The control law: feed-forward torque plus proportional and derivative feedback.
//!
//! τ = τ_ff + K_p (q_d − q) + K_d (q̇_d − q̇). An, Atkeson & Hollerbach, *Model-Based Control of a
//! Robot Manipulator* (1988), chapter 5; Craig, *Introduction to Robotics* (2005), section 10.5.

use crate::estimate::Estimate;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// Gains of the feedback of each joint.
#[doc(alias = "PD gains")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gains<R, const V: usize> {
    /// K_p, N·m/rad or N/m.
    pub kp: [R; V],
    /// K_d, N·m·s/rad or N·s/m.
    pub kd: [R; V],
}

impl<R: Real, const V: usize> Gains<R, V> {
    /// Gains with which each joint by itself is a damped oscillator of natural frequency `omega_n`
    /// (rad/s) and damping ratio `zeta`: K_p = M_jj ω_n², K_d = 2 ζ ω_n M_jj.
    ///
    /// `diagonal`: that of M at a representative configuration, kg·m² or kg.
    ///
    /// ```
    /// use motion_control::law::Gains;
    /// let gains = Gains::from_inertia(&[2.0_f32], 10.0, 0.7);
    /// assert_eq!((gains.kp, gains.kd), ([200.0], [28.0]));
    /// ```
    pub fn from_inertia(diagonal: &[R; V], omega_n: R, zeta: R) -> Self {
        Self {
            kp: diagonal.map(|m| m * omega_n * omega_n),
            kd: diagonal.map(|m| R::from_f64(2.0) * zeta * omega_n * m),
        }
    }
}

/// The feedback torque K_p (q_d − q) + K_d (q̇_d − q̇) of each joint, N·m or N, to be added to the
/// feed-forward.
///
/// # Cost
/// 5 flops per joint, with the same instructions for all data.
///
/// # Errors
/// None; a non-finite input gives a non-finite output, which [`crate::motion::MotionController`]
/// rejects.
///
/// ```
/// use dynamics_core::state::State;
/// use motion_control::estimate::Estimate;
/// use motion_control::law::{Gains, feedback};
/// let gains = Gains { kp: [100.0_f32], kd: [5.0] };
/// let reference = State { q: [1.0], qd: [0.5], qdd: [0.0] };
/// assert_eq!(feedback(&gains, &reference, &Estimate { q: [0.5], qd: [0.25] }), [51.25]);
/// ```
#[doc(alias = "PD control")]
#[inline(always)]
pub fn feedback<R: Real, const V: usize>(
    gains: &Gains<R, V>,
    reference: &State<R, V, V>,
    estimate: &Estimate<R, V>,
) -> [R; V] {
    let mut tau = [R::ZERO; V];
    let desired = reference.q.iter().zip(&reference.qd);
    let actual = estimate.q.iter().zip(&estimate.qd);
    let gains = gains.kp.iter().zip(&gains.kd);
    for (((tau, desired), actual), gain) in tau.iter_mut().zip(desired).zip(actual).zip(gains) {
        *tau = *gain.0 * (*desired.0 - *actual.0) + *gain.1 * (*desired.1 - *actual.1);
    }
    tau
}
