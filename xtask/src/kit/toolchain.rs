//! The two ways to a compiler for the target: the one that runs xtask, with the target's
//! core added by rustup, or Debian's own, which builds core from Debian's sources.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::kit::error::{Result, bail};
use crate::kit::shell;
use crate::kit::workspace::{FIRMWARE, Workspace};

pub const TARGET: &str = "thumbv7em-none-eabihf";

/// The profile of what is measured, and the same at opt-level s.
pub const RELEASE: &str = "release";
pub const SMALL: &str = "small";

pub const DEBIAN_PACKAGES: &[&str] = &["rustc-web", "cargo-web", "rust-web-src", "lld"];

const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";
const DEBIAN_CLIPPY: &str = "/usr/bin/cargo-clippy";
const DEBIAN_LINKER: &str = "/usr/bin/ld.lld";

/// A compiler that can build the firmware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toolchain {
    /// The compiler that runs xtask.
    Native,
    Debian,
}

impl Toolchain {
    /// `cargo SUBCOMMAND … --target … --package firmware-demo …`, to be completed.
    pub fn firmware(self, workspace: &Workspace, subcommand: &str) -> Command {
        let mut command = self.cargo(workspace, subcommand);
        command.args(FIRMWARE.iter().flat_map(|name| ["--package", name]));
        command
    }

    /// `cargo SUBCOMMAND … --target …`, to be completed.
    pub fn cargo(self, workspace: &Workspace, subcommand: &str) -> Command {
        let mut command = match self {
            Self::Native => {
                let mut command = workspace.cargo(subcommand);
                command.args(native_paths().iter().flat_map(|paths| ["--config", paths]));
                command
            }
            Self::Debian => {
                // Cargo would find rustup's `cargo-clippy` first.
                let programs = [DEBIAN_CARGO, DEBIAN_CLIPPY];
                let mut command = debian(programs[usize::from(subcommand == "clippy")]);
                command
                    .args([subcommand, "-Zbuild-std=core"])
                    .env("CARGO", DEBIAN_CARGO)
                    .current_dir(&workspace.root)
                    .env("RUSTC", DEBIAN_RUSTC)
                    .env("RUSTC_BOOTSTRAP", "1")
                    .env("CARGO_TARGET_DIR", self.target_dir(workspace))
                    // Debian ships no rust-lld.
                    .env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER", DEBIAN_LINKER);
                command
            }
        };
        command.args(["--target", TARGET]);
        command
    }

    /// The folder of this compiler's artefacts: two compilers in one directory would rebuild
    /// everything at each change of hands.
    fn target_dir(self, workspace: &Workspace) -> PathBuf {
        match self {
            Self::Native => workspace.target.clone(),
            Self::Debian => workspace.target.join("debian"),
        }
    }

    /// The ELF of a bin of the firmware in a profile.
    pub fn elf(self, workspace: &Workspace, profile: &str, bin: &str) -> PathBuf {
        let mut path = self.target_dir(workspace);
        path.extend([TARGET, profile, bin]);
        path
    }

    pub fn rustc_version(self) -> Result<String> {
        let mut command = match self {
            Self::Native => native_rustc(),
            Self::Debian => debian(DEBIAN_RUSTC),
        };
        Ok(shell::capture(command.arg("--version"))?.trim().to_owned())
    }
}

/// The result of [`recorded_paths`] for the compiler that runs xtask.
fn native_paths() -> Option<&'static str> {
    static PATHS: OnceLock<Option<String>> = OnceLock::new();
    let paths = PATHS.get_or_init(|| {
        let says = |arguments: &[&str]| shell::capture(native_rustc().args(arguments)).ok();
        let (sysroot, version) = (says(&["--print", "sysroot"])?, says(&["-vV"])?);
        recorded_paths(Path::new(sysroot.trim()), &version)
    });
    paths.as_deref()
}

/// The setting of cargo by which a compiler that has the sources of core, rustup's component
/// rust-src, writes their paths as one that has none: the firmware's messages name them, so that
/// its size would depend on the component.
fn recorded_paths(sysroot: &Path, version: &str) -> Option<String> {
    let hash = version.lines().find_map(|line| line.strip_prefix("commit-hash: "))?;
    let sources = sysroot.join("lib/rustlib/src/rust");
    has_sources(sysroot).then(|| {
        let flag = format!("--remap-path-prefix={}=/rustc/{hash}", sources.display());
        // Strings of JSON are strings of TOML, with a quote or a backslash in the path, too.
        format!("target.{TARGET}.rustflags=[{}]", serde_json::Value::from(flag))
    })
}

fn native_rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

fn debian(program: &str) -> Command {
    let mut command = Command::new(program);
    clear(&mut command);
    command
}

/// A program of one of rustup's toolchains, to be completed.
pub fn rustup(toolchain: &str, program: &str) -> Command {
    let mut command = Command::new("rustup");
    command.args(["run", toolchain, program]);
    clear(&mut command);
    command
}

