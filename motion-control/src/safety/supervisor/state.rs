//! The states of the supervisor.
//!
//! | state | mode | leads to |
//! |---|---|---|
//! | `Full` | `Full` | `Held`, `Torqueless`, `Stopping`, `Stopped` |
//! | `Held` | `Hold` | `Full` in the first tick without a fault; `Stopping`, `Stopped` |
//! | `Torqueless` | `Hold` | `Held` in the next tick; `Stopping`, `Stopped` |
//! | `Stopping` | `Hold` | `Stopped` or `Standing` after `hold_ticks` |
//! | `Standing` | `Hold` | `Held` by a release; `Stopped` |
//! | `Stopped` | `Stopped` | `Full` by a reset |
//! | `Unusable` | `Stopped` | |
//!
//! A reset leads from every state but `Unusable` to `Full`.

use crate::limits::{Fault, Mode};

/// What the supervisor does with the arm, from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum State {
    /// The full law; faults are ridden through.
    Full,
    /// A fault outlasted the ride-through: the arm is held until a tick has none.
    Held,
    /// The torque of the law was not finite: the arm is held in the next tick, whatever is measured.
    Torqueless,
    /// A controlled stop: the arm is decelerated for `ticks` more, whatever is measured.
    Stopping {
        required: Required,
        ending: Ending,
        ticks: u32,
    },
    /// Category 2 after the deceleration: the arm is held until it is released.
    Standing(Required),
    /// Zero torque and the brake, or a damping, until a reset.
    Stopped { lowers: bool },
    /// The limits allow no motion or torque: zero torque and the brake, for ever.
    Unusable(Fault),
}

/// What follows the deceleration of a controlled stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ending {
    /// Category 1.
    Off,
    /// Category 2.
    Hold,
    /// The arm sinks against a damping.
    Lowering,
}

/// A controlled stop that was required from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Required {
    pub(super) reason: Fault,
    /// Another one was required during this one.
    pub(super) again: bool,
}

impl State {
    #[inline(always)]
    pub(super) fn mode(&self) -> Mode {
        match self {
            Self::Full => Mode::Full,
            Self::Held | Self::Torqueless | Self::Stopping { .. } | Self::Standing(_) => Mode::Hold,
            Self::Stopped { .. } | Self::Unusable(_) => Mode::Stopped,
        }
    }

    /// The controlled stop that was required from outside, and what follows its deceleration.
    pub(super) fn required(&mut self) -> Option<(&mut Required, Ending)> {
        match self {
            Self::Stopping {
                required, ending, ..
            } => Some((required, *ending)),
            Self::Standing(required) => Some((required, Ending::Hold)),
            Self::Full
            | Self::Held
            | Self::Torqueless
            | Self::Stopped { .. }
            | Self::Unusable(_) => None,
        }
    }
}
