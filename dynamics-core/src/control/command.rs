//! The commands of a supervisor, and its status.

use super::Fault;

/// What the arm does, in the order in which a lasting fault leads from one to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mode {
    /// The full control law; while a fault is ridden through, on what the observer expects.
    Full,
    /// Brought to rest where the observer has the arm: inverse dynamics of q̈ = −λ q̇, see [`super::hold()`].
    Hold,
    /// Zero torque and the brake, until a reset ([`super::MotionController::reset`], [`super::Supervisor::reset`]).
    Stopped,
}

/// What the supervisor did in a tick, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Status {
    /// What the arm did.
    pub mode: Mode,
    /// The first fault of this tick; in [`Mode::Stopped`] the one that stopped the arm.
    pub fault: Option<Fault>,
    /// A limit on torque or rate took effect.
    pub limited: bool,
}

/// What goes to the drives.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Command<R, const V: usize> {
    /// Torques, N·m or N: finite and within their limits.
    pub torque: [R; V],
    /// Whether the brake is to hold the arm.
    pub brake: bool,
    /// Why so.
    pub status: Status,
}
