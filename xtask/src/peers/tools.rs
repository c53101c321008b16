//! Compilers from the system's packages, and a Python environment that carries the peers.

use std::path::PathBuf;
use std::process::Command;

use crate::error::{Error, Result};
use crate::output;
use crate::setup::{self, Options, Tools};
use crate::shell;
use crate::workspace::{self, Workspace};

/// Programs, and Debian's packages of them.
const PROGRAMS: [(&str, &str); 6] = [
    ("gcc", "gcc"),
    ("g++", "g++"),
    ("clang", "clang"),
    ("clang++", "clang"),
    ("arm-none-eabi-gcc", "gcc-arm-none-eabi"),
    ("python3", "python3"),
];

/// Where Eigen's headers are on the systems that we know.
const EIGEN: [&str; 3] = [
    "/usr/include/eigen3",
    "/usr/local/include/eigen3",
    "/opt/homebrew/include/eigen3",
];

/// Where everything is.
pub struct Peers {
    /// The directory of all that is made here.
    pub dir: PathBuf,
    /// The environment's Python.
    pub python: PathBuf,
    /// Where its packages are, which carry headers and libraries.
    pub packages: PathBuf,
    /// The list of those packages.
    pub requirements: PathBuf,
    /// Eigen's headers.
    pub eigen: PathBuf,
}

/// Makes the Python environment, announced; says what else would have to be installed.
pub fn set_up(workspace: &Workspace, options: Options) -> Result<(Tools, Peers)> {
    let tools = setup::for_demo(options)?;
    let mut packages: Vec<_> = PROGRAMS
        .iter()
        .filter(|(program, _)| shell::which(program).is_none())
        .map(|(_, package)| *package)
        .collect();
    let mut eigen = EIGEN.iter().map(PathBuf::from);
    let eigen = eigen.find(|dir| dir.join("Eigen/Core").is_file());
    if eigen.is_none() {
        packages.push("libeigen3-dev");
    }
    // Debian has `python3 -m venv` in a package of its own.
    if !shell::succeeds(Command::new("python3").args(["-c", "import ensurepip, venv"])) {
        packages.push("python3-venv");
    }
    let Some(eigen) = eigen.filter(|_| packages.is_empty()) else {
        let line = format!("sudo apt-get install {}", packages.join(" "));
        let commands = vec![line + "    # or what your system calls these"];
        return Err(Error::Missing { commands });
    };
    let dir = workspace.target.join("peers");
    let venv = dir.join("venv");
    let python = venv.join("bin/python");
    let requirements = workspace.root.join("host-tests/peers/requirements.txt");
    let wanted = workspace::read(&requirements)?;
    // Written last: an environment that was left half done has none.
    let stamp = venv.join("installed.txt");
    if !std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) {
        let mut make = Command::new("python3");
        make.args(["-m", "venv"]).arg(&venv);
        let mut fill = Command::new(&python);
        fill.args(["-m", "pip", "install", "--requirement"]);
        fill.arg(&requirements);
        let commands = vec![shell::display(&make), shell::display(&fill)];
        if options.no_install {
            return Err(Error::Missing { commands });
        }
        output::note("a Python environment with Pinocchio, CasADi and MuJoCo is made with:");
        output::note(&format!("    {}", commands.join("\n    ")));
        std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
        shell::run(&mut make)?;
        shell::run(&mut fill)?;
        workspace::write(&stamp, wanted)?;
    }
    let script = "import sysconfig; print(sysconfig.get_path('purelib'))";
    let packages = shell::capture(Command::new(&python).args(["-c", script]))?;
    let packages = packages.trim().into();
    Ok((
        tools,
        Peers {
            dir,
            python,
            packages,
            requirements,
            eigen,
        },
    ))
}
