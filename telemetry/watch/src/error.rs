//! Everything that can go wrong, in words that name the port, program or file concerned.

use std::path::PathBuf;
use std::time::Duration;

/// The result of anything here that touches the outside.
pub type Result<T> = std::result::Result<T, Error>;

/// Why nothing is shown any more.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The serial port cannot be opened.
    #[error("cannot open the serial port {port}: {source}; {ports}")]
    Port {
        /// Its name.
        port: String,
        /// What the system reported.
        source: serialport::Error,
        /// The ports that there are, as a sentence.
        ports: String,
    },
    /// A program cannot be started.
    #[error("cannot start `{program}`: {source}")]
    Start {
        /// Its name.
        program: String,
        /// What the system reported.
        source: std::io::Error,
    },
    /// A program ended before it connected.
    #[error("`{program}` ended ({status}) before it sent anything")]
    Ended {
        /// Its name.
        program: String,
        /// How it ended.
        status: std::process::ExitStatus,
    },
    /// A program failed.
    #[error("`{program}` failed ({status})")]
    Failed {
        /// Its name.
        program: String,
        /// How it ended.
        status: std::process::ExitStatus,
    },
    /// The bytes cannot be read.
    #[error("cannot read from {source_name} or write to it: {source}")]
    Read {
        /// The port, program or file.
        source_name: String,
        /// What the system reported.
        source: std::io::Error,
    },
    /// No frame arrived for so long.
    #[error("no frame from {source_name} in {:.0} s: {hint}", patience.as_secs_f64())]
    Silent {
        /// The port, program or file.
        source_name: String,
        /// How long.
        patience: Duration,
        /// What arrived instead, and what may be the reason.
        hint: String,
    },
    /// A record cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Record {
        /// The file.
        path: PathBuf,
        /// What the system reported.
        source: std::io::Error,
    },
    /// An MCAP record cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Mcap {
        /// The file.
        path: PathBuf,
        /// What the writer reported.
        source: mcap::McapError,
    },
    /// A record has an unknown ending.
    #[error("{}: a record ends with .csv or .mcap", path.display())]
    Ending {
        /// The file.
        path: PathBuf,
    },
    /// The terminal or stdout cannot be written.
    #[error("cannot write to the terminal: {0}")]
    Terminal(#[from] std::io::Error),
}
