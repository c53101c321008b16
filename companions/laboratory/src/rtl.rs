//! Cycles that a core counts itself, simulated from its register-transfer source. The results must have the same bits there, in QEMU and on the host.

mod page;
pub mod row;
pub mod simulator;

use std::path::PathBuf;
use std::process::Command;
use std::thread;
use std::time::Duration;

use xtask::kit::error::{Result, check};
use xtask::kit::progress::Spinner;
use xtask::kit::qemu::Qemu;
use xtask::kit::shell;
use xtask::kit::toolchain::RELEASE;
use xtask::kit::workspace::Workspace;
use xtask::studies::study::Bench;

use crate::MANIFEST;
use crate::cores::{Core, risc_v, set_up, short_paths};
use crate::page::Part;
use row::{Row, Said, Worst};
use simulator::{LATENCIES, Simulators};

const PAGE: &str = "companions/laboratory/docs/rtl.md";
const PACKAGE: &str = "gates";
/// The time limit of a program in QEMU.
const LIMIT: Duration = Duration::from_secs(300);
/// The instructions of a core in order, such as this one, whose compiler knows none of one or two
/// stages: results are used late, after the allocation of registers too. Before it the order of the
/// source is a good one, which a bound on registers and pairs of loads would change. Constants that
/// take more than one instruction are loaded, by one if they lie near the global pointer.
pub const SCHEDULE: [&str; 7] = [
    "-Ctarget-cpu=rocket-rv32",
    "-Cllvm-args=-misched-cluster=false",
    "-Cllvm-args=-misched-regpressure=false",
    "-Cllvm-args=-enable-post-misched=true",
    "-Cllvm-args=-riscv-lower-fpimm-cost=1",
    "-Ctarget-feature=+relax",
    "-Clink-arg=--relax-gp",
];
/// A product and the sum that takes it become one instruction, whose result is rounded once.
pub const FUSED: &str = "-Cllvm-args=-fp-contract=fast";
/// A jump to an instruction across two words takes a cycle more: functions begin at words, so that a
/// change of one does not change another's cycles.
const AT_WORDS: &str = "-Cllvm-args=-align-all-functions=2";

/// How an image is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Build {
    Scheduled,
    /// Scheduled, with fused arithmetic.
    Fused,
}

const BUILDS: [Build; 2] = [Build::Scheduled, Build::Fused];

pub struct Report {
    rows: Vec<Row>,
    errors: Vec<Worst>,
}

/// Builds the simulators beside the images, runs these, and compares what they print.
///
/// # Errors
/// Among others, a digest differs.
pub fn measure(bench: &Bench<'_>) -> Result<Vec<Part>> {
    let (workspace, options) = (bench.workspace, bench.options);
    let core = risc_v()?;
    set_up(options, &[core], &[])?;
    let simulators = Simulators::find(workspace, options)?;
    let (made, host, images) = thread::scope(|scope| {
        let _spinner = Spinner::start("compiling the core's source by Verilator, and the images");
        let images = BUILDS.map(|build| scope.spawn(move || build.image(workspace, core)));
        let host = scope.spawn(|| on_host(workspace));
        (simulators.make(), joined(host), images.map(joined))
    });
    made?;
    let host = host?;
    let (mut rows, mut errors) = (Vec::new(), Vec::new());
    for (build, elf) in BUILDS.into_iter().zip(images) {
        let elf = elf?;
        let text =
            Qemu::first(core.qemu().0)?.text(PACKAGE, &core.machine_arguments(), &elf, LIMIT)?;
        let emulated = Said::read(&text)?;
        if build != Build::Fused {
            row::same_bits("QEMU's RV32", &emulated, "the host", &host)?;
        }
        let counted = simulators.run_all(&elf)?;
        let counted: Vec<Said> =
            counted.iter().map(|text| Said::read(text)).collect::<Result<_>>()?;
        for (latency, said) in LATENCIES.iter().zip(&counted) {
            let name = format!("the core with an FPU of {latency} stages");
            row::same_bits(&name, said, "QEMU's RV32", &emulated)?;
        }
        rows.extend(row::joined(&counted, build)?);
        errors.extend(row::worst(&emulated, &host, build)?);
    }
    let report = Report { rows, errors };
    let [algorithms, ticks] = report.tables();
    let part = |name, text| Part { file: PAGE, name, text };
    Ok(vec![part("algorithms", algorithms), part("ticks", ticks), part("errors", report.errors()?)])
}

/// What a thread returned.
fn joined<T>(thread: thread::ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().map_err(|_| check!("a thread of `rtl` panicked"))?
}

fn on_host(workspace: &Workspace) -> Result<Said> {
    let mut command = workspace.cargo("run");
    command.args(["--quiet", "--manifest-path", MANIFEST, "--package", PACKAGE]);
    command.arg("--target-dir").arg(&workspace.target);
    Said::read(&shell::capture(&mut command)?)
}

impl Build {
    /// The image.
    pub fn image(self, workspace: &Workspace, core: &Core) -> Result<PathBuf> {
        let (mut command, folder) = self.cargo("build", workspace, core);
        command.args(["--bin", PACKAGE]);
        shell::capture(&mut command)?;
        Ok(folder.join(PACKAGE))
    }

    /// A command of cargo for the package, and the folder of its images.
    pub fn cargo(self, verb: &str, workspace: &Workspace, core: &Core) -> (Command, PathBuf) {
        let mut flags: Vec<String> = core.flags.iter().map(ToString::to_string).collect();
        flags.push(AT_WORDS.to_owned());
        flags.extend(SCHEDULE.map(str::to_owned));
        flags.extend((self == Self::Fused).then(|| FUSED.to_owned()));
        // Paths from the workspace: symbols follow flags, and the order of functions these.
        for script in [&*format!("machines/{}.x", core.machine), "link.x"] {
            flags.push(format!("-Clink-arg=-Tcores/{script}"));
        }
        flags.extend(short_paths(workspace));
        let target = workspace.target.join(format!("gates/{self:?}").to_lowercase());
        let mut command = workspace.cargo(verb);
        command
            .args(["--quiet", "--manifest-path", MANIFEST, "--profile", RELEASE])
            .args(["--package", PACKAGE, "--target", core.target])
            .arg("--target-dir")
            .arg(&target)
            .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
        (command, target.join(core.target).join(RELEASE))
    }
}
