//! Why no project is written.

use std::io;
use std::path::{Path, PathBuf};

use super::board::{self, Framework};
use crate::text::visible;

/// A project that cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProjectError {
    /// The name cannot be that of a crate.
    #[error("`{name}` cannot be the name of a project: {reason}")]
    Name {
        /// The name.
        name: String,
        /// Why, and what to do.
        reason: &'static str,
    },
    /// The folder has files already.
    #[error("{} is there already and is not empty: give another folder or name", .0.display())]
    NotEmpty(PathBuf),
    /// The git address or path of the library cannot be written into a manifest.
    #[error("the library's address `{0}` has a control character or is no Unicode")]
    Library(String),
    /// No board has this name.
    #[error(
        "there is no firmware for a board `{}`; there is: {}. The page \"Another core or board\" of \
         the guide (docs/guide/src/porting.md) has what other boards need",
        visible(.0),
        board::all(None)
    )]
    Board(String),
    /// A board has no firmware with this framework.
    #[error(
        "there is no firmware for {board} with {framework}; there is: {}",
        board::all(Some(board))
    )]
    Framework {
        /// The board.
        board: String,
        /// The framework.
        framework: Framework,
    },
    /// The robot has more joints than a board has encoders and drives for.
    #[error(
        "the robot has {joints} joints, {board} has drives for {most}: `--tip`, `--joints` or \
         `--lock` leave joints out, or write the project without `--board`"
    )]
    TooManyJoints {
        /// The number of joints of the robot.
        joints: usize,
        /// The board.
        board: &'static str,
        /// The most joints of the board.
        most: usize,
    },
    /// A file or folder cannot be read or written.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// The attempt that failed.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
}

impl ProjectError {
    /// The error of an action on a path.
    pub(super) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { action, path, source }
    }
}
