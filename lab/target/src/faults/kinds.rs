//! The faults that are injected.

use motion_control::Fault;

use super::random::Random;

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

/// Each kind with its [`Kind::words`].
#[rustfmt::skip]
const KINDS: [(Kind, [&str; 3]); 18] = [
    (Kind::NotFinite, ["non-finite position", "supervisor", ""]),
    (Kind::Range, ["position out of range", "supervisor", ""]),
    (Kind::Encoder, ["encoder parity or error bit", "driver", ""]),
    (Kind::Frozen, ["frozen encoder", "`FrozenEncoder`", ""]),
    (Kind::Stale, ["stale or missing measurement", "loop", ""]),
    (Kind::Jump, ["jump beyond physics", "supervisor", ""]),
    (Kind::Reference, ["reference discontinuity", "`ReferenceStep`", ""]),
    (Kind::NotReady, ["drive not ready", "driver", ""]),
    (Kind::Drive, ["drive's own fault", "driver", ""]),
    (Kind::Missed, ["missed ticks, 1 to 40", "`TickCounter`, watchdog after 20", ""]),
    (Kind::Overrun, ["tick overrun", "`TickCounter`", ""]),
    (Kind::Unfinished, ["tick without a command", "supervisor", ""]),
    (Kind::Saturated, ["saturation longer than 5 ticks", "`Saturation`", ""]),
    (Kind::Torque, ["torque that is not finite", "supervisor", ""]),
    (Kind::Model, ["model invalid after a calibration", "loop", "a valid model"]),
    (Kind::Overflow, ["queue or stack overflow", "loop", "a restart"]),
    (Kind::Restarted, ["brown-out reset", "start-up", ""]),
    (Kind::External, ["external stop", "loop, by `stop_by`", "its release"]),
];

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
    pub const ALL: [Self; KINDS.len()] = {
        let (mut all, mut i) = ([KINDS[0].0; KINDS.len()], 0);
        while i < all.len() {
            all[i] = KINDS[i].0;
            i += 1;
        }
        all
    };

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
        let row = KINDS.iter().find(|(kind, _)| *kind == self);
        row.map_or([""; 3], |(_, words)| *words)
    }
}
