//! The faults that a supervisor detects or is notified of.

use core::fmt;

/// The reason why a measurement or a command is rejected. Joints are numbered from 0.
///
/// ```
/// use motion_control::limits::Fault;
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
    /// The previous tick was begun but not ended with a torque: the drives still apply an older
    /// one.
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
    /// The measured position differs from the last accepted one by more than the joint can have
    /// moved.
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
    /// A limit of the joint allows no motion or torque: [`crate::limits::SafetyLimits::check`]
    /// names it.
    Limits {
        /// The joint.
        joint: usize,
    },
    /// The encoder did not change while the reference moved, since it is frozen or the joint never
    /// broke away; see
    /// [`FrozenEncoder`](crate::safety::FrozenEncoder).
    Frozen {
        /// The joint.
        joint: usize,
    },
    /// The torque was at its limit for too long; see [`Saturation`](crate::safety::Saturation).
    Saturated {
        /// The joint.
        joint: usize,
    },
    /// The torque swings from one limit to the other; see
    /// [`Saturation`](crate::safety::Saturation).
    #[doc(alias = "chatter")]
    LimitCycle {
        /// The joint.
        joint: usize,
    },
    /// The reference moved further in a tick than the joint can; see
    /// [`ReferenceStep`](crate::safety::ReferenceStep).
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
    /// A tick ended after its period; see [`TickCounter`](crate::safety::TickCounter).
    Overrun,
    /// The model is invalid, for instance after a calibration.
    Model,
    /// A queue or a stack has overflowed.
    Overflow,
    /// The processor restarted without a command: a brown-out or a watchdog.
    Restarted,
    /// The brake did not accept its command.
    Brake,
    /// A stop from outside the loop: an emergency stop, a safety controller, an operator, a
    /// contact. See [`MotionController::stop`](crate::motion::MotionController::stop).
    #[doc(alias = "e-stop")]
    #[doc(alias = "emergency stop")]
    External,
    /// The encoder can have turned by half a turn since its last reading: its count does not say
    /// where the joint is. No ride-through ends it: the driver has to be told where the joint is.
    LostTurn {
        /// The joint.
        joint: usize,
    },
    /// The winding of its motor is above its greatest temperature: see
    /// [`ThermalStatus::Hot`](crate::safety::ThermalStatus::Hot), or the drive says so.
    #[doc(alias = "over-temperature")]
    Hot {
        /// The joint.
        joint: usize,
    },
}

impl Fault {
    /// The text of the fault with the joint's name in place of its number, where `names` has one:
    /// [`Model::coordinate_names`](dynamics_core::model::Model::coordinate_names), or the joints of
    /// an imported robot.
    ///
    /// ```
    /// use motion_control::limits::Fault;
    /// let fault = Fault::Speed { joint: 1 };
    /// assert_eq!(fault.to_string(), "joint 1: it exceeds its speed limit");
    /// assert_eq!(fault.named(&["shoulder", "elbow"]).to_string(), "joint `elbow`: it exceeds its speed limit");
    /// ```
    pub const fn named<'a>(&self, names: &'a [&'a str]) -> impl fmt::Display + 'a {
        FaultText { fault: *self, names }
    }
}

/// A fault with the names of the joints.
struct FaultText<'a> {
    fault: Fault,
    names: &'a [&'a str],
}

impl fmt::Display for FaultText<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (joint, text) = match self.fault {
            Fault::Stale => return write!(out, "no measurement of this tick"),
            Fault::Unfinished => return write!(out, "the tick before got no torque"),
            Fault::Missed => return write!(out, "too many ticks were missed"),
            Fault::Overrun => return write!(out, "a tick ended after its period"),
            Fault::Model => return write!(out, "the model is invalid"),
            Fault::Overflow => return write!(out, "a queue or a stack has overflowed"),
            Fault::Restarted => return write!(out, "the processor restarted"),
            Fault::Brake => return write!(out, "the brake did not respond"),
            Fault::External => return write!(out, "a stop from outside"),
            Fault::Encoder { joint } => (joint, "its encoder reports an error"),
            Fault::Hot { joint } => (joint, "its motor is too hot"),
            Fault::LostTurn { joint } => (joint, "its encoder can have lost a turn"),
            Fault::NotFinite { joint } => (joint, "its measured position is not finite"),
            Fault::Position { joint } => (joint, "its position is outside its bounds"),
            Fault::Jump { joint } => (joint, "its position jumped"),
            Fault::Speed { joint } => (joint, "it exceeds its speed limit"),
            Fault::Torque { joint } => (joint, "the torque of its law is not finite"),
            Fault::Limits { joint } => (joint, "one of its limits is invalid"),
            Fault::Frozen { joint } => (joint, "its encoder is frozen, or it never broke away"),
            Fault::Saturated { joint } => (joint, "its torque is at its limit for too long"),
            Fault::LimitCycle { joint } => (joint, "its torque swings from limit to limit"),
            Fault::Reference { joint } => (joint, "its reference jumped"),
            Fault::NotReady { joint } => (joint, "its drive is not ready"),
            Fault::Drive { joint } => (joint, "its drive rejected the torque command"),
        };
        match self.names.get(joint) {
            Some(name) => write!(out, "joint `{name}`: {text}"),
            None => write!(out, "joint {joint}: {text}"),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.named(&[]).fmt(out)
    }
}

impl core::error::Error for Fault {}
