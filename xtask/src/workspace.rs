//! Where the workspace and its artefacts are.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use crate::error::{Error, Result};
use crate::shell;

/// The package whose bins are the scenes and the checks that run on the target.
pub const FIRMWARE: &str = "firmware-demo";

/// The workspace that xtask was called in.
pub struct Workspace {
    /// Its root directory.
    pub root: PathBuf,
    /// Cargo's target directory, wherever `CARGO_TARGET_DIR` or a config put it.
    pub target: PathBuf,
    /// The firmware's bins that are built without a feature being asked for.
    pub bins: Vec<String>,
}

#[derive(Deserialize)]
struct Metadata {
    workspace_root: PathBuf,
    target_directory: PathBuf,
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    targets: Vec<Target>,
}

#[derive(Deserialize)]
struct Target {
    name: String,
    kind: Vec<String>,
    #[serde(default, rename = "required-features")]
    required_features: Vec<String>,
}

impl Workspace {
    /// Asks cargo, from the current directory.
    pub fn find() -> Result<Self> {
        let mut command = host_cargo();
        command.args(["metadata", "--no-deps", "--format-version", "1"]);
        let json = shell::capture(&mut command)?;
        let metadata: Metadata = serde_json::from_str(&json)
            .map_err(|e| Error::check(format!("`{}`: {e}", shell::display(&command))))?;
        let bins = metadata
            .packages
            .into_iter()
            .filter(|package| package.name == FIRMWARE)
            .flat_map(|package| package.targets)
            .filter(|target| target.kind.iter().any(|kind| kind == "bin"))
            .filter(|target| target.required_features.is_empty())
            .map(|target| target.name)
            .collect();
        Ok(Self {
            root: metadata.workspace_root,
            target: metadata.target_directory,
            bins,
        })
    }

    /// A cargo command for host crates, with the cargo that started xtask.
    pub fn cargo(&self, subcommand: &str) -> Command {
        let mut command = host_cargo();
        command.arg(subcommand).current_dir(&self.root);
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

fn host_cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Reads a text file, with an error that names it.
pub fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(Error::file("read", path))
}

/// Writes a file, with an error that names it.
pub fn write(path: &Path, contents: impl AsRef<[u8]>) -> Result<()> {
    std::fs::write(path, contents).map_err(Error::file("write", path))
}

/// Writes files so that none is ever half-written: all beside their places first, then each is moved there.
pub fn write_whole(files: &[(PathBuf, String)]) -> Result<()> {
    // Behind the whole name: files of one stem may differ in their endings alone.
    let beside = |path: &Path| {
        let mut name = path.as_os_str().to_owned();
        name.push(".part");
        PathBuf::from(name)
    };
    for (path, contents) in files {
        write(&beside(path), contents)?;
    }
    for (path, _) in files {
        std::fs::rename(beside(path), path).map_err(Error::file("write", path))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{read, write_whole};

    #[test]
    fn files_of_one_stem_are_written_side_by_side() {
        let folder = std::env::temp_dir().join(format!("written-whole-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let files = ["page.md", "page.json"].map(|name| (folder.join(name), name.to_owned()));
        write_whole(&files).expect("both");
        for (path, contents) in &files {
            assert_eq!(read(path).expect("there"), *contents);
        }
        assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 2);
        std::fs::remove_dir_all(&folder).expect("gone again");
    }
}
