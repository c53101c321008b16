//! The core as a program of this machine: its register-transfer source, by Verilator.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use xtask::kit::error::{Error, Result, bail};
use xtask::kit::qemu::Qemu;
use xtask::kit::setup::{self, Options, Plan};
use xtask::kit::shell;
use xtask::kit::workspace::{self, Workspace};

use super::joined;

/// The numbers of pipeline stages that the floating-point unit may have.
pub const LATENCIES: [usize; 3] = [0, 1, 2];
/// The cycles after which a program is taken for one that does not end.
const LIMIT: &str = "200000000";

/// Programs, and Debian's packages of them.
const PROGRAMS: [(&str, &str); 5] = [
    ("verilator", "verilator"),
    ("g++", "g++"),
    ("make", "make"),
    ("python3", "python3"),
    ("qemu-system-riscv32", "qemu-system-misc"),
];

/// What the source is silent about or its authors know: the pipelines of the FPU assign an array's
/// first element in another way than the others, which Verilator takes for one variable.
const SILENT: &str = "-Wno-lint -Wno-BLKANDNBLK -Wno-COMBDLY -Wno-UNOPTFLAT -Wno-WIDTHCONCAT";
const PINNED: &str = "companions/laboratory/gates/requirements.txt";
const BENCH: &str = "companions/laboratory/gates/bench.cpp";
/// What runs in each cycle is optimised as far as that takes less time than it saves.
const VERILATE: &str = "--cc --exe --build -O3 --x-assign fast -MAKEFLAGS OPT_FAST=-O1 -MAKEFLAGS \
    OPT_SLOW=-O0 -MAKEFLAGS OPT_GLOBAL=-O1 --top-module cv32e40p_top -GFPU=1 -o core";

/// The folder with the simulators, one for each latency.
pub struct Simulators<'a> {
    workspace: &'a Workspace,
    folder: PathBuf,
    source: PathBuf,
}

impl<'a> Simulators<'a> {
    /// Installs what is missing if the user agrees, and downloads the source, unless that was done
    /// before.
    pub fn find(workspace: &'a Workspace, options: Options) -> Result<Self> {
        install(options)?;
        let folder = workspace.target.join("gates");
        let source = download(&folder, &workspace.root.join(PINNED), options)?;
        Ok(Self { workspace, folder, source })
    }

    /// Compiles the source, unless that was done before from the same files.
    pub fn make(&self) -> Result<()> {
        let [pinned, bench] = [PINNED, BENCH].map(|name| self.workspace.root.join(name));
        let recipe = workspace::read(&pinned)? + &workspace::read(&bench)? + VERILATE;
        let stamp = self.folder.join("recipe");
        if std::fs::read_to_string(&stamp).is_ok_and(|made_of| made_of == recipe) {
            return Ok(());
        }
        for latency in LATENCIES {
            compile(&self.folder, &self.source, &bench, latency)?;
        }
        workspace::write(&stamp, recipe)
    }

    /// The output of a program on the core, for each latency of its FPU.
    ///
    /// # Errors
    /// It ends with another code than zero, does not end, or leaves its memory.
    pub fn run_all(&self, elf: &Path) -> Result<Vec<String>> {
        let run = |latency| {
            let core = self.folder.join(format!("latency_{latency}/core"));
            shell::capture(Command::new(core).arg(elf).arg(LIMIT))
        };
        thread::scope(|scope| {
            let threads = LATENCIES.map(|latency| scope.spawn(move || run(latency)));
            threads.into_iter().map(joined).collect()
        })
    }
}

fn install(options: Options) -> Result<()> {
    let mut plan = Plan::default();
    for (program, package) in PROGRAMS {
        if shell::which(program).is_none() && Qemu::first(program).is_err() {
            let elsewhere = format!("install `{program}` with your system's package manager");
            plan.add(format!("`{program}`, for the core's gates"), &[package], &elsewhere);
        }
    }
    if !shell::succeeds(Command::new("python3").args(["-m", "pip", "--version"])) {
        plan.add("`python3 -m pip`".into(), &["python3-pip"], "install Python's module `pip`");
    }
    plan.carry_out(options)
}

/// The folder of the source, from the pinned package.
fn download(folder: &Path, pinned: &Path, options: Options) -> Result<PathBuf> {
    let package = folder.join("package");
    std::fs::create_dir_all(&package).map_err(Error::file("create", &package))?;
    let mut pip = Command::new("python3");
    pip.args(["-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes"]);
    pip.arg("--dest").arg(&package).arg("--requirement").arg(pinned);
    if !succeeds_before(&package) {
        setup::may_install(options, &[shell::display(&pip)])?;
    }
    shell::capture(&mut pip)?;
    let wheels = std::fs::read_dir(&package).map_err(Error::file("read", &package))?;
    let is_wheel = |path: &PathBuf| path.extension().is_some_and(|end| end == "whl");
    let Some(wheel) = wheels.flatten().map(|entry| entry.path()).find(is_wheel) else {
        bail!("the package of the core has no wheel");
    };
    let mut unpack = Command::new("python3");
    unpack.args(["-m", "zipfile", "-e"]).arg(&wheel).arg(folder.join("source"));
    shell::capture(&mut unpack)?;
    Ok(folder.join("source/pythondata_cpu_cv32e40p/system_verilog"))
}

/// Whether the package was downloaded before.
fn succeeds_before(package: &Path) -> bool {
    std::fs::read_dir(package).is_ok_and(|mut entries| entries.next().is_some())
}

/// The files of the core in the order of its list, without its tracer and that tracer's bench.
fn files(list: &str, rtl: &str) -> Vec<String> {
    let lines = list.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines = lines.filter(|line| !line.starts_with("//") && !line.ends_with("/sva"));
    let lines = lines.filter(|line| !line.contains("tracer") && !line.contains("tb_wrapper"));
    lines.map(|line| line.replace("${DESIGN_RTL_DIR}", rtl)).collect()
}

fn compile(folder: &Path, source: &Path, bench: &Path, latency: usize) -> Result<()> {
    let list = workspace::read(&source.join("cv32e40p_fpu_manifest.flist"))?;
    let mut verilator = Command::new("verilator");
    verilator.args(VERILATE.split_whitespace()).args(SILENT.split_whitespace());
    verilator.args(["ADDMUL", "OTHERS"].map(|unit| format!("-GFPU_{unit}_LAT={latency}")));
    verilator.args(["-j", "2", "--Mdir"]).arg(folder.join(format!("latency_{latency}")));
    verilator.args(files(&list, &source.join("rtl").display().to_string())).arg(bench);
    shell::capture(&mut verilator).map(drop)
}

#[cfg(test)]
mod tests {
    use super::files;

    #[test]
    fn the_tracer_is_not_of_the_core() {
        let list = "// a list\n\n+incdir+${DESIGN_RTL_DIR}/include\n\
                    +incdir+${DESIGN_RTL_DIR}/../sva\n\
                    ${DESIGN_RTL_DIR}/cv32e40p_core.sv\n\
                    ${DESIGN_RTL_DIR}/../bhv/cv32e40p_tb_wrapper.sv\n\
                    ${DESIGN_RTL_DIR}/../bhv/include/cv32e40p_tracer_pkg.sv\n";
        assert_eq!(files(list, "rtl"), ["+incdir+rtl/include", "rtl/cv32e40p_core.sv"]);
    }
}
