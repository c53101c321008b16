//! The cores: which machine of QEMU has one, and how its firmware is built.

use std::path::{Path, PathBuf};

use xtask::kit::error::{Result, check};
use xtask::kit::qemu::Qemu;
use xtask::kit::setup::{self, Options};
use xtask::kit::workspace::Workspace;
use xtask::kit::{system, toolchain};

#[derive(Debug)]
pub struct Core {
    pub name: &'static str,
    /// The machine of QEMU, which names the memory map in `cores/machines/` too.
    pub machine: &'static str,
    pub target: &'static str,
    /// The flags of the compiler.
    pub flags: &'static [&'static str],
}

const NO_FLAGS: &[&str] = &[];
/// A jump by a table looks like a call through a pointer, whose stack is not bounded.
const NO_TABLES: &[&str] = &["-Cjump-tables=no"];

/// Those with a floating-point unit first.
#[rustfmt::skip]
pub static CORES: [Core; 4] = [
    Core { name: "Cortex-M33", machine: "mps2-an505", target: "thumbv8m.main-none-eabihf", flags: &["-Ctarget-cpu=cortex-m33"] },
    Core { name: "RV32 with F", machine: "virt", target: "riscv32imafc-unknown-none-elf", flags: NO_TABLES },
    Core { name: "Cortex-M3", machine: "mps2-an385", target: "thumbv7m-none-eabi", flags: NO_FLAGS },
    Core { name: "Cortex-M0", machine: "microbit", target: "thumbv6m-none-eabi", flags: NO_TABLES },
];

impl Core {
    pub fn is_risc_v(&self) -> bool {
        self.target.starts_with("riscv")
    }

    /// The emulator, and its package of Debian.
    pub fn qemu(&self) -> (&'static str, &'static str) {
        if self.is_risc_v() {
            return ("qemu-system-riscv32", "qemu-system-misc");
        }
        ("qemu-system-arm", system::QEMU)
    }

    /// The arguments that select the machine.
    pub fn machine_arguments(&self) -> Vec<&'static str> {
        let mut arguments = vec!["-machine", self.machine];
        if self.is_risc_v() {
            // A core without f64, and no firmware before ours.
            arguments.extend(["-cpu", "rv32,d=off", "-bios", "none"]);
        }
        arguments
    }

    /// The flags as a page shows them.
    pub fn shown_flags(&self) -> String {
        match self.flags {
            [] => "none".into(),
            flags => format!("`{}`", flags.join(" ")),
        }
    }
}

/// The one with a core of RISC-V.
pub fn risc_v() -> Result<&'static Core> {
    CORES.iter().find(|core| core.is_risc_v()).ok_or_else(|| check!("no core has RISC-V"))
}

/// Sets up the emulators of cores, and targets of Rust, theirs among them.
pub fn set_up(options: Options, cores: &[&Core], targets: &[&'static str]) -> Result<()> {
    let mut all = [&cores.iter().map(|core| core.target).collect::<Vec<_>>(), targets].concat();
    all.sort_unstable();
    all.dedup();
    all.retain(|target| !toolchain::native_has(target));
    let emulators = cores.iter().map(|core| core.qemu());
    let missing = emulators.filter(|(program, _)| Qemu::first(program).is_err());
    let packages: Vec<&str> = missing.map(|(_, package)| package).collect();
    setup::for_cores(options, &all, &packages)
}

/// The flags of the compiler that shorten paths of this workspace and of the registry, which the
/// messages of panics name: flash would depend on who builds, and where.
pub fn short_paths(workspace: &Workspace) -> Vec<String> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(std::env::home_dir()?.join(".cargo")));
    let shorter = |path: &Path, by| format!("--remap-path-prefix={}={by}", path.display());
    let home = home.map(|home| shorter(&home, "cargo"));
    [shorter(&workspace.root, "")].into_iter().chain(home).collect()
}
