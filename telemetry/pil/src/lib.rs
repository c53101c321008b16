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

pub const JOINTS: usize = 6;

#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    #[error(transparent)]
    Line(#[from] telemetry_watch::error::Error),
    #[error("no reply from {name} to tick {number} after {tries} tries")]
    Silent {
        name: String,
        number: u32,
        /// How often it was sent.
        tries: u32,
    },
    /// The processor has another number of joints.
    #[error("the reply to tick {number} has {found} joints, not {JOINTS}")]
    Joints { number: u32, found: usize },
    /// The robot has no forward dynamics any more.
    #[error("in tick {number} the simulated robot has no forward dynamics")]
    Broken { number: u32 },
    /// The recorded motion lacks a tick.
    #[error("the record of the plant inside has {found} ticks in a row, not {ticks}")]
    Record { found: usize, ticks: usize },
    #[error("the trajectory needs more than the arm's limits")]
    Trajectory,
    /// The motions differ by more than stated.
    #[error("{0}")]
    Differs(String),
}
