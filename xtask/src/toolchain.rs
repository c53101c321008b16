//! The two ways to a compiler for the target: the one that runs xtask, with the target's
//! core added by rustup, or Debian's own, which builds core from Debian's sources.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::ValueEnum;

use crate::error::{Error, Result};
use crate::shell;
use crate::workspace::{FIRMWARE, Workspace};

/// The target of the firmware.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// The profile of what is measured, and the same at opt-level s.
pub const RELEASE: &str = "release";
pub const SMALL: &str = "small";
pub const TINY: &str = "tiny";

/// What Debian's way needs.
pub const DEBIAN_PACKAGES: &[&str] = &["rustc-web", "cargo-web", "rust-web-src", "lld"];

const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";
const DEBIAN_CLIPPY: &str = "/usr/bin/cargo-clippy";
const DEBIAN_LINKER: &str = "/usr/bin/ld.lld";

/// Which way the user asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Choice {
    /// The first that works.
    #[default]
    Auto,
    /// The compiler that runs xtask, with a precompiled core.
    Rustup,
    /// Debian's compiler and sources.
    Debian,
}

/// A compiler that can build the firmware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toolchain {
    /// The compiler that runs xtask.
    Native,
    /// Debian's.
    Debian,
}

impl Toolchain {
    /// `cargo SUBCOMMAND … --package firmware-demo --target …`, to be completed.
    pub fn firmware(self, workspace: &Workspace, subcommand: &str) -> Command {
        let mut command = match self {
            Self::Native => workspace.cargo(subcommand),
            Self::Debian => {
                // Cargo would find rustup's `cargo-clippy` first.
                let mut command = match subcommand {
                    "clippy" => debian(DEBIAN_CLIPPY),
                    _ => debian(DEBIAN_CARGO),
                };
                command
                    .arg(subcommand)
                    .arg("-Zbuild-std=core")
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
        command.args(["--package", FIRMWARE, "--target", TARGET]);
        command
    }

    /// Where this compiler's artefacts go: two compilers in one directory would rebuild
    /// everything at each change of hands.
    fn target_dir(self, workspace: &Workspace) -> PathBuf {
        match self {
            Self::Native => workspace.target.clone(),
            Self::Debian => workspace.target.join("debian"),
        }
    }

    /// The ELF of a bin of the firmware in a profile.
    pub fn elf(self, workspace: &Workspace, profile: &str, bin: &str) -> PathBuf {
        self.target_dir(workspace)
            .join(TARGET)
            .join(profile)
            .join(bin)
    }

    /// `rustc --version`.
    pub fn rustc_version(self) -> Result<String> {
        let mut command = match self {
            Self::Native => native_rustc(),
            Self::Debian => debian(DEBIAN_RUSTC),
        };
        Ok(shell::capture(command.arg("--version"))?.trim().to_owned())
    }
}

fn native_rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// A command of Debian's toolchain, rid of what `cargo run` and rustup's shims left in the
/// environment: library paths and variables that lead back to the other compiler.
fn debian(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        let foreign = ["RUSTUP_", "CARGO_PKG_", "CARGO_BIN_", "CARGO_MANIFEST_"]
            .iter()
            .any(|prefix| text.starts_with(prefix))
            || ["CARGO", "RUSTC", "RUSTDOC", "LD_LIBRARY_PATH"].contains(&&*text);
        if foreign {
            command.env_remove(&name);
        }
    }
    command
}

/// Whether the compiler that runs xtask has a core for the target.
pub fn native_has_target() -> bool {
    shell::capture(native_rustc().args(["--print", "target-libdir", "--target", TARGET]))
        .is_ok_and(|dir| has_core(Path::new(dir.trim())))
}

/// Whether there is a precompiled core library in a directory.
pub fn has_core(dir: &Path) -> bool {
    std::fs::read_dir(dir).is_ok_and(|entries| {
        entries
            .flatten()
            .any(|entry| entry.file_name().to_string_lossy().starts_with("libcore-"))
    })
}

/// Why Debian's way does not work yet, if it does not.
pub fn debian_lacks() -> Option<String> {
    for file in [DEBIAN_RUSTC, DEBIAN_CARGO, DEBIAN_LINKER] {
        if !Path::new(file).is_file() {
            return Some(format!("{file} is not there"));
        }
    }
    let asked = |argument: &[&str]| {
        shell::capture(debian(DEBIAN_RUSTC).args(argument)).map(|out| out.trim().to_owned())
    };
    let version = match asked(&["--version"]) {
        Ok(version) => version,
        Err(error) => return Some(error.to_string()),
    };
    let oldest = env!("CARGO_PKG_RUST_VERSION");
    if release(&version) < release(oldest) {
        return Some(format!("{DEBIAN_RUSTC} is {version}, older than {oldest}"));
    }
    let core = "lib/rustlib/src/rust/library/core/Cargo.toml";
    match asked(&["--print", "sysroot"]) {
        Ok(sysroot) if Path::new(&sysroot).join(core).is_file() => None,
        Ok(sysroot) => Some(format!("{sysroot}/{core} is not there")),
        Err(error) => Some(error.to_string()),
    }
}

/// Whether Debian's clippy is there.
pub fn has_debian_clippy() -> bool {
    Path::new(DEBIAN_CLIPPY).is_file()
}

/// Fails with the reason if Debian's way does not work.
pub fn require_debian() -> Result<()> {
    debian_lacks().map_or(Ok(()), |why| {
        Err(Error::check(format!(
            "Debian's packages {} are not enough: {why}",
            DEBIAN_PACKAGES.join(" ")
        )))
    })
}

/// Major and minor of the first version number in the text.
pub fn release(text: &str) -> (u32, u32) {
    let number = text
        .split_whitespace()
        .find(|word| word.starts_with(|c: char| c.is_ascii_digit()))
        .unwrap_or_default();
    let mut parts = number.split('.').map(|part| part.parse().unwrap_or(0));
    (parts.next().unwrap_or(0), parts.next().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::release;

    #[test]
    fn a_release_is_read_from_what_programs_say_of_themselves() {
        assert_eq!(release("rustc 1.96.0 (ac68faa20 2026-05-25)"), (1, 96));
        assert_eq!(
            release("QEMU emulator version 7.2.22 (Debian 1:7.2)"),
            (7, 2)
        );
        assert_eq!(release("1.95"), (1, 95));
    }
}
