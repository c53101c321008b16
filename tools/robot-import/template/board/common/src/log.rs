//! Messages of the firmware over RTT, which `cargo run` shows: each change of its state with the
//! reason, what is wrong with its devices, where its joints are while it stands on its brake, and
//! why it does not start. `say.rs` has the words.

use defmt::{error, info, warn};
use defmt_rtt as _;
use joint_drivers::{JointError, Telemetry};
use motion_control::motion::ResetError;

use crate::board::{N, SetupError};
use crate::say::{Line, Memory, Said, of_refusal};

/// What was said.
pub struct Log(Memory);

impl Log {
    pub const fn new() -> Self {
        Self(Memory::new())
    }

    /// Logs the changes since the tick before.
    pub fn tick(&mut self, telemetry: &Telemetry<N>) {
        self.0.tick(telemetry, print);
    }

    /// Logs a line.
    pub fn say(&mut self, line: Line) {
        self.0.say(line, print);
    }

    /// After a start that the controller refused.
    pub fn refused(&mut self, reason: ResetError) {
        self.say(of_refusal(reason));
    }
}

/// Prints a message.
#[inline(never)]
pub fn print(said: Said<'_>) {
    match said {
        Said::Mode(mode, Some(fault)) => warn!("{}: {}, joints from 0", mode, fault),
        Said::Mode(mode, None) => info!("{}", mode),
        Said::Positions(q) => info!("on the brake at {}, rad or m", q),
        Said::Line(line) => {
            let Line { joint, text, number } = line;
            match (joint, number) {
                (None, None) => warn!("{}", text),
                (None, Some(number)) => warn!("{} ({})", text, number),
                (Some(at), None) => warn!("joint {} `{}`: {}", at + 1, line.name(), text),
                (Some(at), Some(number)) => {
                    warn!("joint {} `{}`: {} ({})", at + 1, line.name(), text, number)
                }
            }
        }
    }
}

/// The arm stays on its brake for good.
#[inline(never)]
pub fn impossible(reason: &SetupError) {
    match reason {
        SetupError::Motion(error) => error!("impossible: the motion in scene.rs: {}", error),
        SetupError::Limits(error) => error!("impossible: the limits in scene.rs: {}", error),
        SetupError::Drive(_) => error!("impossible: the full scale of a drive in board.rs"),
        SetupError::Encoder(JointError { joint, .. })
        | SetupError::Can(JointError { joint, .. }) => {
            error!("impossible: the encoder or the drive of joint {} in board.rs", joint + 1);
        }
        _ => error!("impossible: a setup error of control.rs"),
    }
}
