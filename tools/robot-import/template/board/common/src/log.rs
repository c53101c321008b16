//! Messages of the firmware over RTT, which `cargo run` shows: each change of its state with the
//! reason, what is wrong with its devices, where its joints are while it stands on its brake, and
//! why it does not start. `say.rs` has the words.

use defmt::{error, info, warn};
use defmt_rtt as _;
use joint_drivers::Telemetry;
use motion_control::motion::ResetError;

use crate::board::{N, SetupError};
use crate::say::{Line, Memory, Said, of_refusal, of_setup};

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
            let (joint, name) = (line.joint.map_or(0, |joint| joint + 1), line.name());
            match (line.joint, line.number) {
                (None, None) => warn!("{}: {}", line.seen, line.remedy),
                (None, Some(number)) => warn!("{} ({}): {}", line.seen, number, line.remedy),
                (Some(_), None) => {
                    warn!("joint {} `{}`: {}: {}", joint, name, line.seen, line.remedy)
                }
                (Some(_), Some(number)) => {
                    warn!("joint {} `{}`: {} ({}): {}", joint, name, line.seen, number, line.remedy)
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
        other => print(Said::Line(of_setup(other))),
    }
}
