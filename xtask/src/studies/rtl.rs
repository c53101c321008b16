//! `cargo xtask rtl`: cycles that a core counts itself, simulated from its register-transfer
//! source. The results must have the same bits there, in QEMU and on the host.

mod page;
mod row;
pub mod simulator;

use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use serde::Serialize;

use crate::kit::error::{Error, Result, check, refuse_if};
use crate::kit::progress::Spinner;
use crate::kit::qemu::Qemu;
use crate::kit::shell;
use crate::kit::toolchain::{RELEASE, Toolchain};
use crate::kit::workspace::{self, BOARDS, Workspace};
use crate::studies::cores::{CORES, Core, without_home};
use crate::studies::study::{Bench, Found};
use row::{Row, Said};
use simulator::{LATENCIES, Simulators};

const PACKAGE: &str = "gates";
/// The time limit of a program in QEMU.
const LIMIT: Duration = Duration::from_secs(300);
/// A sum of a product becomes one instruction, whose result is rounded once.
const CONTRACTED: &str = "-Cllvm-args=-fp-contract=fast";
/// A jump to an instruction across two words takes a cycle more. Functions begin at words, and
/// calls keep their length, so that the cycles depend less on the linker's order, which follows the
/// folder of the sources.
const WORDS: [&str; 2] = [".text ORIGIN(FLASH) :", ".text ORIGIN(FLASH) : SUBALIGN(4)"];
const CALLS: &str = "-Clink-arg=--no-relax";

#[derive(Serialize)]
pub struct Report {
    rows: Vec<Row>,
    rustc: String,
}

/// Builds the simulators beside the images, runs these, and compares what they print.
///
/// # Errors
/// Among others, a digest differs; or [`Error::Skipped`], if something is missing here that
/// may not be installed.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (workspace, options) = (bench.workspace, bench.options);
    let Some(core) = CORES.iter().find(|core| core.is_risc_v()) else {
        return Err(check!("no core has RISC-V"));
    };
    let simulators = Simulators::set_up(workspace, options);
    if let missing @ [_, ..] = &core.missing()[..] {
        return Err(Error::Skipped(format!("not installed: {}", missing.join(", "))));
    }
    let simulators = match simulators {
        Err(Error::Missing { commands }) => {
            return Err(Error::Skipped(format!("not installed: {}", commands.join(", "))));
        }
        simulators => simulators?,
    };
    let (images, host) = thread::scope(|scope| {
        let host = scope.spawn(|| on_host(workspace));
        let _spinner = Spinner::start("compiling the images");
        let images = ["", CONTRACTED].map(|flag| build(workspace, core, flag));
        (images, host.join())
    });
    let [plain, contracted] = images;
    let host = host.map_err(|_| check!("the run on the host panicked"))??;
    let mut rows = Vec::new();
    for (elf, is_contracted) in [(plain?, false), (contracted?, true)] {
        let text =
            Qemu::at(core.qemu().0)?.text(PACKAGE, &core.machine_arguments(), &elf, LIMIT)?;
        let emulated = Said::read(&text)?;
        if !is_contracted {
            row::same_bits("QEMU's RV32", &emulated, "the host", &host)?;
        }
        let counted: Vec<Said> = LATENCIES
            .iter()
            .map(|latency| Said::read(&simulators.run(*latency, &elf)?))
            .collect::<Result<_>>()?;
        for (latency, said) in LATENCIES.iter().zip(&counted) {
            let name = format!("the core with an FPU of {latency} stages");
            row::same_bits(&name, said, "QEMU's RV32", &emulated)?;
        }
        rows.extend(row::joined(&counted, is_contracted)?);
    }
    let report = Report { rows, rustc: Toolchain::Native.rustc_version()? };
    Ok(Found {
        picture: Some(page::svg(&report.rows)?),
        rustc: Some(report.rustc.clone()),
        summary: page::summary(&report.rows)?,
        ..Found::new(report.markdown()?, &report)?
    })
}

fn on_host(workspace: &Workspace) -> Result<Said> {
    let mut command = workspace.cargo("run");
    command.args(["--quiet", "--manifest-path", BOARDS, "--package", PACKAGE]);
    command.arg("--target-dir").arg(workspace.target.join("cores"));
    Said::read(&shell::capture(&mut command)?)
}

/// Builds the image with this flag of the compiler beside those of the core.
fn build(workspace: &Workspace, core: &Core, flag: &str) -> Result<PathBuf> {
    let mut flags: Vec<String> = core.flags.iter().map(ToString::to_string).collect();
    flags.extend((!flag.is_empty()).then(|| flag.to_owned()));
    let folder = workspace.root.join("firmware-demo/cores");
    let script = workspace::read(&folder.join("link.x"))?;
    refuse_if!(!script.contains(WORDS[0]), "link.x of `cores` has no {}", WORDS[0]);
    let placed = workspace.target.join("gates/link.x");
    workspace::write(&placed, script.replace(WORDS[0], WORDS[1]))?;
    for script in [folder.join(format!("machines/{}.x", core.machine)), placed] {
        flags.push(format!("-Clink-arg=-T{}", script.display()));
    }
    flags.push(CALLS.to_owned());
    flags.extend(without_home());
    let target = workspace.target.join(if flag.is_empty() { "gates/plain" } else { "gates/fused" });
    let mut command = workspace.cargo("build");
    command
        .args(["--manifest-path", BOARDS, "--profile", RELEASE, "--package", PACKAGE])
        .args(["--target", core.target, "--target-dir"])
        .arg(&target)
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
    shell::capture(&mut command)?;
    Ok(target.join(core.target).join(RELEASE).join(PACKAGE))
}
