//! The reaction to each fault.

use super::{Fault, MeasurementAge, MotionController, Supervisor};
use crate::scalar::Real;

/// The reaction of a [`Supervisor`] to a fault, by [`Fault::reaction`].
///
/// | reaction | while the fault lasts | after it |
/// |---|---|---|
/// | [`RideThrough`](Self::RideThrough) | bridged for `ride_through_ticks`, then held for `hold_ticks`, then stopped | a bridged or held arm continues by itself, a stopped one after a reset |
/// | [`ControlledStop`](Self::ControlledStop) | stopped by the configured [`StopCategory`](super::StopCategory) | a reset |
/// | [`TorqueOff`](Self::TorqueOff) | zero torque and the brake, at once | a reset |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Reaction {
    /// [`Supervisor::report`]: the fault may pass.
    RideThrough,
    /// [`Supervisor::stop_by`] with the configured category: the motion must not go on, the drives and the measurements
    /// are usable.
    ControlledStop,
    /// [`Supervisor::stop`]: a drive, a model or a memory that a deceleration needs is not usable.
    TorqueOff,
}

impl Fault {
    /// The reaction to this fault, whichever joint has it.
    ///
    /// A torque that is not finite is ridden through only in [`Mode::Full`](super::Mode::Full): in a hold it switches off.
    ///
    /// ```
    /// use dynamics_core::control::{Fault, Reaction};
    /// assert_eq!(Fault::Stale.reaction(), Reaction::RideThrough);
    /// assert_eq!(Fault::External.reaction(), Reaction::ControlledStop);
    /// assert_eq!(Fault::Drive { joint: 3 }.reaction(), Reaction::TorqueOff);
    /// ```
    pub const fn reaction(&self) -> Reaction {
        match self {
            Self::Encoder { .. }
            | Self::Stale
            | Self::Unfinished
            | Self::NotFinite { .. }
            | Self::Position { .. }
            | Self::Jump { .. }
            | Self::Speed { .. }
            | Self::Torque { .. }
            | Self::Frozen { .. }
            | Self::NotReady { .. }
            | Self::Missed
            | Self::Overrun => Reaction::RideThrough,
            Self::Reference { .. } | Self::External => Reaction::ControlledStop,
            Self::Saturated { .. }
            | Self::Drive { .. }
            | Self::Limits { .. }
            | Self::Model
            | Self::Overflow
            | Self::Restarted
            | Self::Brake => Reaction::TorqueOff,
        }
    }
}

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// Reacts to a fault that the supervisor cannot detect, by its [`Fault::reaction`]. Between two ticks the reaction
    /// begins in the next one. While the fault lasts, call this function in every tick.
    ///
    /// ```
    /// # use dynamics_core::control::{Fault, Mode, SafetyLimits, Supervisor, SupervisorConfig};
    /// # let limits = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-1.0], upper: [1.0] };
    /// # let config = SupervisorConfig {
    /// #     limits, tick: 1e-3, resolution: 0.0, ride_through_ticks: 1, hold_ticks: 2, reentry_ticks: 4,
    /// # };
    /// let overrun = [Mode::Full, Mode::Hold, Mode::Hold];
    /// let external = [Mode::Hold, Mode::Hold, Mode::Stopped];
    /// let drive = [Mode::Stopped; 3];
    /// let faults = [Fault::Overrun, Fault::External, Fault::Drive { joint: 0 }];
    /// for (fault, modes) in faults.into_iter().zip([overrun, external, drive]) {
    ///     let mut supervisor = Supervisor::try_new(config)?;
    ///     supervisor.tick(Ok(&[0.5]), |_| [7.0]);
    ///     for mode in modes {
    ///         supervisor.react(fault);
    ///         let status = supervisor.tick(Ok(&[0.5]), |_| [7.0]).status;
    ///         assert_eq!((status.mode, status.fault), (mode, Some(fault)));
    ///     }
    /// }
    /// # Ok::<(), dynamics_core::control::ConfigError>(())
    /// ```
    #[cold]
    pub fn react(&mut self, fault: Fault) {
        match fault.reaction() {
            Reaction::RideThrough => self.report(fault),
            Reaction::ControlledStop => self.stop_as_configured(fault),
            Reaction::TorqueOff => self.stop(fault),
        }
    }
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Reacts to a fault that the controller cannot detect, by its [`Fault::reaction`]; see [`Supervisor::react`].
    #[cold]
    pub fn react(&mut self, fault: Fault) {
        self.supervisor.react(fault);
    }
}
