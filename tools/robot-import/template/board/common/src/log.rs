//! Messages of the firmware over RTT, which `cargo run` shows: each change of its state with the
//! reason, where its joints are while it stands on its brake, and why it does not start.

use defmt::{error, info, warn};
use defmt_rtt as _;
use joint_drivers::Telemetry;
use motion_control::limits::{Fault, Mode};
use motion_control::motion::ResetError;

use crate::board::{N, SetupError};

/// Ticks on the brake from one list of positions to the next.
const POSITIONS: u32 = 500;

/// The last message of the log.
pub struct Log {
    mode: Option<Mode>,
    fault: Option<Fault>,
    refused: Option<ResetError>,
    ticks: u32,
}

impl Log {
    pub const fn new() -> Self {
        Self { mode: None, fault: None, refused: None, ticks: 0 }
    }

    /// Logs the changes since the tick before.
    pub fn tick(&mut self, telemetry: &Telemetry<N>) {
        let (mode, fault) = (telemetry.status.mode, telemetry.status.fault);
        if self.mode != Some(mode) || self.fault != fault {
            (self.mode, self.fault, self.refused) = (Some(mode), fault, None);
            match fault {
                Some(fault) => warn!("{}: {}, joints from 0", mode, fault),
                None => info!("{}", mode),
            }
        }
        self.ticks = match mode {
            Mode::Stopped => (self.ticks + 1) % POSITIONS,
            _ => 0,
        };
        if self.ticks == 1 {
            info!("on the brake at {}, rad or m", telemetry.estimate);
        }
    }

    /// After a start that the controller refused.
    pub fn refused(&mut self, reason: ResetError) {
        if self.refused != Some(reason) {
            self.refused = Some(reason);
            warn!("no start: {}, joints from 0", reason);
        }
    }
}

/// The arm stays on its brake for good.
#[inline(never)]
pub fn impossible(reason: &SetupError) {
    match reason {
        SetupError::Motion(error) => error!("impossible: the motion in scene.rs: {}", error),
        SetupError::Limits(error) => error!("impossible: the limits in scene.rs: {}", error),
        SetupError::Encoder(_) => error!("impossible: how the encoders in board.rs are mounted"),
        SetupError::Drive(_) => error!("impossible: the full scale of a drive in board.rs"),
        SetupError::Can(_) => error!("impossible: the number or the scale of a drive in board.rs"),
        _ => error!("impossible: a setup error of control.rs"),
    }
}
