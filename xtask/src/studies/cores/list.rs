//! The cores: which machine of QEMU has one, and how its firmware is built.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::kit::error::{Result, check};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{shell, system, toolchain};

/// The instructions that a core executes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// A Cortex-M4F, the one core whose cycles the meter models.
    CortexM4F,
    /// ARMv7-M, or ARMv8-M with the main extension.
    Thumb2,
    Armv6M,
    RiscV,
}

impl Isa {
    /// The argument of the cycle meter.
    pub fn argument(self) -> &'static str {
        match self {
            Self::CortexM4F => "",
            Self::Thumb2 => ",isa=thumb2",
            Self::Armv6M => ",isa=armv6m",
            Self::RiscV => ",isa=riscv",
        }
    }
}

#[derive(Debug)]
pub struct Core {
    pub name: &'static str,
    /// The machine of QEMU, which names the memory map in `cores/machines/` too.
    pub machine: &'static str,
    pub target: &'static str,
    /// The flags of the compiler; none of the first Cortex-M4F, whose flags are those of `.cargo/config.toml`.
    flags: &'static [&'static str],
    pub isa: Isa,
    /// Whether CI runs it.
    pub in_tests: bool,
}

const NO_FLAGS: &[&str] = &[];
/// A jump by a table looks like a call through a pointer, whose stack is not bounded.
const NO_TABLES: &[&str] = &["-Cjump-tables=no"];

/// The core of the cycle model first, then those with a floating-point unit.
#[rustfmt::skip]
pub const CORES: [Core; 8] = [
    Core { name: "Cortex-M4F", machine: "netduinoplus2", target: toolchain::TARGET, flags: NO_FLAGS, isa: Isa::CortexM4F, in_tests: false },
    // The line "qualifiable" of docs/flags.md.
    Core { name: "plain Cortex-M4F", machine: "netduinoplus2", target: toolchain::TARGET, flags: &["-Ctarget-cpu=cortex-m4"], isa: Isa::CortexM4F, in_tests: true },
    Core { name: "Cortex-M7", machine: "mps2-an500", target: toolchain::TARGET, flags: &["-Ctarget-cpu=cortex-m7"], isa: Isa::Thumb2, in_tests: false },
    Core { name: "Cortex-M33", machine: "mps2-an505", target: "thumbv8m.main-none-eabihf", flags: &["-Ctarget-cpu=cortex-m33"], isa: Isa::Thumb2, in_tests: true },
    Core { name: "Cortex-M55", machine: "mps3-an547", target: "thumbv8m.main-none-eabihf", flags: &["-Ctarget-cpu=cortex-m55", "-Ctarget-feature=-mve.fp"], isa: Isa::Thumb2, in_tests: false },
    Core { name: "RV32 with F", machine: "virt", target: "riscv32imafc-unknown-none-elf", flags: NO_TABLES, isa: Isa::RiscV, in_tests: true },
    Core { name: "Cortex-M3", machine: "mps2-an385", target: "thumbv7m-none-eabi", flags: NO_FLAGS, isa: Isa::Thumb2, in_tests: false },
    Core { name: "Cortex-M0", machine: "microbit", target: "thumbv6m-none-eabi", flags: NO_TABLES, isa: Isa::Armv6M, in_tests: false },
];

/// The prefix of linker flags: the scripts of `.cargo/config.toml` are for another start-up.
const LINKER: &str = "-Clink-arg=";

impl Core {
    /// The emulator, and its package of Debian.
    pub fn qemu(&self) -> (&'static str, &'static str) {
        match self.isa {
            Isa::RiscV => ("qemu-system-riscv32", "qemu-system-misc"),
            _ => ("qemu-system-arm", system::QEMU),
        }
    }

