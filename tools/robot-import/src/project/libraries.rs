//! The library's crates as a project carries them: their sources, and manifests that need no
//! workspace.

use super::{Library, ProjectError, VERSION};

/// A crate of the repository.
struct Crate {
    folder: &'static str,
    /// The path of each file in it, and its text.
    files: &'static [(&'static str, &'static str)],
}

/// Texts of the repository, in the order of `build.rs`.
const FILES: [&str; 6] = include!(concat!(env!("OUT_DIR"), "/files.rs"));
const CRATES: &[Crate] = include!(concat!(env!("OUT_DIR"), "/crates.rs"));
/// The manifest of the repository, from which those of its crates inherit.
const WORKSPACE: &str = FILES[0];
/// The versions of the registry's crates that the repository's tests have compiled. Cargo drops
/// what a project does not use.
pub(super) const LOCK: &str = FILES[1];
pub(super) const LOCK_OF_BOARDS: &str = FILES[2];
/// Files beside the crates: their licences, and how their sources are formatted.
const BESIDE: [(&str, &str); 3] = [
    ("libraries/LICENSE-APACHE", FILES[3]),
    ("libraries/LICENSE-MIT", FILES[4]),
    ("libraries/rustfmt.toml", FILES[5]),
];

/// The folder of a project with the crates.
pub(super) const FOLDER: &str = "libraries";

/// The sections of a manifest that a crate needs to be compiled as a dependency.
const KEPT: [&str; 4] = ["[package]", "[features]", "[dependencies]", "[lib]"];

/// The crates that a project's manifest names, and those that they use, with their licences.
pub(super) fn copies(manifest: &str) -> Vec<(String, String)> {
    let is_named = |text: &str, folder: &str| text.contains(&format!("{folder}\""));
    let mut named: Vec<&Crate> = CRATES
        .iter()
        .filter(|one| is_named(manifest, &format!("{FOLDER}/{}", one.folder)))
        .collect();
    let mut copied = 0;
    let mut files: Vec<(String, String)> = BESIDE.map(|(p, t)| (p.into(), t.into())).into();
    while let Some(&one) = named.get(copied) {
        copied += 1;
        for (path, text) in one.files {
            let text = match *path {
                "Cargo.toml" => stand_alone(text, WORKSPACE),
                _ => (*text).to_owned(),
            };
            if *path == "Cargo.toml" {
                let is_new = |other: &&Crate| {
                    is_named(&text, &format!("../{}", other.folder))
                        && named.iter().all(|named| named.folder != other.folder)
                };
                let further: Vec<&Crate> = CRATES.iter().filter(is_new).collect();
                named.extend(further);
            }
            files.push((format!("{FOLDER}/{}/{path}", one.folder), text));
        }
    }
    files
}

/// The value of a key in a section of the workspace's manifest.
fn inherited<'a>(workspace: &'a str, section: &str, key: &str) -> Option<&'a str> {
    let header = format!("[workspace.{section}]");
    let lines = workspace.lines().skip_while(|line| *line != header).skip(1);
    let mut own = lines.take_while(|line| !line.starts_with('['));
    let value = own.find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
    value.map(str::trim)
}

/// A manifest whose inherited values are its own, without tests and lints.
fn stand_alone(manifest: &str, workspace: &str) -> String {
    let (mut kept, mut section) = (String::new(), "");
    for line in manifest.lines() {
        if line.starts_with('[') {
            section = line;
        }
        let is_outside = line.starts_with("readme = \"../");
        if !KEPT.contains(&section) || is_outside {
            continue;
        }
        kept += &own(line, section, workspace).unwrap_or_else(|| line.to_owned());
        kept.push('\n');
    }
    kept
}

/// A line that inherits, with what it inherits.
fn own(line: &str, section: &str, workspace: &str) -> Option<String> {
    let from = match section {
        "[package]" => "package",
        _ => "dependencies",
    };
    if let Some(key) = line.strip_suffix(".workspace = true") {
        let value = inherited(workspace, from, key)?;
        return Some(format!("{key} = {}", beside(value)));
    }
    let (key, rest) = line.split_once(" = { workspace = true")?;
    let value = beside(inherited(workspace, from, key)?);
    let inner = match value.strip_prefix('{') {
        Some(table) => table.trim_end_matches('}').trim().to_owned(),
        None => format!("version = {value}"),
    };
    Some(format!("{key} = {{ {inner}{rest}"))
}

/// A dependency of the workspace as a crate in a folder beside it has it.
fn beside(value: &str) -> String {
    value.replace("path = \"", "path = \"../")
}

impl Library {
    /// The one of a user who names none: a copy, if the program carries the crates.
    #[must_use]
    pub fn own() -> Self {
        if CRATES.is_empty() { Self::Registry } else { Self::Copy }
    }

    /// The words of the README about it.
    pub(super) fn note(&self) -> Result<String, ProjectError> {
        Ok(match self {
            Self::Copy => format!(
                "`{FOLDER}/` has the crates of dynamics-core {VERSION} that this project uses, so that it \
                 stands alone. To take them from their repository\ninstead, replace each `path \
                 = \"{FOLDER}/…\"` in `Cargo.toml` by `git = \"ADDRESS\"`, and delete the folder.",
            ),
            Self::Registry | Self::Path(_) | Self::Git(_) => format!(
                "Cargo takes the crates of dynamics-core from `Cargo.toml`'s `{}`.",
                self.dependency(super::DYNAMICS)?
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{CRATES, WORKSPACE, copies, stand_alone};

    #[test]
    fn what_is_inherited_becomes_the_crates_own() {
        let workspace = "[workspace.package]\nversion = \"1.2.3\"\n\n[workspace.dependencies]\na = \
            { path = \"a\" }\nb = \"2\"\n";
        let manifest = "[package]\nname = \"c\"\nreadme = \"../README.md\"\nversion.workspace = \
                        true\n\n[dependencies]\n\
                        a.workspace = true\nb = \
                        { workspace = true, features = [\"x\"] }\n\n[dev-dependencies]\nd \
                        = \"1\"\n\n\
                        [lints]\nworkspace = true\n";
        let expected = "[package]\nname = \"c\"\nversion = \"1.2.3\"\n\n[dependencies]\na = \
                        { path = \"../a\" }\n\
                        b = { version = \"2\", features = [\"x\"] }\n\n";
        assert_eq!(stand_alone(manifest, workspace), expected);
    }

    #[test]
    fn no_crate_of_the_repository_keeps_what_only_the_repository_has() {
        for one in CRATES {
            let (_, text) =
                one.files.iter().find(|file| file.0 == "Cargo.toml").expect("a manifest");
            let text = stand_alone(text, WORKSPACE);
            assert!(!text.contains("workspace"), "{text}");
            for path in text.split("path = \"").skip(1) {
                let path = path.split('"').next().unwrap_or_default();
                let is_copied = |one: &super::Crate| path.strip_prefix("../") == Some(one.folder);
                assert!(CRATES.iter().any(is_copied), "{path}");
            }
        }
    }

    #[test]
    fn a_crate_comes_with_those_that_it_uses() {
        let files = copies("joint-drivers = { path = \"libraries/drivers\" }");
        for one in ["drivers", "dynamics-core", "motion-control"] {
            let manifest = format!("libraries/{one}/Cargo.toml");
            assert_eq!(files.iter().filter(|file| file.0 == manifest).count(), 1, "{one}");
        }
        assert!(!files.iter().any(|file| file.0.contains("/telemetry/")));
    }
}
