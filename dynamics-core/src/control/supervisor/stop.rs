//! Stops: their categories, and what follows a controlled one.

use super::{Command, Fault, Mode, Supervisor};
use crate::scalar::Real;

/// How an arm is stopped: the stop categories of IEC 60204-1 (2016), 9.2.2, and the lowering of an arm without brakes.
///
/// A fault that outlasts the ride-through and a [`Supervisor::stop_by`] choose among them; [`Supervisor::stop`] is at
/// once, for faults that leave no torque to decelerate with, such as a failed drive.
///
/// | category | first | then | power |
/// |---|---|---|---|
/// | 0, [`Self::TorqueOff`] | | zero torque and the brake | off at once |
/// | 1, [`Self::ControlledOff`] | [`Mode::Hold`] for `hold_ticks` | zero torque and the brake | off at rest |
/// | 2, [`Self::ControlledHold`] | [`Mode::Hold`] for `hold_ticks` | held in [`Mode::Hold`] until a reset | stays on |
/// | none, [`Self::DampedLowering`] | [`Mode::Hold`] for `hold_ticks` | τ = −d q̇, no brake needed | on while the arm sinks |
///
/// Category 2 needs measurements: if they fail for longer than `hold_ticks`, it ends as category 1. The controlled part
/// is not safety-rated: keep a safe torque off in hardware.
///
/// ```
/// use dynamics_core::control::{Fault, Mode, SafetyLimits, StopCategory, Supervisor, SupervisorConfig};
/// let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
/// let mut supervisor = Supervisor::try_new(SupervisorConfig {
///     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 5, hold_ticks: 2, reentry_ticks: 4,
/// })?;
/// supervisor.tick(Ok(&[0.5]), |_| [7.0]);
/// supervisor.stop_by(Fault::External, StopCategory::ControlledOff);
/// for mode in [Mode::Hold, Mode::Hold, Mode::Stopped, Mode::Stopped] {
///     let command = supervisor.tick(Ok(&[0.5]), |_| [7.0]);
///     assert_eq!((command.status.mode, command.status.fault), (mode, Some(Fault::External)));
///     assert_eq!(command.brake, mode == Mode::Stopped);
/// }
/// # Ok::<(), dynamics_core::control::ConfigError>(())
/// ```
#[doc(alias = "IEC 60204-1")]
#[doc(alias = "stop category")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum StopCategory<R, const V: usize> {
    /// Category 0: zero torque and the brake at once.
    TorqueOff,
    /// Category 1, the default: the arm is decelerated, then zero torque and the brake.
    ControlledOff,
    /// Category 2: the arm is decelerated, then held with torque until a reset.
    ControlledHold,
    /// For an arm without brakes: the arm is decelerated, then sinks against a damping.
    DampedLowering {
        /// d of each joint, N·m·s/rad or N·s/m. The arm sinks at the torque of gravity divided by d.
        damping: [R; V],
    },
}

/// A category without its data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Off,
    ControlledOff,
    ControlledHold,
    Lowering,
}

/// The configured category, and the stop that was required from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stopping<R, const V: usize> {
    configured: Kind,
    active: Kind,
    damping: [R; V],
    /// The reason of a controlled stop.
    reason: Option<Fault>,
    /// Ticks of the controlled part that are left.
    ticks: u32,
    /// Another stop was required during this one.
    again: bool,
}

impl<R: Real, const V: usize> Stopping<R, V> {
    pub(super) fn new() -> Self {
        Self {
            configured: Kind::ControlledOff,
            active: Kind::ControlledOff,
            damping: [R::ZERO; V],
            reason: None,
            ticks: 0,
            again: false,
        }
    }

