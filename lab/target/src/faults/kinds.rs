//! The faults that are injected.

use motion_control::Fault;

use super::run::Random;

/// The kinds of faults that are injected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    NotFinite,
    Range,
    Encoder,
    Frozen,
    Stale,
    Jump,
    Reference,
    NotReady,
    Drive,
    Missed,
    Overrun,
    Unfinished,
    Saturated,
    Torque,
    Model,
    Overflow,
    Restarted,
    External,
}

/// A fault that begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Onset {
    pub kind: Kind,
    pub joint: u32,
    pub value: u32,
}

impl Onset {
    pub fn random(random: &mut Random) -> Self {
        Self {
            kind: Kind::ALL[random.below(Kind::ALL.len() as u32) as usize],
            joint: random.below(6),
            value: random.below(1000),
        }
    }
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 18] = [
        Self::NotFinite,
        Self::Range,
        Self::Encoder,
        Self::Frozen,
        Self::Stale,
        Self::Jump,
        Self::Reference,
        Self::NotReady,
        Self::Drive,
        Self::Missed,
        Self::Overrun,
        Self::Unfinished,
        Self::Saturated,
        Self::Torque,
        Self::Model,
        Self::Overflow,
        Self::Restarted,
        Self::External,
    ];

    /// The fault that is reported, of a joint.
    pub fn fault(self, joint: usize) -> Fault {
        match self {
            Self::NotFinite => Fault::NotFinite { joint },
            Self::Range => Fault::Position { joint },
            Self::Encoder => Fault::Encoder { joint },
            Self::Frozen => Fault::Frozen { joint },
            Self::Stale => Fault::Stale,
            Self::Jump => Fault::Jump { joint },
            Self::Reference => Fault::Reference { joint },
            Self::NotReady => Fault::NotReady { joint },
            Self::Drive => Fault::Drive { joint },
            // Up to the watchdog's time they are bridged.
            Self::Missed | Self::Restarted => Fault::Restarted,
            Self::Overrun => Fault::Overrun,
            Self::Unfinished => Fault::Unfinished,
            Self::Saturated => Fault::Saturated { joint },
            Self::Torque => Fault::Torque { joint },
            Self::Model => Fault::Model,
            Self::Overflow => Fault::Overflow,
            Self::External => Fault::External,
        }
    }

    /// Whether a reported fault is of this kind.
    pub(super) fn is(self, fault: Fault) -> bool {
        core::mem::discriminant(&self.fault(0)) == core::mem::discriminant(&fault)
    }

    /// The fault in words, what detects it, and what besides the reaction's own recovery is needed.
    pub fn words(self) -> [&'static str; 3] {
        match self {
            Self::NotFinite => ["non-finite position", "supervisor", ""],
            Self::Range => ["position out of range", "supervisor", ""],
            Self::Encoder => ["encoder parity or error bit", "driver", ""],
            Self::Frozen => ["frozen encoder", "`FrozenEncoder`", ""],
            Self::Stale => ["stale or missing measurement", "loop", ""],
            Self::Jump => ["jump beyond physics", "supervisor", ""],
            Self::Reference => ["reference discontinuity", "`ReferenceStep`", ""],
            Self::NotReady => ["drive not ready", "driver", ""],
            Self::Drive => ["drive's own fault", "driver", ""],
            Self::Missed => [
                "missed ticks, 1 to 40",
                "`TickCounter`, watchdog after 20",
                "",
            ],
            Self::Overrun => ["tick overrun", "`TickCounter`", ""],
            Self::Unfinished => ["tick without a command", "supervisor", ""],
            Self::Saturated => ["saturation longer than 5 ticks", "`Saturation`", ""],
            Self::Torque => ["torque that is not finite", "supervisor", ""],
            Self::Model => ["model invalid after a calibration", "loop", "a valid model"],
            Self::Overflow => ["queue or stack overflow", "loop", "a restart"],
            Self::Restarted => ["brown-out reset", "start-up", ""],
            Self::External => ["external stop", "loop, by `stop_by`", "its release"],
        }
    }
}
