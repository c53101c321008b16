//! Debian packages: installed by apt-get, which removes none of the user's; one that conflicts with
//! an installed one is unpacked in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use crate::kit::error::{Error, Result, refuse_if};
use crate::kit::system::Privilege;
use crate::kit::{output, shell};

/// Packages of which an unpacked copy works without the scripts of an installation.
const UNPACKABLE: &str = "qemu-system-";

/// Makes apt-get wait for another process that installs packages, which it otherwise refuses to do.
const WAITS: [&str; 2] = ["-o", "DPkg::Lock::Timeout=600"];
/// Two steps of the tests may need packages at once; the lock of the package lists has no such
/// option.
static INSTALLING: Mutex<()> = Mutex::new(());

/// The environment variable that replaces the folder of unpacked packages.
const FOLDER: &str = "XTASK_PROGRAMS";

/// The folder of unpacked packages, in cargo's target directory, where xtask lies too.
fn folder() -> Option<PathBuf> {
    let named = std::env::var_os(FOLDER).map(PathBuf::from);
    named.or_else(|| {
        let xtask = std::env::current_exe().ok()?;
        Some(xtask.parent()?.parent()?.join("programs"))
    })
}

/// The folder in which a program of an unpacked package lies, if the user's own PATH has none of
/// its name.
pub fn unpacked(program: &str) -> Option<PathBuf> {
    let folder = folder()?.join("usr/bin");
    let found = shell::which(program)?;
    found.starts_with(&folder).then_some(folder)
}

/// Puts the programs of unpacked packages on the PATH, behind the user's own.
pub fn extend_path() {
    let Some(folder) = folder() else { return };
    let path = std::env::var_os("PATH").unwrap_or_default();
    let places = std::env::split_paths(&path).chain([folder.join("usr/bin")]);
    if let Ok(path) = std::env::join_paths(places) {
        // SAFETY: `main` calls this before anything else, so that there is one thread.
        unsafe { std::env::set_var("PATH", path) };
    }
}

fn install_command(privilege: Privilege, packages: &[impl AsRef<str>]) -> Command {
    let mut install = privilege.apt_get();
    install.args(["install", "--no-install-recommends", "--no-remove", "-y"]);
    install.args(packages.iter().map(AsRef::as_ref));
    install.env("DEBIAN_FRONTEND", "noninteractive");
    install
}

fn update_command(privilege: Privilege) -> Command {
    let mut update = privilege.apt_get();
    update.arg("update");
    update
}

/// The commands that install Debian packages as this user, to be shown.
pub fn lines(packages: &[&str]) -> Vec<String> {
    let privilege = Privilege::this();
    let commands = [
        update_command(privilege),
        install_command(privilege, packages),
    ];
    let lines = commands.iter().map(shell::display);
    // Without root and sudo the reader has to become root in a way of their own.
    let is_lost = privilege == Privilege::None;
    let hint = is_lost.then(|| "# as root: there is no sudo here".to_owned());
    hint.into_iter().chain(lines).collect()
}

/// The changes that apt-get would make to install some packages.
#[derive(Debug, Default, PartialEq)]
struct Changes {
    installed: Vec<String>,
    removed: Vec<String>,
}

impl Changes {
    /// From what `apt-get install --simulate` prints.
    fn parse(simulation: &str) -> Self {
        let packages = |verb: &str| {
            let lines = simulation.lines();
            let rest = lines.filter_map(|line| line.strip_prefix(verb));
            rest.filter_map(|rest| rest.split_whitespace().next().map(str::to_owned))
                .collect()
        };
        Self {
            installed: packages("Inst "),
            removed: packages("Remv "),
        }
    }

    /// Simulates the installation of these packages, which needs no privilege.
    fn of(packages: &[impl AsRef<str>]) -> Result<Self> {
        let mut simulation = Command::new("apt-get");
        simulation.args(["install", "--simulate", "--no-install-recommends"]);
        simulation.args(packages.iter().map(AsRef::as_ref));
        shell::capture(&mut simulation).map(|text| Self::parse(&text))
    }
}

