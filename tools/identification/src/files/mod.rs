//! The parameters of a robot's file from a recording of its ticks: what `cargo xtask identify`
//! runs.
//!
//! | module | what |
//! |---|---|
//! | [`recorded`] | the ticks of a CSV, an MCAP or arrays |
//! | [`map`] | which columns these are, and in which units |
//! | [`look`] | single bad samples, jumps by a turn, encoders that stand still |
//! | [`resample`] | rows at uneven times |
//! | [`robot`] | the robot of a URDF or MJCF, and its parameters |
//! | [`run`] | the fit, its comparison with held-out ticks, and the physical set |
//! | [`kinds`] | the kinds of friction that the model lacks and the recording carries |
//! | [`mistakes`] | a mistake that explains what no robot does |
//! | [`report`] | what was found, as text and as JSON |
//! | [`picture`] | the torques by time |
//! | [`paste`] | the robot's Rust file and its initialisers in C with what was found |

mod attempt;
mod delay;
pub mod error;
pub mod kinds;
pub mod look;
#[cfg(feature = "files")]
pub mod map;
#[cfg(feature = "files")]
mod messages;
mod mistake;
pub mod mistakes;
#[cfg(feature = "files")]
pub mod paste;
#[cfg(feature = "files")]
pub mod picture;
#[cfg(feature = "files")]
mod reading;
pub mod recorded;
pub mod report;
pub mod resample;
pub mod robot;
pub mod run;
#[cfg(feature = "files")]
mod table;
mod zeros;

/// The most joints that a robot may have: its size is known to the compiler, which takes seconds for
/// each. Without files, as in a wheel, they are those of an arm with a gripper.
pub const MOST_JOINTS: usize = if cfg!(feature = "files") { 12 } else { 8 };

/// A share in per cent; of nothing, none.
fn percent(part: f64, of: f64) -> String {
    match 100.0 * part / of {
        share if share < 1000.0 => format!("{share:.1} %"),
        share if share.is_nan() => "–".to_owned(),
        _ => "> 999 %".to_owned(),
    }
}
