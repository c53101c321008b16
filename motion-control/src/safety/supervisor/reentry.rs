//! The return to the full law: after a hold, and after a stop.

use super::state::State;
use super::{FAR, Mode, Supervisor, real};
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// The progress of the return to the full law in this tick, 0 to 1, for the reference (see
    /// [`crate::ResumeTrajectory`]). It is zero while the arm is held and before the brake opens.
    ///
    /// ```
    /// # use motion_control::{Fault, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 0, hold_ticks: 2, reentry_ticks: 4,
    /// # })?;
    /// for (measured, share) in [(Ok(&[0.5]), 1.0), (Err(Fault::Stale), 0.0), (Ok(&[0.5]), 0.25)] {
    ///     supervisor.tick(measured, |tick| {
    ///         assert_eq!(tick.authority(), share);
    ///         [1.0]
    ///     });
    /// }
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    #[inline(always)]
    pub fn authority(&self) -> R {
        if !matches!(self.state, State::Full) | self.braked {
            R::ZERO
        } else if self.next_ramp() >= self.reentry_ticks {
            R::ONE
        } else {
            real::<R>(self.next_ramp()) * self.reentry_inv
        }
    }

    /// Restarts the arm with zero torque and the brake set: clears a latched fault and accepts the next positions that are
    /// within their limits.
    ///
    /// The brake opens when the torque of the law is reached; then [`Self::authority`] rises.
    ///
    /// ```
    /// # use motion_control::{Fault, Mode, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [2.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 0, hold_ticks: 0, reentry_ticks: 2,
    /// # })?;
    /// assert_eq!(supervisor.tick(Err(Fault::Stale), |_| [0.0]).status.mode, Mode::Stopped);
    /// supervisor.reset();
    /// for (torque, brake) in [([2.0], true), ([4.0], false)] {
    ///     let command = supervisor.tick(Ok(&[0.5]), |_| [4.0]);
    ///     assert_eq!((command.torque, command.brake), (torque, brake));
    /// }
    /// # Ok::<(), motion_control::ConfigError>(())
    /// ```
    pub fn reset(&mut self) {
        self.known = false;
        self.accepted = false;
        self.ticks_since_good = R::from_f64(FAR);
        // The rate is limited from the torque of the drives: that of a sinking arm, or of a stop without a tick since.
        if !matches!(self.mode(), Mode::Stopped) {
            self.torque = [R::ZERO; V];
        }
        self.faults = 0;
        self.quiet = 0;
        self.ramp = 0;
        if let State::Unusable(fault) = self.state {
            self.fault = Some(fault);
        } else {
            self.state = State::Full;
        }
        self.faulted = false;
        self.open = false;
        self.braked = true;
        self.reported = None;
    }
}
