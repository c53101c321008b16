//! The system underneath, and what installs software on it.

use std::process::Command;

use crate::error::Result;
use crate::output;
use crate::shell;

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
        let ids = text
            .lines()
            .filter_map(|line| {
                line.strip_prefix("ID=")
                    .or_else(|| line.strip_prefix("ID_LIKE="))
            })
            .flat_map(|value| value.trim_matches(['"', '\'']).split_whitespace());
        for id in ids {
            match id {
                "debian" => return Self::Debian,
                "fedora" | "rhel" => return Self::Fedora,
                "arch" => return Self::Arch,
                "suse" | "opensuse" => return Self::Suse,
                _ => {}
            }
        }
        Self::Other
    }

    /// What the user has to do to get a QEMU, where xtask does not install it itself.
    pub fn qemu_command(self) -> String {
        match self {
            Self::Debian => apt_lines(&["qemu-system-arm"]).join(" && "),
            Self::Fedora => "sudo dnf install -y qemu-system-arm-core".into(),
            Self::Suse => "sudo zypper install -y qemu-arm".into(),
            Self::Arch => "sudo pacman -S --needed qemu-system-arm".into(),
            Self::MacOs => "brew install qemu".into(),
            Self::Windows => {
                "winget install SoftwareFreedomConservancy.QEMU    # and put qemu-system-arm on the PATH".into()
            }
            Self::Other => {
                "# install QEMU's `qemu-system-arm` with your system's package manager".into()
            }
        }
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
        if uid.trim() == "0" {
            Self::Root
        } else if shell::which("sudo").is_none() {
            Self::None
        } else {
            Self::Sudo
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

    fn command(self, program: &str) -> Command {
        match self {
            Self::Root | Self::None => Command::new(program),
            Self::Sudo => {
                let mut command = Command::new("sudo");
                command.arg(program);
                command
            }
        }
    }
}

fn apt_commands(privilege: Privilege, packages: &[&str]) -> [Command; 2] {
    let mut update = privilege.command("apt-get");
    update.arg("update");
    let mut install = privilege.command("apt-get");
    install
        .args(["install", "--no-install-recommends", "-y"])
        .args(packages)
        .env("DEBIAN_FRONTEND", "noninteractive");
    [update, install]
}

/// The commands that install Debian packages as this user, to be shown.
pub fn apt_lines(packages: &[&str]) -> Vec<String> {
    let privilege = Privilege::this();
    let commands = apt_commands(privilege, packages);
    // Without root and sudo the reader has to become root in a way of their own.
    let hint =
        (privilege == Privilege::None).then(|| "# as root: there is no sudo here".to_owned());
    let lines = commands.iter().map(shell::display);
    hint.into_iter().chain(lines).collect()
}

/// Installs Debian packages.
pub fn apt_install(packages: &[&str]) -> Result<()> {
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
    run(&mut install)
}

/// Whether apt knows a package of this name (derivatives of Debian lack some).
pub fn apt_knows(package: &str) -> bool {
    shell::succeeds(Command::new("apt-cache").args(["show", "--quiet", package]))
}

#[cfg(test)]
mod tests {
    use super::System;

    #[test]
    fn every_system_is_told_how_it_gets_a_qemu() {
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