    fn choose(&mut self, category: &StopCategory<R, V>) -> Kind {
        match *category {
            StopCategory::TorqueOff => Kind::Off,
            StopCategory::ControlledOff => Kind::ControlledOff,
            StopCategory::ControlledHold => Kind::ControlledHold,
            StopCategory::DampedLowering { damping } => {
                // A damping that is not a positive number would drive the joint.
                self.damping = damping.map(|d| if d > R::ZERO { d } else { R::ZERO });
                Kind::Lowering
            }
        }
    }
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// The same supervisor with another stop category for lasting faults; without this call it is
    /// [`StopCategory::ControlledOff`].
    ///
    /// ```
    /// # use dynamics_core::control::{Fault, Mode, SafetyLimits, StopCategory, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let config = SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 0, hold_ticks: 2, reentry_ticks: 4,
    /// # };
    /// let mut supervisor = Supervisor::try_new(config)?.with_stop(StopCategory::TorqueOff);
    /// supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    /// assert_eq!(supervisor.tick(Err(Fault::Stale), |_| [7.0]).status.mode, Mode::Stopped);
    /// # Ok::<(), dynamics_core::control::ConfigError>(())
    /// ```
    #[must_use]
    pub fn with_stop(mut self, category: StopCategory<R, V>) -> Self {
        let kind = self.stopping.choose(&category);
        (self.stopping.configured, self.stopping.active) = (kind, kind);
        self
    }

    /// Stops the arm from the next tick on, for an external reason such as a failed drive or an emergency stop;
    /// [`SupervisorTick::stop`](super::SupervisorTick::stop) stops it in the present tick, [`Self::stop_by`] by another stop category than 0.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. While a stop is still required after a reset,
    /// call this function in every tick.
    ///
    /// ```
    /// # use dynamics_core::control::{Fault, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let mut supervisor = Supervisor::try_new(SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 5, hold_ticks: 2, reentry_ticks: 4,
    /// # })?;
    /// supervisor.stop(Fault::External);
    /// let command = supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    /// assert_eq!((command.torque, command.brake), ([0.0], true));
    /// assert_eq!(command.status.fault, Some(Fault::External));
    /// # Ok::<(), dynamics_core::control::ConfigError>(())
    /// ```
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    #[cold]
    pub fn stop(&mut self, fault: Fault) {
        if !matches!(self.mode, Mode::Stopped) {
            self.mode = Mode::Stopped;
            self.fault = Some(fault);
            self.ramp = 0;
            self.clear_stop();
        }
    }

    /// Stops the arm by a category, for a reason that leaves the drives usable: an operator, a safety controller, a
    /// lost connection. Between two ticks, the stop begins in the next one; within a tick it begins in this one.
    ///
    /// The stop is latched until [`Self::reset`], with its first reason. A later call with
    /// [`StopCategory::TorqueOff`] ends a controlled stop at once.
    #[cold]
    pub fn stop_by(&mut self, fault: Fault, category: StopCategory<R, V>) {
        if matches!(self.mode, Mode::Stopped) {
            return;
        }
        let kind = self.stopping.choose(&category);
        self.stop_kind(fault, kind);
    }

    /// Stops the arm by the configured category.
    pub(in crate::control) fn stop_as_configured(&mut self, fault: Fault) {
        if !matches!(self.mode, Mode::Stopped) {
            self.stop_kind(fault, self.stopping.configured);
        }
    }

    fn stop_kind(&mut self, fault: Fault, kind: Kind) {
        // An arm whose position is not known cannot be decelerated.
        if matches!(kind, Kind::Off) | !self.known {
            let reason = self.stopping.reason.unwrap_or(fault);
            self.stop(reason);
            self.stopping.active = kind;
        } else if self.stopping.reason.is_none() {
            self.stopping.active = kind;
            self.stopping.reason = Some(fault);
            self.stopping.ticks = self.hold_ticks;
            self.hold_next = true;
            // Within a tick, the law holds the arm already in this one.
            if self.open {
                self.mode = Mode::Hold;
                self.fault = Some(fault);
                self.ramp = 0;
            }
        } else {
            self.stopping.again = true;
        }
    }

    /// The ticks after the ride-through for which a lasting fault holds the arm.
    pub(super) fn held_ticks(&self) -> u32 {
        match self.stopping.configured {
            Kind::Off => 0,
            _ => self.hold_ticks,
        }
    }

