//! Compilers from the system's packages, and a Python environment that carries the peers.

use std::path::PathBuf;
use std::process::Command;

use xtask::kit::error::{Error, Result, bail};
use xtask::kit::setup::{self, Options, Plan, Tools};
use xtask::kit::workspace::{self, Workspace};
use xtask::kit::{output, shell};

/// Programs, and Debian's packages of them.
const PROGRAMS: [(&str, &str); 7] = [
    ("gcc", "gcc"),
    ("g++", "g++"),
    ("clang", "clang"),
    ("clang++", "clang"),
    ("arm-none-eabi-gcc", "gcc-arm-none-eabi"),
    ("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf"),
    ("python3", "python3"),
];

/// The places of Eigen's headers on known systems.
const EIGEN: [&str; 3] =
    ["/usr/include/eigen3", "/usr/local/include/eigen3", "/opt/homebrew/include/eigen3"];

fn eigen() -> Option<PathBuf> {
    let mut folders = EIGEN.iter().map(PathBuf::from);
    folders.find(|folder| folder.join("Eigen/Core").is_file())
}

/// The programs and packages of the peers.
pub struct Peers {
    /// The directory of all that is made here.
    pub dir: PathBuf,
    pub python: PathBuf,
    /// The directory of its packages, with headers and libraries.
    pub packages: PathBuf,
    pub requirements: PathBuf,
    pub eigen: PathBuf,
}

/// Installs the programs and makes the Python environment, if the user agrees.
///
/// # Errors
/// Something is missing that may not, or cannot, be installed.
pub fn set_up(workspace: &Workspace, options: Options) -> Result<(Tools, Peers)> {
    let tools = setup::for_demo(options)?;
    let mut plan = Plan::default();
    for (program, package) in PROGRAMS {
        if shell::which(program).is_none() {
            let elsewhere = format!("install `{program}` with your system's package manager");
            plan.add(format!("`{program}`"), &[package], &elsewhere);
        }
    }
    if eigen().is_none() {
        let elsewhere = "install Eigen 3 with your system's package manager";
        plan.add("the headers of Eigen".into(), &["libeigen3-dev"], elsewhere);
    }
    // Debian has `python3 -m venv` in a package of its own.
    if !shell::succeeds(Command::new("python3").args(["-c", "import ensurepip, venv"])) {
        let elsewhere = "install Python's modules `venv` and `ensurepip`";
        plan.add("`python3 -m venv`".into(), &["python3-venv"], elsewhere);
    }
    plan.carry_out(options)?;
    let Some(eigen) = eigen() else {
        bail!("no headers of Eigen in {}", EIGEN.join(", "));
    };
    let dir = workspace.target.join("peers");
    let venv = dir.join("venv");
    let python = venv.join("bin/python");
    let requirements = workspace.root.join("companions/laboratory/peers/requirements.txt");
    let wanted = workspace::read(&requirements)?;
    // Written last: an environment that was left half done has none.
    let stamp = venv.join("installed.txt");
    if !std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) {
        let mut make = Command::new("python3");
        make.args(["-m", "venv"]).arg(&venv);
        let mut fill = Command::new(&python);
        fill.args(["-m", "pip", "install", "--requirement"]);
        fill.arg(&requirements);
        let commands = [shell::display(&make), shell::display(&fill)];
        output::note("missing: a Python environment with Pinocchio and CasADi");
        setup::may_install(options, &commands)?;
        std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
        shell::run(&mut make)?;
        shell::run(&mut fill)?;
        workspace::write(&stamp, wanted)?;
    }
    let script = "import sysconfig; print(sysconfig.get_path('purelib'))";
    let packages = shell::capture(Command::new(&python).args(["-c", script]))?;
    let packages = packages.trim().into();
    Ok((tools, Peers { dir, python, packages, requirements, eigen }))
}
