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
        port: String,
        source: serialport::Error,
        /// The ports that there are, as a sentence.
        ports: String,
    },
    #[error("cannot start `{program}`: {source}")]
    Start { program: String, source: std::io::Error },
    /// A program ended before it connected.
    #[error("`{program}` ended ({status}) before it sent anything")]
    Ended { program: String, status: std::process::ExitStatus },
    #[error("`{program}` failed ({status})")]
    Failed { program: String, status: std::process::ExitStatus },
    #[error("cannot read from {source_name} or write to it: {source}")]
    Read {
        /// The port, program or file.
        source_name: String,
        source: std::io::Error,
    },
    /// No frame arrived within the time limit.
    #[error("no frame from {source_name} in {:.0} s: {hint}", patience.as_secs_f64())]
    Silent {
        /// The port, program or file.
        source_name: String,
        patience: Duration,
        /// The bytes that arrived instead, and a possible reason.
        hint: String,
    },
    #[error("cannot write {}: {source}", path.display())]
    Record { path: PathBuf, source: std::io::Error },
    /// An MCAP record cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Mcap { path: PathBuf, source: mcap::McapError },
    /// A record has an unknown ending.
    #[error("{}: a record ends with .csv or .mcap", path.display())]
    Ending { path: PathBuf },
    /// The terminal or stdout cannot be written.
    #[error("cannot write to the terminal: {0}")]
    Terminal(#[from] std::io::Error),
}
