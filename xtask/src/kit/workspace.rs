//! The paths of the workspace and its artefacts.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use serde_json::Value;

use crate::kit::error::{Error, Result, check};
use crate::kit::{shell, unpacked};

/// The packages whose bins run on the target: the demo's scenes, and what the laboratory measures.
/// Cargo finds a bin and a feature in the one that has it.
pub const FIRMWARE: [&str; 2] = ["firmware-demo", LAB];
pub const LAB: &str = "lab-firmware";
/// The manifest of the workspace of boards, which has HALs that nobody else needs.
pub const BOARDS: &str = "firmware-demo/boards/Cargo.toml";

/// The workspace that xtask was called in.
pub struct Workspace {
    pub root: PathBuf,
    /// Cargo's target directory, wherever `CARGO_TARGET_DIR` or a config put it.
    pub target: PathBuf,
    /// The directory for reports, if it is not the workspace.
    pub reports: Option<PathBuf>,
    /// Whether this is a full run of the tests, in which the host's programs are built with the
    /// features of its tests.
    pub full: bool,
    /// The firmware's bins that need no feature.
    pub bins: Vec<String>,
}

/// Set once from the command line.
static REPORTS: OnceLock<PathBuf> = OnceLock::new();

/// Reports are written into this directory from now on; it is made if it is not there.
pub fn write_reports_to(dir: PathBuf) -> Result<()> {
    std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
    let dir = std::path::absolute(&dir).map_err(Error::file("find", &dir))?;
    // Set nowhere else.
    let _ = REPORTS.set(dir);
    Ok(())
}

impl Workspace {
    /// As [`Workspace::find`], for a command that writes reports at its end.
    ///
    /// # Errors
    /// They cannot be written: better now than after the minutes that the measurements take.
    pub fn for_reports() -> Result<Self> {
        let workspace = Self::find()?;
        let probe = workspace.report("docs/.writable");
        write(&probe, "")?;
        std::fs::remove_file(&probe).map_err(Error::file("remove", &probe))?;
        Ok(workspace)
    }

    /// The path to write a report to, from its path in the workspace.
    pub fn report(&self, file: &str) -> PathBuf {
        match (&self.reports, Path::new(file).file_name()) {
            (Some(dir), Some(name)) => dir.join(name),
            _ => self.root.join(file),
        }
    }

    /// Asks cargo, from the current directory.
    pub fn find() -> Result<Self> {
        let mut command = host_cargo();
        command.args(["metadata", "--no-deps", "--format-version", "1"]);
        let metadata: Value = serde_json::from_str(&shell::capture(&mut command)?)
            .map_err(|e| check!("`{}`: {e}", shell::display(&command)))?;
        let path = |key: &str| metadata[key].as_str().map(PathBuf::from);
        let lacks = || check!("`cargo metadata` names no directories");
        let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
        let root = path("workspace_root").ok_or_else(lacks)?;
        let packages = list(&metadata["packages"]);
        let targets = packages
            .into_iter()
            .filter(|package| FIRMWARE.iter().any(|name| package["name"] == *name));
        let targets = targets.flat_map(|package| list(&package["targets"]));
        let bins = targets.filter(|target| {
            let is_bin = list(&target["kind"]).iter().any(|kind| kind == "bin");
            is_bin && list(&target["required-features"]).is_empty()
        });
        let names = bins.filter_map(|bin| bin["name"].as_str().map(str::to_owned));
        Ok(Self {
            root,
            target: path("target_directory").ok_or_else(lacks)?,
            reports: REPORTS.get().cloned(),
            full: false,
            bins: names.collect(),
        })
    }

    /// A cargo command for host crates, with the cargo that started xtask.
    pub fn cargo(&self, subcommand: &str) -> Command {
        let mut command = host_cargo();
        command.arg(subcommand).current_dir(&self.root);
        command.envs(unpacked::path(&self.target).map(|path| ("PATH", path)));
        command
    }

    /// A file in the demo's output directory, which is made if it is not there.
    pub fn output(&self, name: &str) -> Result<PathBuf> {
        let dir = self.target.join("demo");
        std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
        Ok(dir.join(name))
    }

    /// `path` from the workspace's root, if it is inside it.
    pub fn relative<'a>(&self, path: &'a Path) -> &'a Path {
        path.strip_prefix(&self.root).unwrap_or(path)
    }
}

#[cfg(test)]
impl Workspace {
    /// A workspace without packages, for tests.
    pub fn at(folder: &Path) -> Self {
        Self {
            root: folder.to_owned(),
            target: PathBuf::new(),
            bins: Vec::new(),
            reports: None,
            full: false,
        }
    }
}

fn host_cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Reads a text file, with an error that names it.
pub fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(Error::file("read", path))
}

/// Writes a file so that it is never half-written, with an error that names it.
pub fn write(path: &Path, contents: impl AsRef<[u8]>) -> Result<()> {
    write_whole(&[(path.to_owned(), contents)])
}

/// Writes files so that none is ever half-written: all beside their places first, then each is
/// moved there.
pub fn write_whole<T: AsRef<[u8]>>(files: &[(PathBuf, T)]) -> Result<()> {
    // The suffix follows the whole name: files of one stem may differ in their endings alone.
    let beside = |path: &Path| {
        let mut name = path.as_os_str().to_owned();
        name.push(".part");
        PathBuf::from(name)
    };
    let write = |(path, contents): &(PathBuf, T)| {
        // The message names the file that the user knows.
        std::fs::write(beside(path), contents).map_err(Error::file("write", path))
    };
    let place = |(path, _): &(PathBuf, T)| {
        std::fs::rename(beside(path), path).map_err(Error::file("write", path))
    };
    let written = files.iter().try_for_each(write);
    let moved = written.and_then(|()| files.iter().try_for_each(place));
    if moved.is_err() {
        for (path, _) in files {
            // Those that were not written, or moved already, are not there.
            let _ = std::fs::remove_file(beside(path));
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::{read, write_whole};

    #[test]
    fn a_failed_write_leaves_the_old_file_and_no_part() {
        let folder = tempfile::tempdir().expect("a folder");
        let [page, plot] = ["page.md", "plot.svg"].map(|name| folder.path().join(name));
        std::fs::write(&page, "old").expect("the page of before");
        // A directory in the way stands for a full disk: the second file cannot be written.
        std::fs::create_dir_all(folder.path().join("plot.svg.part")).expect("in the way");
        let error =
            write_whole(&[(page.clone(), "new"), (plot.clone(), "new")]).expect_err("refused");
        assert!(error.to_string().contains("plot.svg:"), "{error}");
        assert_eq!(read(&page).expect("there"), "old");
        assert!(!folder.path().join("page.md.part").exists());
    }

    #[test]
    fn files_of_one_stem_are_written_side_by_side() {
        let folder = tempfile::tempdir().expect("a folder");
        let files =
            ["page.md", "page.json"].map(|name| (folder.path().join(name), name.to_owned()));
        write_whole(&files).expect("both");
        for (path, contents) in &files {
            assert_eq!(read(path).expect("there"), *contents);
        }
        assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 2);
    }
}
