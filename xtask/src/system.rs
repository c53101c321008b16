//! The system underneath, and what installs software on it.

use std::process::Command;
use std::sync::{Mutex, PoisonError};

use crate::error::Result;
use crate::output;
use crate::shell;

/// Debian's package of the emulator.
pub const QEMU: &str = "qemu-system-arm";

/// What installs QEMU here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Debian and what descends from it.
    Debian,
    /// Fedora and its relatives.
    Fedora,
    /// Arch Linux.
    Arch,
    /// openSUSE.
    Suse,
    /// macOS with Homebrew.
    MacOs,
    /// Windows.
    Windows,
    /// Anything else.
    Other,
}

/// Each system, the words of `/etc/os-release` that it goes by, and what gets the user a QEMU there; Debian's is
/// installed by [`apt_install`].
#[rustfmt::skip]
const SYSTEMS: [(System, &[&str], &str); 7] = [
    (System::Debian, &["debian"], ""),
    (System::Fedora, &["fedora", "rhel"], "sudo dnf install -y qemu-system-arm-core"),
    (System::Arch, &["arch"], "sudo pacman -S --needed qemu-system-arm"),
    (System::Suse, &["suse", "opensuse"], "sudo zypper install -y qemu-arm"),
    (System::MacOs, &[], "brew install qemu"),
    (System::Windows, &[], "winget install SoftwareFreedomConservancy.QEMU    # and put qemu-system-arm on the PATH"),
    (System::Other, &[], "# install QEMU's `qemu-system-arm` with your system's package manager"),
];

impl System {
    /// The system that xtask runs on.
    pub fn this() -> Self {
        match std::env::consts::OS {
            "macos" => Self::MacOs,
            "windows" => Self::Windows,
            _ => std::fs::read_to_string("/etc/os-release")
                .map_or(Self::Other, |text| Self::from_os_release(&text)),
        }
    }

    /// From the `ID` and `ID_LIKE` of `/etc/os-release`.
    fn from_os_release(text: &str) -> Self {
        let value = |line| str::strip_prefix(line, "ID=").or_else(|| line.strip_prefix("ID_LIKE="));
        let values = text.lines().filter_map(value);
        let ids = values.flat_map(|value| value.trim_matches(['"', '\'']).split_whitespace());
        let known = |id: &str| SYSTEMS.iter().find(|(_, ids, _)| ids.contains(&id));
        let mut systems = ids.filter_map(known).map(|row| row.0);
        systems.next().unwrap_or(Self::Other)
    }

    /// What the user has to do to get a QEMU, where xtask does not install it itself.
    pub fn qemu_command(self) -> &'static str {
        let mut rows = SYSTEMS.iter();
        rows.find(|row| row.0 == self).map_or("", |row| row.2)
    }
}

/// How packages are installed as this user: directly, or through sudo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Privilege {
    /// Already root.
    Root,
    /// Through sudo.
    Sudo,
    /// Neither root nor sudo.
    None,
}

impl Privilege {
    /// This user's. It runs no sudo: that is for the user to allow.
    pub fn this() -> Self {
        let uid = shell::capture(Command::new("id").arg("-u")).unwrap_or_default();
        match shell::which("sudo") {
            _ if uid.trim() == "0" => Self::Root,
            None => Self::None,
            Some(_) => Self::Sudo,
        }
    }

    /// Whether packages can be installed without a password being typed, which is tried.
    pub fn needs_no_password(self) -> bool {
        match self {
            Self::Root => true,
            Self::Sudo => shell::succeeds(Command::new("sudo").args(["-n", "true"])),
            Self::None => false,
        }
    }

    fn apt_get(self) -> Command {
        let through: &[&str] = if self == Self::Sudo { &["sudo"] } else { &[] };
        let words = [through, &["apt-get"]].concat();
        let mut command = Command::new(words[0]);
        command.args(&words[1..]);
        command
    }
}

fn apt_commands(privilege: Privilege, packages: &[&str]) -> [Command; 2] {
    let (mut update, mut install) = (privilege.apt_get(), privilege.apt_get());
    update.arg("update");
    install.args(["install", "--no-install-recommends", "-y"]);
    install.args(packages);
    install.env("DEBIAN_FRONTEND", "noninteractive");
    [update, install]
}

/// The commands that install Debian packages as this user, to be shown.
pub fn apt_lines(packages: &[&str]) -> Vec<String> {
    let privilege = Privilege::this();
    let commands = apt_commands(privilege, packages);
    let lines = commands.iter().map(shell::display);
    // Without root and sudo the reader has to become root in a way of their own.
    let is_lost = privilege == Privilege::None;
    let hint = is_lost.then(|| "# as root: there is no sudo here".to_owned());
    hint.into_iter().chain(lines).collect()
}

/// What makes apt-get wait for another process that installs packages, which it otherwise refuses to do.
const WAITS: [&str; 2] = ["-o", "DPkg::Lock::Timeout=600"];
/// Two steps of the tests may need packages at once; the lock of the package lists has no such option.
static INSTALLING: Mutex<()> = Mutex::new(());

/// Installs Debian packages.
pub fn apt_install(packages: &[&str]) -> Result<()> {
    let _alone = INSTALLING.lock().unwrap_or_else(PoisonError::into_inner);
    let privilege = Privilege::this();
    let [mut update, mut install] = apt_commands(privilege, packages);
    let run = match privilege {
        Privilege::Sudo => shell::run_with_questions,
        Privilege::Root | Privilege::None => shell::run,
    };
    // An index that cannot be refreshed may still do: what counts is the installation.
    if let Err(error) = run(&mut update) {
        output::note(&format!(
            "warning: {error}; trying with the package index as it is"
        ));
    }
    run(install.args(WAITS))
}

/// Whether apt knows a package of this name (derivatives of Debian lack some).
pub fn apt_knows(package: &str) -> bool {
    shell::succeeds(Command::new("apt-cache").args(["show", "--quiet", package]))
}

#[cfg(test)]
mod tests {
    use super::System;

    #[test]
    fn every_system_has_instructions_to_install_qemu() {
        for system in [
            System::Fedora,
            System::Arch,
            System::Suse,
            System::MacOs,
            System::Windows,
            System::Other,
        ] {
            assert!(system.qemu_command().contains("qemu"), "{system:?}");
        }
    }

    #[test]
    fn derivatives_are_recognised_by_what_they_are_like() {
        for (text, system) in [
            ("ID=debian\n", System::Debian),
            ("ID=ubuntu\nID_LIKE=debian\n", System::Debian),
            (
                "NAME=\"Rocky\"\nID=\"rocky\"\nID_LIKE=\"rhel centos fedora\"\n",
                System::Fedora,
            ),
            ("ID=nixos\n", System::Other),
        ] {
            assert_eq!(System::from_os_release(text), system, "{text}");
        }
    }
}
