//! The commands of a supervisor, and its status.

use crate::limits::Fault;

/// The mode of the arm. A lasting fault leads from each to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// The full control law. During a ride-through it acts on the prediction of the observer.
    Full,
    /// The arm is brought to rest at its estimated position: inverse dynamics of q̈ = −λ q̇, see
    /// [`crate::motion::hold()`].
    Hold,
    /// Zero torque and the brake, until a reset
    /// ([`MotionController::reset`](crate::motion::MotionController::reset)).
    Stopped,
}

/// The decision of the supervisor in a tick, and its reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Status {
    /// The mode of the arm.
    pub mode: Mode,
    /// The first fault of this tick; in [`Mode::Stopped`] the one that stopped the arm.
    pub fault: Option<Fault>,
    /// A limit on torque or rate took effect.
    pub limited: bool,
}

/// The command to the drives.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Command<R, const V: usize> {
    /// Torques, N·m or N: finite and within their limits.
    pub torque: [R; V],
    /// Whether the brake must hold the arm.
    pub brake: bool,
    /// The mode, and the fault that led to it.
    pub status: Status,
}
