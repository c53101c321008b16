//! Debian packages, installed by apt-get, which removes none of the user's.

use std::process::Command;
use std::sync::{Mutex, PoisonError};

use crate::kit::error::Result;
use crate::kit::system::Privilege;
use crate::kit::{output, shell};

/// Makes apt-get wait for another process that installs packages, which it otherwise refuses to do.
const WAITS: [&str; 2] = ["-o", "DPkg::Lock::Timeout=600"];
/// Two steps of the tests may need packages at once; the lock of the package lists has no such
/// option.
static INSTALLING: Mutex<()> = Mutex::new(());

fn install_command(privilege: Privilege, packages: &[&str]) -> Command {
    let mut install = privilege.apt_get();
    install.args(["install", "--no-install-recommends", "--no-remove", "-y"]);
    install.args(packages);
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
    let commands = [update_command(privilege), install_command(privilege, packages)];
    // Without root and sudo the reader has to become root in a way of their own.
    let hint =
        (privilege == Privilege::None).then(|| "# as root: there is no sudo here".to_owned());
    let lines = hint.into_iter().chain(commands.iter().map(shell::display));
    lines.filter(|_| !packages.is_empty()).collect()
}

/// Why the packages cannot be installed here, as far as it is known before it is tried; none cannot
/// fail.
pub fn refusal(packages: &[&str]) -> Option<String> {
    if packages.is_empty() {
        return None;
    }
    if Privilege::this() == Privilege::None {
        return Some("there is neither root nor sudo".to_owned());
    }
    // It changes nothing, and needs no root.
    let mut simulated = Command::new("apt-get");
    simulated.args(["-s", "install", "--no-install-recommends"]).args(packages);
    // An empty index tells nothing.
    let plan = shell::capture(&mut simulated).unwrap_or_default();
    let removed = plan.lines().filter_map(|line| line.strip_prefix("Remv ")?.split(' ').next());
    let removed = removed.collect::<Vec<_>>().join(" ");
    (!removed.is_empty()).then(|| format!("apt-get would remove {removed}"))
}

/// Installs Debian packages.
///
/// # Errors
/// apt-get fails, among others because a package that the user has would have to go.
pub fn install(packages: &[&str]) -> Result<()> {
    if packages.is_empty() {
        return Ok(());
    }
    let _alone = INSTALLING.lock().unwrap_or_else(PoisonError::into_inner);
    let privilege = Privilege::this();
    let run = match privilege {
        Privilege::Sudo => shell::run_with_questions,
        Privilege::Root | Privilege::None => shell::run,
    };
    // An index that cannot be refreshed may still do: what counts is the installation.
    if let Err(error) = run(&mut update_command(privilege)) {
        output::note(&format!("warning: {error}; trying with the package index as it is"));
    }
    run(install_command(privilege, packages).args(WAITS))
}
