//! The errors.

use std::path::Path;

/// A sentence that names the file or the command.
#[derive(Debug)]
pub struct Error(pub String);

/// The result of anything that touches files or other programs.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// A closure for `map_err` on a file operation.
    pub fn file<E: std::fmt::Display>(path: &Path) -> impl FnOnce(E) -> Self {
        let path = path.display().to_string();
        move |error| Self(format!("{path}: {error}"))
    }
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}
