//! The system underneath, and what installs software on it.

use std::process::Command;

use crate::kit::{qemu, shell};

/// Debian's package of the emulator.
pub const QEMU: &str = "qemu-system-arm";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Debian and what descends from it.
    Debian,
    Fedora,
    Arch,
    Suse,
    MacOs,
    Windows,
    Other,
}

/// Each system, the words of `/etc/os-release` that it goes by, and what gets the user a QEMU
/// there; Debian's is installed by [`apt`](crate::kit::apt).
#[rustfmt::skip]
const SYSTEMS: [(System, &[&str], &str); 7] = [
    (System::Debian, &["debian"], ""),
    (System::Fedora, &["fedora", "rhel"], "sudo dnf install -y qemu-system-arm-core"),
    (System::Arch, &["arch"], "sudo pacman -S --needed qemu-system-arm"),
    (System::Suse, &["suse", "opensuse"], "sudo zypper install -y qemu-arm"),
    (System::MacOs, &[], "brew install qemu"),
    (System::Windows, &[], "wsl --install -d Debian    # clone and run in it: the cycle meter, a \
        plugin of QEMU, is not for Windows"),
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

    /// What gets the user a QEMU where xtask does not, or another one than the system's.
    pub fn qemu_advice(self, has_one: bool) -> &'static str {
        if has_one && self != Self::Windows {
            return qemu::ANOTHER_QEMU;
        }
        SYSTEMS.iter().find(|row| row.0 == self).map_or("", |row| row.2)
    }
}

/// The privilege to install packages: as root, through sudo, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Privilege {
    Root,
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

    /// `apt-get` as this user, to be completed.
    pub fn apt_get(self) -> Command {
        let through: &[&str] = if self == Self::Sudo { &["sudo"] } else { &[] };
        let words = [through, &["apt-get"]].concat();
        let mut command = Command::new(words[0]);
        command.args(&words[1..]);
        command
    }
}

#[cfg(test)]
mod tests {
    use super::System;

    #[test]
    fn every_system_has_instructions_to_get_qemu() {
        for (system, words) in [
            (System::Fedora, "sudo dnf install -y qemu-system-arm-core"),
            (System::Arch, "sudo pacman -S --needed qemu-system-arm"),
            (System::Suse, "sudo zypper install -y qemu-arm"),
            (System::MacOs, "brew install qemu"),
            (System::Windows, "wsl --install -d Debian"),
            (System::Other, "`qemu-system-arm` with your system's package manager"),
        ] {
            assert!(system.qemu_advice(false).contains(words), "{system:?}");
            // To install what is there would not help where it has no plugins.
            let another = system.qemu_advice(true);
            let words = if system == System::Windows { words } else { "--enable-plugins" };
            assert!(another.contains(words) && another.lines().count() <= 5, "{system:?}");
        }
    }

    #[test]
    fn derivatives_are_recognised_by_what_they_are_like() {
        for (text, system) in [
            ("ID=debian\n", System::Debian),
            ("ID=ubuntu\nID_LIKE=debian\n", System::Debian),
            ("NAME=\"Rocky\"\nID=\"rocky\"\nID_LIKE=\"rhel centos fedora\"\n", System::Fedora),
            ("ID=nixos\n", System::Other),
        ] {
            assert_eq!(System::from_os_release(text), system, "{text}");
        }
    }
}
