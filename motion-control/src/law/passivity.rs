//! The control law of Slotine & Li, which keeps the arm passive.
//!
//! Slotine & Li, "On the adaptive control of robot manipulators" (1987); Slotine & Li, *Applied
//! Nonlinear Control* (1991), chapter 9.
//!
//! ```text
//! q̇_r = q̇_d + Λ (q_d − q)      q̈_r = q̈_d + Λ (q̇_d − q̇)      s = q̇ − q̇_r
//! τ = M q̈_r + C(q, q̇) q̇_r + g + F − K_D s
//! ```

use crate::entry;
use crate::estimate::Estimate;
use dynamics_core::algorithms::rnea_two_velocities;
use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// Gains of the law of Slotine & Li, for each joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PassivityGains<R, const V: usize> {
    /// Λ, 1/s: the rate at which the error of position decays once s is zero.
    pub lambda: [R; V],
    /// K_D, N·m·s/rad or N·s/m.
    pub kd: [R; V],
}

/// The reference velocity of the law of Slotine & Li, its rate, and the distance from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingVariable<R, const V: usize> {
    /// q̇_r, rad/s or m/s.
    pub qd_r: [R; V],
    /// q̈_r, rad/s² or m/s².
    pub qdd_r: [R; V],
    /// s = q̇ − q̇_r, rad/s or m/s.
    pub s: [R; V],
}

impl<R: Real, const V: usize> PassivityGains<R, V> {
    /// The sliding variable s = q̇ − q̇_r, rad/s or m/s, with q̇_r = q̇_d + Λ (q_d − q) and its
    /// rate.
    ///
    /// For a law of one's own with
    /// [`rnea_two_velocities`](dynamics_core::algorithms::rnea_two_velocities()), for example one
    /// whose dynamics use sines and cosines that are computed already.
    ///
    /// # Cost
    /// 7 flops for each joint.
    ///
    /// # Source
    /// Slotine & Li (1987).
    ///
    /// ```
    /// use dynamics_core::state::State;
    /// use motion_control::{estimate::Estimate, law::PassivityGains};
    /// let gains = PassivityGains { lambda: [4.0_f32], kd: [5.0] };
    /// let reference = State { q: [1.0], qd: [0.5], qdd: [0.0] };
    /// let sliding = gains.sliding(&reference, &Estimate { q: [0.5], qd: [0.25] });
    /// assert_eq!((sliding.qd_r, sliding.qdd_r, sliding.s), ([2.5], [1.0], [-2.25]));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn sliding(
        &self,
        reference: &State<R, V, V>,
        estimate: &Estimate<R, V>,
    ) -> SlidingVariable<R, V> {
        let off = |wanted: &[R; V], actual: &[R; V], i| entry(wanted, i) - entry(actual, i);
        let qd_r = core::array::from_fn(|i| {
            entry(&reference.qd, i) + entry(&self.lambda, i) * off(&reference.q, &estimate.q, i)
        });
        let qdd_r = core::array::from_fn(|i| {
            entry(&reference.qdd, i) + entry(&self.lambda, i) * off(&reference.qd, &estimate.qd, i)
        });
        let s = core::array::from_fn(|i| off(&estimate.qd, &qd_r, i));
        SlidingVariable { qd_r, qdd_r, s }
    }
}

/// The torque of each motor by the law of Slotine & Li, N·m or N, under the effects of the scene.
///
/// ```text
/// τ   = M q̈_r + C(q, q̇) q̇_r + g + F − K_D s
/// q̇_r = q̇_d + Λ (q_d − q)      s = q̇ − q̇_r
/// ```
///
/// As Ṁ = C + Cᵀ, with an exact model d/dt (½ sᵀ M s) = −sᵀ K_D s: s and with it the error of
/// tracking decay at any speed, without the inverse or the measured acceleration that computed
/// torque needs to be exact. A model that is off leaves an error: at rest Λ⁻¹ K_D⁻¹ times the error
/// of g + F.
///
/// Friction is that at the measured velocity. To compensate that of the reference, so that an
/// estimated friction that is too large does not push, leave it out of `effects` and add it at
/// q̇_r.
///
/// # Shape
/// V; the position coordinates are as many, as in every [`State`] of the controller.
///
/// # Cost
/// The cost of [`rnea_two_velocities`](dynamics_core::algorithms::rnea_two_velocities()) and 9
/// flops for each joint, the same instructions for all data.
///
/// # Errors
/// None; a non-finite input gives a non-finite output, which [`crate::motion::MotionController`]
/// rejects.
///
/// # Source
/// Slotine & Li (1987).
///
/// ```
/// use motion_control::estimate::Estimate;
/// use motion_control::law::{PassivityGains, passivity_based_torque};
/// use dynamics_core::{Core, effects::RIGID_BODY, model::Static, robots::Ur5e, state::State};
/// let gains = PassivityGains { lambda: [10.0_f32; 6], kd: [60.0, 60.0, 30.0, 5.0, 5.0, 5.0] };
/// let reference = State { qd: [0.1; 6], qdd: [0.5; 6], ..State::at([0.0, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let estimate = Estimate { q: reference.q, qd: reference.qd };
/// let robot = &Static::<Ur5e>::NEW;
/// let tau = passivity_based_torque(robot, &gains, &reference, &estimate, &RIGID_BODY);
/// // On the trajectory it is inverse dynamics.
/// for (tau, id) in tau.iter().zip(Core::<Ur5e>::rnea(&reference, &RIGID_BODY)) {
///     assert!((tau - id).abs() < 1e-4);
/// }
/// ```
#[doc(alias = "Slotine-Li")]
#[doc(alias = "adaptive control")]
#[inline(always)]
#[must_use]
pub fn passivity_based_torque<R: Real, D, E, const B: usize, const V: usize>(
    robot: &D,
    gains: &PassivityGains<R, V>,
    reference: &State<R, V, V>,
    estimate: &Estimate<R, V>,
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, V, V>,
    E: Effect<R, B, V>,
{
    let SlidingVariable { qd_r, qdd_r, s } = gains.sliding(reference, estimate);
    let state = State { q: estimate.q, qd: estimate.qd, qdd: qdd_r };
    let mut tau = rnea_two_velocities(robot, &state, &qd_r, effects);
    for ((tau, s), kd) in tau.iter_mut().zip(s).zip(gains.kd) {
        *tau -= kd * s;
    }
    tau
}
