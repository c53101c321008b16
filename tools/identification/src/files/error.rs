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
    /// The recording is of another robot.
    #[error(
        "{} has {recorded} joints, but the robot of {} has {described} ({names}): --tip, --joints, \
         --without or --lock select those that were recorded",
        recording.display(), robot.display()
    )]
    Joints { recording: PathBuf, recorded: usize, robot: PathBuf, described: usize, names: String },
    /// The joint was where the description does not allow it to be.
    #[error(
        "{}: joint {joint} (`{name}`) was at {position:.3}, its limits in {} are {lower:.3} and \
         {upper:.3}: is the recording of this robot, with the zeros of its encoders?",
        recording.display(), robot.display()
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

/// A mistake in a recording.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    #[error("it has no titles: is it a record of `cargo xtask watch --record FILE.csv`?")]
    Empty,
    #[error("it lacks the column `{0}` of a record of `cargo xtask watch --record FILE.csv`")]
    NoColumn(String),
    #[error("it has the column `{0}` twice")]
    Twice(String),
    #[error("{found} columns in place of {expected}")]
    Columns { found: usize, expected: usize },
    #[error("the line has more than {0} bytes")]
    LongLine(usize),
    #[error("the line is no text in UTF-8")]
    NoText,
    #[error("column `{column}`: `{text}` is not {expected}")]
    Value { column: String, text: String, expected: &'static str },
    #[error(
        "column `number`: {number} follows {before}: each tick has a greater number than the one \
         before; two runs are two files"
    )]
    Order { number: u32, before: u32 },
    #[error("column `time_s`: {found} s in place of {expected} s, which the tick of {tick} s says")]
    Time { found: f64, expected: f64, tick: f64 },
    #[error("{0} joints are more than {max}", max = crate::files::MOST_JOINTS)]
    TooManyJoints(usize),
    #[error("more than {0} ticks")]
    TooLong(usize),
    #[error("it has no two ticks with a time, from which the length of a tick follows")]
    NoTick,
    #[error(
        "no tick has the mode `full`, in which the controller makes the torque: the arm was on \
         hold or stopped"
    )]
    NoTicks,
}