    /// The arguments that select the machine.
    pub fn machine_arguments(&self) -> Vec<&'static str> {
        let mut arguments = vec!["-machine", self.machine];
        if self.isa == Isa::RiscV {
            // A core without f64, and no firmware before ours.
            arguments.extend(["-cpu", "rv32,d=off", "-bios", "none"]);
        }
        arguments
    }

    /// The commands that install the missing parts.
    pub fn missing(&self) -> Vec<String> {
        let (program, package) = self.qemu();
        let mut commands = Vec::new();
        if shell::which(program).is_none() {
            commands.push(format!("apt-get install {package}    # {program}"));
        }
        if !toolchain::native_has(self.target) {
            commands.push(format!("rustup target add {}", self.target));
        }
        commands
    }

    /// The flags of the compiler, without those of the linker.
    ///
    /// # Errors
    /// `.cargo/config.toml` has no flags of the Cortex-M4F.
    pub fn flags(&self, workspace: &Workspace) -> Result<Vec<String>> {
        if self.isa == Isa::CortexM4F && self.flags.is_empty() {
            return flags_of_config(&workspace.root);
        }
        Ok(self.flags.iter().map(ToString::to_string).collect())
    }

    /// The flags as a page shows them.
    pub fn shown_flags(&self) -> String {
        match (self.isa, self.flags) {
            (Isa::CortexM4F, []) => "[decision 1](decisions/0001-cpu-flags.md)".into(),
            (_, []) => "none".into(),
            (_, flags) => format!("`{}`", flags.join(" ")),
        }
    }
}

/// The targets of Rust that some cores need, and the packages of Debian with their emulators.
pub fn needed(cores: &[&Core]) -> (Vec<&'static str>, Vec<&'static str>) {
    let targets = cores
        .iter()
        .filter(|core| !toolchain::native_has(core.target));
    let emulators = cores.iter().map(|core| core.qemu());
    let packages = emulators.filter(|(program, _)| shell::which(program).is_none());
    (
        targets.map(|core| core.target).collect(),
        packages.map(|(_, package)| package).collect(),
    )
}

/// The flag of the compiler that shortens paths of the registry, which the messages of panics name: flash would depend on
/// who builds.
pub fn without_home() -> Option<String> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(std::env::home_dir()?.join(".cargo")))?;
    Some(format!("--remap-path-prefix={}=cargo", home.display()))
}

/// The flags of the firmware's target.
fn flags_of_config(root: &Path) -> Result<Vec<String>> {
    let path = root.join(".cargo/config.toml");
    let lacks = || {
        check!(
            "{} has no rustflags of {}",
            path.display(),
            toolchain::TARGET
        )
    };
    let config: Value = toml_edit::de::from_str(&workspace::read(&path)?)
        .map_err(|e| check!("{}: {e}", path.display()))?;
    let flags = config
        .get("target")
        .and_then(|t| t.get(toolchain::TARGET)?.get("rustflags"));
    let flags = flags.and_then(Value::as_array).ok_or_else(lacks)?;
    let flags = flags.iter().filter_map(Value::as_str);
    let flags: Vec<String> = flags
        .filter(|flag| !flag.starts_with(LINKER))
        .map(str::to_owned)
        .collect();
    (!flags.is_empty()).then_some(flags).ok_or_else(lacks)
}

#[cfg(test)]
mod tests {
    use super::{CORES, Isa, flags_of_config};
    use crate::kit::docs::repository;

    #[test]
    fn the_firmware_is_built_with_the_flags_of_the_decision() {
        let flags = flags_of_config(&repository::root()).expect("flags");
        assert!(
            flags.iter().any(|flag| flag == "-Ctarget-cpu=cortex-m55"),
            "{flags:?}"
        );
        assert!(
            flags.iter().all(|flag| !flag.contains("link-arg")),
            "{flags:?}"
        );
    }

    #[test]
    fn every_machine_has_a_memory_map() {
        for core in CORES {
            let map = repository::root().join(format!("cores/machines/{}.x", core.machine));
            assert!(map.is_file(), "{}", map.display());
        }
        assert_eq!(CORES[0].isa, Isa::CortexM4F);
    }
}
