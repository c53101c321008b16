//! A copy of the workspace whose drawn sites have switches.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::error::{Error, Result};
use crate::rooms::room_of;
use crate::site::{Site, Taken, rewritten};

/// The crate of the switch, in the copy.
const SWITCH: &str = "mutant-switch";
const SWITCH_MANIFEST: &str =
    "[package]\nname = \"mutant-switch\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";

/// The bytes of each site, by the file of the copy that contains it.
pub type Places = BTreeMap<String, Taken>;

/// The files of the workspace: those of its repository and those that are not ignored.
pub fn files(root: &Path) -> Result<Vec<String>> {
    let mut git = Command::new("git");
    git.current_dir(root)
        .args(["ls-files", "--cached", "--others", "--exclude-standard"]);
    let output = git.output().map_err(Error::file(root))?;
    let list = String::from_utf8_lossy(&output.stdout);
    let exists = |file: &&str| root.join(file).is_file();
    let mut files: Vec<String> = list.lines().filter(exists).map(str::to_owned).collect();
    files.sort();
    files.dedup();
    match files.is_empty() {
        true => Err(Error(format!("git lists no files of {}", root.display()))),
        false => Ok(files),
    }
}

/// All sites of the files that belong to a room.
pub fn sites(root: &Path, files: &[String]) -> Result<Vec<Site>> {
    let mut sites = Vec::new();
    for file in files.iter().filter(|file| room_of(file).is_some()) {
        let path = root.join(file);
        let source = std::fs::read_to_string(&path).map_err(Error::file(&path))?;
        sites.extend(crate::find::sites(file, &source).map_err(Error::file(&path))?);
    }
    Ok(sites)
}

/// Brings the copy up to date. Files that are the same keep their times, so that cargo builds what changed.
pub fn update(root: &Path, copy: &Path, files: &[String], sites: &[Site]) -> Result<Places> {
    let mut of_file: BTreeMap<&str, Vec<&Site>> = BTreeMap::new();
    for site in sites {
        of_file.entry(&site.file).or_default().push(site);
    }
    let (mut places, mut written) = (Places::new(), BTreeSet::new());
    for file in files {
        let path = root.join(file);
        let mut bytes = std::fs::read(&path).map_err(Error::file(&path))?;
        if let Some(sites) = of_file.get(file.as_str()) {
            let source = String::from_utf8(bytes).map_err(Error::file(&path))?;
            let (text, of_sites) = rewritten(&source, sites);
            places.insert(file.clone(), of_sites);
            bytes = text.into_bytes();
        } else if Path::new(file).ends_with("Cargo.toml") {
            let text = String::from_utf8(bytes).map_err(Error::file(&path))?;
            bytes = manifest(file, text).into_bytes();
        }
        write(&copy.join(file), &bytes)?;
        written.insert(copy.join(file));
    }
    for (file, text) in [
        ("Cargo.toml", SWITCH_MANIFEST),
        ("src/lib.rs", include_str!("switch.rs")),
    ] {
        let path = copy.join(SWITCH).join(file);
        write(&path, text.as_bytes())?;
        written.insert(path);
    }
    remove_others(copy, &written)?;
    Ok(places)
}

/// A manifest with the crate of the switch.
fn manifest(file: &str, text: String) -> String {
    if file == "Cargo.toml" {
        return text.replace("members = [", &format!("members = [\"{SWITCH}\", "));
    }
    // The path to the copy's root from here.
    let up = "../".repeat(file.matches('/').count());
    text.replacen(
        "[dependencies]\n",
        &format!("[dependencies]\n{SWITCH} = {{ path = \"{up}{SWITCH}\" }}\n"),
        1,
    )
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    // Cargo completes the lock file of the copy: it is written when the workspace's own has changed.
    if path.ends_with("Cargo.lock") && path.exists() {
        return Ok(());
    }
    if std::fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(Error::file(folder))?;
    }
    std::fs::write(path, bytes).map_err(Error::file(path))
}

/// A file that the workspace no longer has could still be a test.
fn remove_others(folder: &Path, written: &BTreeSet<PathBuf>) -> Result<()> {
    for entry in std::fs::read_dir(folder).map_err(Error::file(folder))? {
        let path = entry.map_err(Error::file(folder))?.path();
        if path.is_dir() {
            remove_others(&path, written)?;
        } else if path.extension().is_some_and(|extension| extension == "rs")
            && !written.contains(&path)
        {
            std::fs::remove_file(&path).map_err(Error::file(&path))?;
        }
    }
    Ok(())
}
