//! Everything that can go wrong, in words that name the command or file concerned.

use std::path::PathBuf;
use std::process::{Command, ExitStatus};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::kit::display::display;

/// Whether every error of a program names it.
pub static VERBOSE: AtomicBool = AtomicBool::new(false);

/// The result of anything here that touches the outside.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a command of xtask stopped.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A program could not be started at all.
    #[error("cannot start `{command}`: {source}")]
    Spawn { command: String, source: std::io::Error },
    #[error("`{command}` failed ({status}){output}")]
    Failed {
        command: String,
        status: ExitStatus,
        /// Its output on separate lines, if it was captured.
        output: String,
    },
    /// A file could not be read or written.
    #[error("cannot {verb} {}: {source}", path.display())]
    File {
        /// `read`, `write`, `create` …
        verb: &'static str,
        path: PathBuf,
        source: std::io::Error,
    },
    /// Stdout could not be written.
    #[error("cannot write to stdout: {0}")]
    Output(std::io::Error),
    /// Something has to be installed that was not.
    #[error("something is missing; to install it:\n\n    {}\n", commands.join("\n    "))]
    Missing { commands: Vec<String> },
    /// QEMU, or the firmware in it, misbehaved.
    #[error("`{program}` in QEMU: {what}")]
    Qemu { program: String, what: String },
    #[error("{0}")]
    Check(String),
    /// A check does not apply here, and why.
    #[error("skipped: {0}")]
    Skipped(String),
}

/// A check that did not hold, in words that are formatted.
#[macro_export]
macro_rules! check {
    ($($words:tt)*) => { $crate::kit::error::Error::Check(format!($($words)*)) };
}

/// Returns with [`check!`].
#[macro_export]
macro_rules! bail {
    ($($words:tt)*) => { return Err($crate::kit::error::check!($($words)*)) };
}

/// Returns with [`check!`] if something is wrong.
#[macro_export]
macro_rules! refuse_if {
    ($is_wrong:expr, $($words:tt)*) => { if $is_wrong { $crate::kit::error::bail!($($words)*) } };
}

pub use crate::{bail, check, refuse_if};

impl Error {
    /// `command` could not be started.
    pub fn spawn(command: &Command, source: std::io::Error) -> Self {
        let command = display(command);
        Self::Spawn { command, source }
    }

    pub fn failed(command: &Command, status: ExitStatus, output: String) -> Self {
        let command = display(command);
        Self::Failed { command, status, output }
    }

    /// The error of a program of ours in its own words; the command is for those who ask for it.
    pub fn reason(self) -> Self {
        let text = self.to_string();
        let said = text.split_once("\nerror: ").map(|(_, said)| said.to_owned());
        let said = said.filter(|_| !VERBOSE.load(Ordering::Relaxed));
        said.map_or(self, Self::Check)
    }

    /// A closure for `map_err` on a file operation.
    pub fn file(
        verb: &'static str,
        path: impl Into<PathBuf>,
    ) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::File { verb, path, source }
    }

    pub fn qemu(program: &str, what: impl Into<String>) -> Self {
        let (program, what) = (program.to_owned(), what.into());
        Self::Qemu { program, what }
    }

    /// Whether the reader has closed the pipe, as `head` does.
    pub fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Output(source) if source.kind() == std::io::ErrorKind::BrokenPipe)
    }
}
