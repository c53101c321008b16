//! The faults that a supervisor detects or is notified of.

use core::fmt;

/// The reason why a measurement or a command is rejected. Joints are numbered from 0.
///
/// ```
/// use motion_control::Fault;
/// assert_eq!(format!("{}", Fault::Jump { joint: 2 }), "joint 2: its position jumped");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Fault {
    /// The encoder reported an error, or its frame was corrupted.
    Encoder {
        /// The joint.
        joint: usize,
    },
    /// There is no measurement in this tick.
    Stale,
    /// The previous tick was begun but not ended with a torque: the drives still apply an older one.
    Unfinished,
    /// The measured position is not finite.
    NotFinite {
        /// The joint.
        joint: usize,
    },
    /// The measured position is outside its bounds.
    Position {
        /// The joint.
        joint: usize,
    },
    /// The measured position differs from the last accepted one by more than the joint can have moved.
    Jump {
        /// The joint.
        joint: usize,
    },
    /// The speed of the joint is above its limit.
    Speed {
        /// The joint.
        joint: usize,
    },
    /// The torque of the law is not finite.
    Torque {
        /// The joint.
        joint: usize,
    },
    /// The drive did not accept its torque.
    Drive {
        /// The joint.
        joint: usize,
    },
    /// A limit of the joint allows no motion or torque: [`crate::SafetyLimits::check`] names it.
    Limits {
        /// The joint.
        joint: usize,
    },
    /// The encoder did not change while the reference moved; see [`FrozenEncoder`](crate::FrozenEncoder).
    Frozen {
        /// The joint.
        joint: usize,
    },
    /// The torque was at its limit for too long; see [`Saturation`](crate::Saturation).
    Saturated {
        /// The joint.
        joint: usize,
    },
    /// The reference moved further in a tick than the joint can; see [`ReferenceStep`](crate::ReferenceStep).
    Reference {
        /// The joint.
        joint: usize,
    },
    /// The drive is not ready for torques: not enabled, not commutated, or its supply is low.
    NotReady {
        /// The joint.
        joint: usize,
    },
    /// More ticks were missed than a fault may last.
    Missed,
    /// A tick ended after its period; see [`TickCounter`](crate::TickCounter).
    Overrun,
    /// The model is invalid, for instance after a calibration.
    Model,
    /// A queue or a stack has overflowed.
    Overflow,
    /// The processor restarted without a command: a brown-out or a watchdog.
    Restarted,
    /// The brake did not accept its command.
    Brake,
    /// A stop from outside the loop: an emergency stop, a safety controller, an operator, a contact. See
    /// [`MotionController::stop`](crate::MotionController::stop).
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    External,
    /// The encoder can have turned by half a turn since its last reading: its count does not say where the joint is. No
    /// ride-through ends it: the driver has to be told where the joint is.
    LostTurn {
        /// The joint.
        joint: usize,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (joint, text) = match *self {
            Self::Stale => return write!(out, "no measurement of this tick"),
            Self::Unfinished => return write!(out, "the tick before got no torque"),
            Self::Missed => return write!(out, "too many ticks were missed"),
            Self::Overrun => return write!(out, "a tick ended after its period"),
            Self::Model => return write!(out, "the model is invalid"),
            Self::Overflow => return write!(out, "a queue or a stack has overflowed"),
            Self::Restarted => return write!(out, "the processor restarted"),
            Self::Brake => return write!(out, "the brake did not respond"),
            Self::External => return write!(out, "a stop from outside"),
            Self::Encoder { joint } => (joint, "its encoder reports an error"),
            Self::LostTurn { joint } => (joint, "its encoder can have lost a turn"),
            Self::NotFinite { joint } => (joint, "its measured position is not finite"),
            Self::Position { joint } => (joint, "its position is outside its bounds"),
            Self::Jump { joint } => (joint, "its position jumped"),
            Self::Speed { joint } => (joint, "it exceeds its speed limit"),
            Self::Torque { joint } => (joint, "the torque of its law is not finite"),
            Self::Limits { joint } => (joint, "one of its limits is invalid"),
            Self::Frozen { joint } => (joint, "its encoder is frozen"),
            Self::Saturated { joint } => (joint, "its torque is at its limit for too long"),
            Self::Reference { joint } => (joint, "its reference jumped"),
            Self::NotReady { joint } => (joint, "its drive is not ready"),
            Self::Drive { joint } => (joint, "its drive rejected the torque command"),
        };
        write!(out, "joint {joint}: {text}")
    }
}

impl core::error::Error for Fault {}
