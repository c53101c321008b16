//! The way back to the full law: after a hold, and after a stop.

use super::{FAR, Mode, Supervisor, real};
use crate::scalar::Real;

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// How far the arm is on its way back to the full law in this tick, 0 to 1: for the reference to
    /// follow (see [`super::super::Rejoin`]). Zero while the arm is held and while the brake waits.
    ///
    /// ```
    /// # use dynamics_core::control::{SafetyLimits, Fault, Supervisor};
    /// # let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let mut supervisor = Supervisor::new(bounds, 1e-3, 2, 4);
    /// for (measured, share) in [(Ok(&[0.5]), 1.0), (Err(Fault::Stale), 0.0), (Ok(&[0.5]), 0.25)] {
    ///     supervisor.admit(measured);
    ///     assert_eq!(supervisor.authority(), share);
    ///     supervisor.pass(&[1.0]);
    /// }
    /// ```
    #[inline(always)]
    pub fn authority(&self) -> R {
        if !matches!(self.mode, Mode::Full) | self.braked {
            R::ZERO
        } else if self.next_ramp() >= self.reentry_ticks {
            R::ONE
        } else {
            real::<R>(self.next_ramp()) * self.reentry_inv
        }
    }

    /// Starts again, from zero torque on the brake: clears a latched fault and takes the next
    /// plausible positions as they are. The brake opens when the torque asked for is there; then
    /// [`Self::authority`] rises.
    ///
    /// ```
    /// # use dynamics_core::control::{SafetyLimits, Fault, Mode, Supervisor};
    /// # let bounds = SafetyLimits { torque: [10.0_f32], rate: [2.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// let mut supervisor = Supervisor::new(bounds, 1e-3, 0, 2);
    /// assert_eq!(supervisor.admit(Err(Fault::Stale)), Mode::Stopped);
    /// supervisor.reset();
    /// for (torque, brake) in [([2.0], true), ([4.0], false)] {
    ///     assert_eq!(supervisor.admit(Ok(&[0.5])), Mode::Full);
    ///     let command = supervisor.pass(&[4.0]);
    ///     assert_eq!((command.torque, command.brake), (torque, brake));
    /// }
    /// ```
    pub fn reset(&mut self) {
        self.known = false;
        self.seen = false;
        self.reach = R::from_f64(FAR);
        self.torque = [R::ZERO; V];
        self.faults = 0;
        self.quiet = 0;
        self.ramp = 0;
        self.mode = Mode::Full;
        self.fault = None;
        self.faulted = false;
        self.fresh = false;
        self.hold_next = false;
        self.braked = true;
        if let Some(fault) = self.unusable {
            self.stop(fault);
        }
    }
}
