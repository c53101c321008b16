//! Builds what runs in QEMU, and the plugin that watches it.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::kit::error::{Error, Result};
use crate::kit::shell;
use crate::kit::toolchain::{RELEASE, Toolchain};
use crate::kit::workspace::Workspace;

/// Builds a bin of the firmware and returns its ELF. Here and below, what cargo says is shown only
/// if it fails.
pub fn build(workspace: &Workspace, toolchain: Toolchain, bin: &str) -> Result<PathBuf> {
    build_bins(workspace, toolchain, RELEASE, &[bin]).map(|mut elves| elves.remove(0))
}

/// Builds some bins side by side in a profile and returns their ELFs.
pub fn build_bins(
    workspace: &Workspace,
    toolchain: Toolchain,
    profile: &str,
    bins: &[&str],
) -> Result<Vec<PathBuf>> {
    build_with(workspace, toolchain, profile, "", bins, None)
}

/// The same of bins that are built for features only, with a variable of the environment that names
/// a file which they include.
pub fn build_with(
    workspace: &Workspace,
    toolchain: Toolchain,
    profile: &str,
    features: &str,
    bins: &[&str],
    included: Option<(&str, &Path)>,
) -> Result<Vec<PathBuf>> {
    let mut command = toolchain.firmware(workspace, "build");
    command.args(["--profile", profile, "--features", features]);
    command.args(bins.iter().flat_map(|bin| ["--bin", bin]));
    command.envs(included);
    shell::capture(&mut command)?;
    bins.iter().map(|bin| existing(toolchain.elf(workspace, profile, bin))).collect()
}

/// The feature of the bins for robots from files.
pub const OWN_ROBOTS: &str = "own-robots";

/// The environment variable that names the file which the bins include, and its value.
pub fn variable(included: &Path) -> (&'static str, &Path) {
    ("OWN_ROBOT", included)
}

/// Builds bins of the firmware with these features for the robots of a file that they include, and
/// returns their ELFs.
pub fn build_own(
    workspace: &Workspace,
    toolchain: Toolchain,
    included: &Path,
    features: &str,
    bins: &[&str],
) -> Result<Vec<PathBuf>> {
    let included = Some(variable(included));
    build_with(workspace, toolchain, RELEASE, features, bins, included)
}

/// Builds every bin of the firmware.
pub fn build_all(workspace: &Workspace, toolchain: Toolchain) -> Result<()> {
    let mut command = toolchain.firmware(workspace, "build");
    shell::capture(command.args(["--release", "--bins"]))?;
    Ok(())
}

/// Set by the first call.
static METER: OnceLock<PathBuf> = OnceLock::new();

/// Builds the cycle meter and returns the shared library: in the folder of this program, whose
/// dependencies are there. Cargo is asked once, since it may have to wait for other builds.
pub fn build_meter(workspace: &Workspace) -> Result<PathBuf> {
    if let Some(meter) = METER.get() {
        return Ok(meter.clone());
    }
    let mut command = workspace.cargo("build");
    shell::capture(command.args(["--package", "cycle-meter"]))?;
    use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
    let library = format!("debug/{DLL_PREFIX}cycle_meter{DLL_SUFFIX}");
    let meter = existing(workspace.target.join(library))?;
    Ok(METER.get_or_init(|| meter).clone())
}

fn existing(path: PathBuf) -> Result<PathBuf> {
    std::fs::metadata(&path).map_err(Error::file("find", &path))?;
    Ok(path)
}
