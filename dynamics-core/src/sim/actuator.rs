//! A motor with its current controller: the torque at the joint that results from a command.
//!
//! i_c = τ_c / k within ±I; the supply drives at most (U − k ω)/R and at least (−U − k ω)/R against
//! the back-EMF k ω; the current follows with the lag T: T di/dt = i_c − i; τ = k i. Krause,
//! Wasynczuk & Sudhoff, *Analysis of Electric Machinery* (2002), chapter 2. In SI units the torque
//! constant is the back-EMF constant.

use crate::scalar::Real;

/// The actuator of one joint, with all quantities reflected to the joint: with a gear ratio of ρ, k
/// is ρ times that of the motor.
///
/// ```
/// use dynamics_core::sim::Actuator;
/// // 2 N·m/A at the joint, 10 A, 48 V, 1.2 Ω: turns at 24 rad/s without load
/// let mut drive = Actuator { torque_constant: 2.0_f64, current_limit: 10.0, voltage: 48.0, resistance: 1.2, lag: 1e-3, current: 0.0 };
/// for _ in 0..100 {
///     drive.advance(1e3, 0.0, 1e-3);
/// }
/// assert!((drive.torque() - 20.0).abs() < 1e-12); // the current limit
/// assert!(drive.saturated_torque(1e3, 18.0) == 20.0 && drive.saturated_torque(1e3, 24.0) == 0.0); // the torque-speed curve
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actuator<R> {
    /// Torque constant k at the joint, N·m/A, which is its back-EMF constant, V·s/rad.
    pub torque_constant: R,
    /// Greatest current I that the controller commands, A.
    pub current_limit: R,
    /// Supply voltage U, V.
    pub voltage: R,
    /// Resistance R of the winding, Ω.
    pub resistance: R,
    /// Time constant T of the current loop, s; not 0.
    pub lag: R,
    /// The present current i, A.
    pub current: R,
}

impl<R: Real> Actuator<R> {
    /// The present torque, N·m.
    #[cfg_attr(optimised, inline(always))]
    pub fn torque(&self) -> R {
        self.torque_constant * self.current
    }

    /// The steady-state torque of a command at the joint's speed, N·m: within the current limit and
    /// below the torque-speed curve k (U − k ω)/R; above the no-load speed the back-EMF brakes.
    #[cfg_attr(optimised, inline(always))]
    pub fn saturated_torque(&self, command: R, speed: R) -> R {
        let k = self.torque_constant;
        let wanted = (command / k).clamped(-self.current_limit, self.current_limit);
        let emf = k * speed;
        let least = (-self.voltage - emf) / self.resistance;
        let most = (self.voltage - emf) / self.resistance;
        k * wanted.clamped(least, most)
    }

    /// Advances the current by h seconds at a constant command (N·m) and speed (rad/s), exactly.
    ///
    /// A NaN is treated as the most negative command: check commands before.
    #[cfg_attr(optimised, inline(always))]
    pub fn advance(&mut self, command: R, speed: R, h: R) {
        let goal = self.saturated_torque(command, speed) / self.torque_constant;
        self.current = goal + (self.current - goal) * (h / self.lag).exp_neg();
    }
}
