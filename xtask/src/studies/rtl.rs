//! `cargo xtask rtl`: cycles that a core counts itself, simulated from its register-transfer
//! source. The results must have the same bits there, in QEMU and on the host.

mod page;
mod row;
pub mod simulator;

use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use serde::Serialize;

use crate::kit::error::{Error, Result, check};
use crate::kit::progress::Spinner;
use crate::kit::qemu::Qemu;
use crate::kit::shell;
use crate::kit::toolchain::{RELEASE, Toolchain};
use crate::kit::workspace::Workspace;
use crate::studies::cores::{CORES, Core, without_home};
use crate::studies::study::{Bench, Found};
use row::{Row, Said};
use simulator::{LATENCIES, Simulators};

const PACKAGE: &str = "gates";
/// The time limit of a program in QEMU.
const LIMIT: Duration = Duration::from_secs(300);
/// A sum of a product becomes one instruction, whose result is rounded once.
const CONTRACTED: &str = "-Cllvm-args=-fp-contract=fast";
/// A jump to an instruction across two words takes a cycle more: functions begin at words, so that a
/// change of one does not change another's cycles.
const AT_WORDS: &str = "-Cllvm-args=-align-all-functions=2";

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
    command.args(["--quiet", "--package", PACKAGE]);
    Said::read(&shell::capture(&mut command)?)
}

/// Builds the image with this flag of the compiler beside those of the core.
fn build(workspace: &Workspace, core: &Core, flag: &str) -> Result<PathBuf> {
    let mut flags: Vec<String> = core.flags.iter().map(ToString::to_string).collect();
    flags.extend([flag, AT_WORDS].iter().filter(|flag| !flag.is_empty()).map(ToString::to_string));
    // Paths from the workspace, since symbols, and with them the order of functions, follow flags.
    for script in [&*format!("machines/{}.x", core.machine), "link.x"] {
        flags.push(format!("-Clink-arg=-Tfirmware-demo/cores/{script}"));
    }
    flags.extend(without_home());
    let target = workspace.target.join(if flag.is_empty() { "gates/plain" } else { "gates/fused" });
    let mut command = workspace.cargo("build");
    command
        .args(["--profile", RELEASE, "--package", PACKAGE])
        .args(["--target", core.target, "--target-dir"])
        .arg(&target)
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
    shell::capture(&mut command)?;
    Ok(target.join(core.target).join(RELEASE).join(PACKAGE))
}
