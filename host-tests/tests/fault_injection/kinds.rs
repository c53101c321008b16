//! The faults that are injected, and what the contract says of each.

use dynamics_core::control::Fault;

use super::run::Random;

/// The kinds of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
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
pub struct Onset {
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

    /// Whether a reported fault is of this kind.
    pub fn is(self, fault: Fault) -> bool {
        match self {
            Self::NotFinite => matches!(fault, Fault::NotFinite { .. }),
            Self::Range => matches!(fault, Fault::Position { .. }),
            Self::Encoder => matches!(fault, Fault::Encoder { .. }),
            Self::Frozen => matches!(fault, Fault::Frozen { .. }),
            Self::Stale => fault == Fault::Stale,
            Self::Jump => matches!(fault, Fault::Jump { .. }),
            Self::Reference => matches!(fault, Fault::Reference { .. }),
            Self::NotReady => matches!(fault, Fault::NotReady { .. }),
            Self::Drive => matches!(fault, Fault::Drive { .. }),
            // Up to the watchdog's time they are bridged.
            Self::Missed => fault == Fault::Restarted,
            Self::Overrun => fault == Fault::Overrun,
            Self::Unfinished => fault == Fault::Unfinished,
            Self::Saturated => matches!(fault, Fault::Saturated { .. }),
            Self::Torque => matches!(fault, Fault::Torque { .. }),
            Self::Model => fault == Fault::Model,
            Self::Overflow => fault == Fault::Overflow,
            Self::Restarted => fault == Fault::Restarted,
            Self::External => fault == Fault::External,
        }
    }

    /// The fault, what detects it, and its report.
    pub fn words(self) -> [&'static str; 3] {
        match self {
            Self::NotFinite => ["non-finite position", "supervisor", "`NotFinite`"],
            Self::Range => ["position out of range", "supervisor", "`Position`"],
            Self::Encoder => ["encoder parity or error bit", "driver", "`Encoder`"],
            Self::Frozen => ["frozen encoder", "`FrozenEncoder`", "`Frozen`"],
            Self::Stale => ["stale or missing measurement", "loop", "`Stale`"],
            Self::Jump => ["jump beyond physics", "supervisor", "`Jump`"],
            Self::Reference => ["reference discontinuity", "`ReferenceStep`", "`Reference`"],
            Self::NotReady => ["drive not ready", "loop, by `report`", "`NotReady`"],
            Self::Drive => ["drive's own fault", "driver, by `stop`", "`Drive`"],
            Self::Missed => [
                "missed ticks",
                "`TickCounter`",
                "`Restarted`, by the watchdog after 20",
            ],
            Self::Overrun => ["tick overrun", "`TickCounter`", "`Overrun`"],
            Self::Unfinished => ["tick without a command", "supervisor", "`Unfinished`"],
            Self::Saturated => [
                "saturation longer than 5 ticks",
                "`Saturation`, by `stop`",
                "`Saturated`",
            ],
            Self::Torque => ["torque that is not finite", "supervisor", "`Torque`"],
            Self::Model => [
                "model invalid after a calibration",
                "loop, by `stop`",
                "`Model`",
            ],
            Self::Overflow => ["queue or stack overflow", "loop, by `stop`", "`Overflow`"],
            Self::Restarted => ["brown-out reset", "start-up, by `stop`", "`Restarted`"],
            Self::External => ["external stop", "loop, by `stop_by`", "`External`"],
        }
    }
}
