//! Files that are written: none of them replaces a file that is read, or another that is written.

use std::path::{Path, PathBuf};

use crate::error::{Problem, Result};
use crate::limits::{MOST_BYTES, MOST_FOLLOWED};

/// Fails if an output is one of the inputs, or another output, by whatever path and link of the
/// file system.
///
/// Devices and pipes can be written several times.
///
/// # Errors
/// [`Problem::Write`] with the path.
pub fn are_apart(inputs: &[&Path], outputs: &[&Path]) -> Result<()> {
    for (i, &output) in outputs.iter().enumerate() {
        let clash = |reason: String| Problem::Write { path: output.display().to_string(), reason };
        if let Some(input) = inputs.iter().find(|input| same_file(input, output)) {
            let words = format!("it is {}, which is read and would be lost", input.display());
            return Err(clash(words).into());
        }
        if let Some(other) = outputs[..i].iter().find(|other| same_file(other, output)) {
            let words = format!("it is {}, which is written, too", other.display());
            return Err(clash(words).into());
        }
    }
    Ok(())
}

/// Whether two paths are one file, or would be if they were written.
pub fn same_file(a: &Path, b: &Path) -> bool {
    match (std::fs::metadata(a), std::fs::metadata(b)) {
        (Ok(one), Ok(other)) => {
            one.is_file() && other.is_file() && (is_one(&one, &other) || target(a) == target(b))
        }
        (Err(_), Err(_)) => target(a) == target(b),
        _ => false,
    }
}

/// Names of one file have its number.
#[cfg(unix)]
fn is_one(one: &std::fs::Metadata, other: &std::fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(not(unix))]
fn is_one(_: &std::fs::Metadata, _: &std::fs::Metadata) -> bool {
    false
}

/// The path of a file without links, also of one that is not there yet.
fn target(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_FOLLOWED {
        let Ok(next) = std::fs::read_link(&path) else {
            break;
        };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    if let Ok(found) = path.canonicalize() {
        return found;
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    match (folder.canonicalize(), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => std::path::absolute(&path).unwrap_or(path),
    }
}

/// The text of a file that is to be written anew, if there is one: a device has no end.
pub fn written_before(path: &Path) -> Option<String> {
    let is_one = |of: &std::fs::Metadata| of.is_file() && of.len() <= MOST_BYTES as u64;
    std::fs::metadata(path).ok().filter(is_one)?;
    std::fs::read_to_string(path).ok()
}

/// Writes a file.
///
/// # Errors
/// [`Problem::Write`] with the path.
pub fn write(path: &Path, text: &str) -> Result<()> {
    std::fs::write(path, text).map_err(|error| {
        let problem =
            Problem::Write { path: path.display().to_string(), reason: error.to_string() };
        problem.into()
    })
}