    /// A tick that begins in a hold: after a torque that was not finite, or in a controlled stop.
    #[cold]
    pub(super) fn begin_held(&mut self) {
        let controlled = self.stopping.reason;
        let stopped = matches!(self.mode, Mode::Stopped);
        self.hold_next = controlled.is_some() & !stopped;
        if stopped | (controlled.is_none() & self.faulted) {
            return;
        }
        self.mode = Mode::Hold;
        if controlled.is_none() {
            return;
        }
        self.fault = controlled;
        self.forget_faults();
        let on = matches!(self.stopping.active, Kind::ControlledHold);
        if self.stopping.ticks > 0 {
            self.stopping.ticks -= 1;
        } else if !on {
            self.mode = Mode::Stopped;
            self.hold_next = false;
        }
    }

    /// While the arm is held with power, faults are forgotten as in the full law. The ramp, which is not used in a
    /// hold, counts the good ticks.
    fn forget_faults(&mut self) {
        self.ramp = if self.accepted & !self.faulted {
            self.ramp.saturating_add(1)
        } else {
            0
        };
        if self.ramp >= self.reentry_ticks {
            self.faults = 0;
            self.ramp = 0;
        }
    }

    /// Whether the arm is held by a stop of category 2 whose controlled part is over.
    pub(in crate::control) fn stands(&self) -> bool {
        let on = matches!(self.stopping.active, Kind::ControlledHold);
        on & self.stopping.reason.is_some()
            & (self.stopping.ticks == 0)
            & matches!(self.mode, Mode::Hold)
    }

    /// Whether more than one controlled stop has been required since the last reset: one of them may be an operator's.
    pub(in crate::control) fn stopped_again(&self) -> bool {
        self.stopping.again
    }

    /// Whether every joint is slower than a hundredth of its limit, or as slow as 1 mrad/s.
    pub(in crate::control) fn at_rest(&self, qd: &[R; V]) -> bool {
        let slow =
            |(qd, limit): (&R, &R)| qd.abs() <= R::from_f64(1e-2) * *limit + R::from_f64(1e-3);
        qd.iter().zip(&self.speed_limit).all(slow)
    }

    /// Ends a stop of category 2: the full law returns over `reentry_ticks`, without the brake.
    pub(in crate::control) fn release(&mut self) {
        self.ramp = 0;
        self.hold_next = false;
        self.clear_stop();
    }

    pub(super) fn clear_stop(&mut self) {
        self.stopping.reason = None;
        self.stopping.again = false;
        self.stopping.active = self.stopping.configured;
    }

    /// Whether the arm sinks while it is stopped. What ends a stop of category 2 early is what the arm is configured for.
    fn sinks(&self) -> bool {
        match self.stopping.active {
            Kind::Lowering => true,
            Kind::ControlledHold => matches!(self.stopping.configured, Kind::Lowering),
            Kind::Off | Kind::ControlledOff => false,
        }
    }

    /// Whether a stopped arm sinks, and a motion from one position to another in a tick is plausible for it.
    pub(in crate::control) fn lowers(&self, from: &[R; V], to: &[R; V]) -> bool {
        let mut steps = from.iter().zip(to).zip(&self.plausible_step);
        self.sinks() && steps.all(|((&from, &to), &step)| (to - from).abs() <= step)
    }

    /// The command of a stopped arm.
    #[cold]
    #[inline(never)]
    pub(super) fn stopped_command(&mut self, qd: &[R; V]) -> Command<R, V> {
        let torque = self.stopped_torque(qd);
        self.torque = torque;
        self.end(torque, false)
    }

    /// Zero, or the damping of a sinking arm within the limits of torque and rate.
    fn stopped_torque(&self, qd: &[R; V]) -> [R; V] {
        let mut torque = [R::ZERO; V];
        if !self.sinks() | self.unusable.is_some() {
            return torque;
        }
        let limits = self.torque_limit.iter().zip(&self.rate_limit);
        let damped = self.stopping.damping.iter().zip(qd).zip(&self.torque);
        for ((out, ((&d, &qd), &last)), (&most, &rate)) in torque.iter_mut().zip(damped).zip(limits)
        {
            let wanted = -(d * qd);
            if wanted.is_finite() {
                *out = wanted
                    .clamped(-most, most)
                    .clamped(last - rate, last + rate);
            }
        }
        torque
    }
}
