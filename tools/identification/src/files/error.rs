//! Everything that can go wrong, in words that name the file, line, column or joint concerned.

use std::path::PathBuf;

use crate::IdentificationError;
use robot_import::error::ImportError;

use super::mistake::Mistake;

/// The result of anything here that reads a file.
pub type Result<T> = std::result::Result<T, Error>;

/// Why there are no parameters.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    #[error("cannot read {}: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    /// It would replace a file that is read, or another that is written.
    #[error(transparent)]
    Output(Box<ImportError>),
    /// A line of a recording.
    #[error("{}, line {line}: {problem}", path.display())]
    Line {
        path: PathBuf,
        /// From 1, the titles.
        line: usize,
        problem: Problem,
    },
    /// The recording as a whole.
    #[error("{}: {problem}", path.display())]
    Recording { path: PathBuf, problem: Problem },
    /// The description of the robot.
    #[error("{}: {source}", path.display())]
    Robot { path: PathBuf, source: Box<ImportError> },
    /// A robot whose torques are not those of single joints.
    #[error("{}: {reason}", path.display())]
    Unsuitable { path: PathBuf, reason: String },
    /// The joint was where the description does not allow it to be.
    #[error(
        "{}: joint {joint} (`{name}`) was at {position:.3}, its limits in {} are {lower:.3} and \
         {upper:.3}: {}",
        recording.display(), robot.display(), beyond(*position, [*lower, *upper])
    )]
    Outside {
        recording: PathBuf,
        robot: PathBuf,
        joint: usize,
        name: String,
        position: f64,
        lower: f64,
        upper: f64,
    },
    /// Nothing moves.
    #[error("{}: no joint moves in this recording, which shows no parameter: record `cargo xtask \
        watch --excite`", path.display())]
    AtRest { path: PathBuf },
    /// The two recordings have different ticks.
    #[error("{} has ticks of {other:.6} s, the first recording of {own:.6} s", path.display())]
    Ticks { path: PathBuf, own: f64, other: f64 },
    #[error("{}: {source}", path.display())]
    Identification { path: PathBuf, source: IdentificationError },
    /// The recording has a mistake, for which no possible robot fits it.
    #[error("{}: {mistake}. Nothing is offered to paste: correct the recording and identify again", path.display())]
    Mistake { path: PathBuf, mistake: Mistake },
    /// JSON of what was found.
    #[error("the report is no JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// How many times as far as its limits a joint is whose positions are in degrees.
const DEGREES: f64 = 4.0;

/// The likely reason for a position beyond the limits.
fn beyond(position: f64, [lower, upper]: [f64; 2]) -> &'static str {
    let (far, inside) = (DEGREES * lower.abs().max(upper.abs()), lower - 0.1..=upper + 0.1);
    match position.abs() > far && inside.contains(&position.to_radians()) {
        true => "are the positions in degrees? A map says so: position_unit = \"deg\" (--columns)",
        false => {
            "is this the column of another joint, in another unit, with another zero, or the \
             recording of another robot? Nothing is fitted to it"
        }
    }
}

/// A mistake in a recording.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    #[error("it has no titles")]
    Empty,
    #[error("the map of columns: {0}")]
    Map(String),
    #[error(
        "no layout that is known has these columns: give --columns MAP.toml, with lines such as \
         time = \"timestamp\", time_unit = \"s\", position = \"{{joint}}.pos\", position_unit = \
         \"deg\", torque = \"{{joint}}.torque\", torque_unit = \"Nm\". The robot's joints: {joints}. The \
         record's columns: {titles}"
    )]
    Unknown { titles: String, joints: String },
    #[error("{}{}", lacks(missing, titles), to_write(unstated))]
    Columns { missing: String, unstated: Vec<String>, titles: String },
    #[error(
        "it has the column `{title}`, but the robot has the joints {joints} only: --tip, --joints, \
         --without or --lock select those that were recorded"
    )]
    MoreJoints { title: String, joints: String },
    #[error("{found} columns in place of {expected}")]
    Fields { found: usize, expected: usize },
    #[error("the line has more than {0} bytes")]
    LongLine(usize),
    #[error("column `{column}`: `{text}` is not {expected}")]
    Value { column: String, text: String, expected: &'static str },
    #[error("more than {0} ticks")]
    TooLong(usize),
    #[error("{backward} of {rows} times go back: two runs are two files")]
    Backward { backward: usize, rows: usize },
    #[error(
        "its rows are {0:.3e} s apart, of which no motion of a robot is read: is `time_unit` right?"
    )]
    Rate(f64),
    #[error(
        "intervals differ from {interval:.6} s by {jitter:.0} % of it, RMS: they are no samples at a rate"
    )]
    Jitter { interval: f64, jitter: f64 },
    #[error("it has no two rows with a time, from which the length of a tick follows")]
    NoTick,
    /// Positions or torques that say nothing.
    #[error("the {channel} {how}. Nothing is fitted to this record")]
    Channel { channel: String, how: String },
    #[error("no row has `{column}` = `{is}`, in which the controller makes the torque")]
    NoRows { column: String, is: String },
    #[error("MCAP: {0}")]
    Mcap(String),
}

fn lacks(missing: &str, titles: &str) -> String {
    match missing.is_empty() {
        true => "what its columns are is not known in full".to_owned(),
        false => format!("it lacks {missing}; it has {titles}"),
    }
}

fn to_write(unstated: &[String]) -> String {
    match unstated.is_empty() {
        true => String::new(),
        false => format!(
            "; no unit is guessed: write into MAP.toml, for --columns,\n  {}",
            unstated.join("\n  ")
        ),
    }
}
