//! The reaction to each fault.

use crate::limits::Fault;

#[cfg(test)]
mod tests;

/// The reaction of a [`MotionController`](crate::motion::MotionController) to a fault, by
/// [`Fault::reaction`].
///
/// | reaction | while the fault lasts | after it |
/// |---|---|---|
/// | [`RideThrough`](Self::RideThrough) | bridged for `ride_through_ticks`, then held for `hold_ticks`, then stopped | a bridged or held arm continues by itself, a stopped one after a reset |
/// | [`ControlledStop`](Self::ControlledStop) | stopped by the configured [`StopCategory`](crate::safety::StopCategory) | a reset |
/// | [`TorqueOff`](Self::TorqueOff) | zero torque and the brake, at once | a reset |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Reaction {
    /// [`report`](crate::motion::MotionController::report): the fault may pass.
    RideThrough,
    /// [`stop_by`](crate::motion::MotionController::stop_by) with the configured category: the
    /// motion must not go on, the drives and the measurements are usable.
    ControlledStop,
    /// [`stop`](crate::motion::MotionController::stop): a drive, a model or a memory that a
    /// deceleration needs is not usable.
    TorqueOff,
}

impl Fault {
    /// The reaction to this fault, whichever joint has it.
    ///
    /// A torque that is not finite is ridden through only in
    /// [`Mode::Full`](crate::limits::Mode::Full): in a hold it switches off.
    ///
    /// ```
    /// use motion_control::limits::{Fault, Reaction};
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
            Self::LostTurn { .. } | Self::Reference { .. } | Self::External | Self::Hot { .. } => {
                Reaction::ControlledStop
            }
            Self::Saturated { .. }
            | Self::LimitCycle { .. }
            | Self::Drive { .. }
            | Self::Limits { .. }
            | Self::Model
            | Self::Overflow
            | Self::Restarted
            | Self::Brake => Reaction::TorqueOff,
        }
    }
}
