//! Processor in the loop: the controller of the scene `ur5e` on a microcontroller, its robot in f64 on the host.
//!
//! In each control period the host sends what the encoders answer, the processor runs its tick, and the host moves the
//! robot on under the duties of the reply. The motion is compared with that of the firmware whose robot is inside, in
//! f32.
//!
//! | module | what |
//! |---|---|
//! | [`plant`] | the robot, in f64 or as the firmware has it |
//! | [`machine`] | the controller, behind a serial line or in this process |
//! | [`motion`] | what a run of both gives |
//! | [`comparison`] | two motions side by side, and the bounds of their difference |

pub mod comparison;
pub mod machine;
pub mod motion;
pub mod plant;

/// The joints of the scene.
pub const JOINTS: usize = 6;

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The line to the processor.
    #[error(transparent)]
    Line(#[from] telemetry_watch::error::Error),
    /// The processor does not reply.
    #[error("no reply from {name} to tick {number} after {tries} tries")]
    Silent {
        /// The port or program.
        name: String,
        /// The number of the tick.
        number: u32,
        /// How often it was sent.
        tries: u32,
    },
    /// The processor has another number of joints.
    #[error("the reply to tick {number} has {found} joints, not {JOINTS}")]
    Joints {
        /// The number of the tick.
        number: u32,
        /// What it has.
        found: usize,
    },
    /// The robot has no forward dynamics any more.
    #[error("in tick {number} the simulated robot has no forward dynamics")]
    Broken {
        /// The number of the tick.
        number: u32,
    },
    /// The recorded motion lacks a tick.
    #[error("the record of the plant inside has {found} ticks in a row, not {ticks}")]
    Record {
        /// What it has.
        found: usize,
        /// What is needed.
        ticks: usize,
    },
    /// The trajectory of the scene.
    #[error("the trajectory needs more than the arm's limits")]
    Trajectory,
    /// The motions differ by more than stated.
    #[error("{0}")]
    Differs(String),
}