/// Rids a command of what `cargo run` and rustup's shims left in the environment: library paths and
/// variables that lead back to the other compiler.
fn clear(command: &mut Command) {
    let left = "CARGO RUSTC RUSTDOC LD_LIBRARY_PATH RUSTUP_TOOLCHAIN RUST_RECURSION_COUNT";
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        let of_a_package = ["CARGO_PKG_", "CARGO_BIN_", "CARGO_MANIFEST_"];
        let is_foreign = of_a_package.iter().any(|prefix| text.starts_with(prefix))
            || left.split(' ').any(|word| word == text);
        if is_foreign {
            command.env_remove(&name);
        }
    }
}

/// Whether the compiler that runs xtask has a core for the target.
pub fn native_has_target() -> bool {
    native_has(TARGET)
}

/// Whether it has one for another target.
pub fn native_has(target: &str) -> bool {
    let mut rustc = native_rustc();
    let dir = shell::capture(rustc.args(["--print", "target-libdir", "--target", target]));
    dir.is_ok_and(|dir| has_core(Path::new(dir.trim())))
}

/// Whether there is a precompiled core library in a directory.
pub fn has_core(dir: &Path) -> bool {
    let mut files = std::fs::read_dir(dir).into_iter().flatten().flatten();
    files.any(|file| file.file_name().to_string_lossy().starts_with("libcore-"))
}

/// The sources of the core library, below a compiler's root.
const SOURCES: &str = "lib/rustlib/src/rust/library/core/Cargo.toml";

/// Whether the sources of the core library are below a compiler's root.
pub fn has_sources(sysroot: &Path) -> bool {
    sysroot.join(SOURCES).is_file()
}

/// Why Debian's way does not work yet, if it does not.
pub fn debian_lacks() -> Option<String> {
    let files = [DEBIAN_RUSTC, DEBIAN_CARGO, DEBIAN_LINKER];
    if let Some(file) = files.into_iter().find(|file| !Path::new(file).is_file()) {
        return Some(format!("{file} is not there"));
    }
    let says = |arguments: &[&str]| shell::capture(debian(DEBIAN_RUSTC).args(arguments));
    let (version, sysroot) = match (says(&["--version"]), says(&["--print", "sysroot"])) {
        (Ok(version), Ok(sysroot)) => (version, sysroot),
        (Err(error), _) | (_, Err(error)) => return Some(error.to_string()),
    };
    let (version, sysroot) = (version.trim(), sysroot.trim());
    let oldest = env!("CARGO_PKG_RUST_VERSION");
    if release(version) < release(oldest) {
        return Some(format!("{DEBIAN_RUSTC} is {version}, older than {oldest}"));
    }
    (!has_sources(Path::new(sysroot))).then(|| format!("{sysroot}/{SOURCES} is not there"))
}

pub fn has_debian_clippy() -> bool {
    Path::new(DEBIAN_CLIPPY).is_file()
}

/// Fails with the reason if Debian's way does not work.
pub fn require_debian() -> Result<()> {
    let Some(why) = debian_lacks() else {
        return Ok(());
    };
    let packages = DEBIAN_PACKAGES.join(" ");
    bail!("Debian's packages {packages} are not enough: {why}");
}

/// Major and minor of the first version number in the text.
pub fn release(text: &str) -> (u32, u32) {
    let is_number = |word: &&str| word.starts_with(|c: char| c.is_ascii_digit());
    let number = text.split_whitespace().find(is_number);
    let mut parts = number.unwrap_or_default().split('.').map(str::parse);
    let mut part = || parts.next().and_then(|part| part.ok()).unwrap_or(0);
    (part(), part())
}

#[cfg(test)]
mod tests {
    use super::{SOURCES, recorded_paths, release};

    #[test]
    fn sources_of_core_change_no_path_in_the_firmware() {
        let sysroot = tempfile::Builder::new().prefix("o'b\"r, ").tempdir().expect("a folder");
        let version = "rustc 1.95.0\ncommit-hash: 5980\n";
        assert_eq!(recorded_paths(sysroot.path(), version), None);
        let manifest = sysroot.path().join(SOURCES);
        std::fs::create_dir_all(manifest.parent().expect("a folder")).expect("made");
        std::fs::write(manifest, "").expect("written");
        let setting = recorded_paths(sysroot.path(), version).expect("the sources are there");
        let root = sysroot.path().display();
        let flag = format!("--remap-path-prefix={root}/lib/rustlib/src/rust=/rustc/5980");
        let read: toml_edit::DocumentMut = setting.parse().expect("a setting");
        let flags = &read["target"]["thumbv7em-none-eabihf"]["rustflags"];
        assert_eq!(flags[0].as_str(), Some(&*flag));
    }

    #[test]
    fn a_release_is_read_from_what_programs_say_of_themselves() {
        assert_eq!(release("rustc 1.96.0 (ac68faa20 2026-05-25)"), (1, 96));
        assert_eq!(release("QEMU emulator version 7.2.22 (Debian 1:7.2)"), (7, 2));
        assert_eq!(release("1.95"), (1, 95));
    }
}