/// Installs Debian packages. None that the user has is removed: a package that conflicts with one
/// of them is unpacked in the folder of [`extend_path`], beside the packages that it depends on,
/// which are installed.
///
/// # Errors
/// apt-get fails, or a package that would remove another needs to be installed to work.
pub fn install(packages: &[&str]) -> Result<()> {
    let _alone = INSTALLING.lock().unwrap_or_else(PoisonError::into_inner);
    let privilege = Privilege::this();
    let run = match privilege {
        Privilege::Sudo => shell::run_with_questions,
        Privilege::Root | Privilege::None => shell::run,
    };
    // An index that cannot be refreshed may still do: what counts is the installation.
    if let Err(error) = run(&mut update_command(privilege)) {
        output::note(&format!(
            "warning: {error}; trying with the package index as it is"
        ));
    }
    let changes = Changes::of(packages)?;
    if changes.removed.is_empty() {
        return run(install_command(privilege, packages).args(WAITS));
    }
    let removed = changes.removed.join(", ");
    // One simulation for all that cannot be unpacked: each takes two seconds.
    let (candidates, mut others): (Vec<_>, Vec<_>) = changes
        .installed
        .into_iter()
        .partition(|package| package.starts_with(UNPACKABLE));
    refuse_if!(
        !others.is_empty() && !Changes::of(&others)?.removed.is_empty(),
        "to install {} apt-get would remove {removed}, which is yours: nothing was installed",
        packages.join(" "),
    );
    let mut conflicting = Vec::new();
    for package in candidates {
        let conflicts = !Changes::of(&[&package])?.removed.is_empty();
        let list = if conflicts {
            &mut conflicting
        } else {
            &mut others
        };
        list.push(package);
    }
    let Some(folder) = folder() else {
        return Err(Error::Check(format!("no folder to unpack {conflicting:?}")));
    };
    output::note(&format!(
        "{} cannot be installed beside {removed}, which stays: unpacked in {} instead",
        conflicting.join(", "),
        folder.display(),
    ));
    if !others.is_empty() {
        run(install_command(privilege, &others).args(WAITS))?;
    }
    unpack(&folder, &folder.join("archives"), &conflicting, &[])
}

/// Downloads packages into a folder and unpacks them in another, without installing them. The
/// options are apt-get's.
///
/// # Errors
/// A package cannot be downloaded or unpacked.
pub fn unpack(root: &Path, archives: &Path, packages: &[String], options: &[String]) -> Result<()> {
    // QEMU would load the modules of an installed one, and end, without a folder for its own.
    let modules = root.join(format!("usr/lib/{}-linux-gnu/qemu", std::env::consts::ARCH));
    for folder in [archives, &modules] {
        std::fs::create_dir_all(folder).map_err(Error::file("create", folder))?;
    }
    let mut download = Command::new("apt-get");
    // Another user, as whom apt-get would download otherwise, may not write here.
    download.args(["-o", "APT::Sandbox::User=root"]);
    download.args(options).arg("download").args(packages);
    shell::capture(download.current_dir(archives))?;
    let files = std::fs::read_dir(archives).map_err(Error::file("read", archives))?;
    for file in files.flatten().map(|entry| entry.path()) {
        if file.extension().is_some_and(|ending| ending == "deb") {
            shell::capture(Command::new("dpkg").arg("-x").arg(&file).arg(root))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::Changes;

    #[test]
    fn a_simulation_names_what_would_be_removed() {
        let text = "Reading package lists...\nRemv qemu-utils [1:10.0.2]\n\
                    Inst qemu-system-arm (1:7.2 Debian:12 [amd64])\nConf qemu-system-arm (1:7.2)\n";
        let changes = Changes::parse(text);
        assert_eq!(changes.removed, ["qemu-utils"]);
        assert_eq!(changes.installed, ["qemu-system-arm"]);
        assert_eq!(Changes::parse("0 upgraded\n"), Changes::default());
    }
}
