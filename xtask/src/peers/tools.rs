//! Compilers from the system's packages, and a Python environment that carries the peers.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::error::{Error, Result};
use crate::output;
use crate::setup::{self, Options, Tools};
use crate::shell;
use crate::system::{self, System};
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

const PYTHON: &str = "python3";

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

/// Installs what is missing, announced, or says what would.
pub fn set_up(workspace: &Workspace, options: Options) -> Result<(Tools, Peers)> {
    let dir = workspace.target.join("peers");
    let venv = dir.join("venv");
    let requirements = workspace.root.join("host-tests/peers/requirements.txt");
    let wanted = workspace::read(&requirements)?;
    // Written last: an environment that was left half done has none.
    let stamp = venv.join("installed.txt");
    let is_installed = std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted);

    let packages = missing_packages();
    let mut commands = Vec::new();
    if !packages.is_empty() {
        output::note(&format!(
            "missing, of what the peers are built with: {}",
            packages.join(", ")
        ));
        commands.extend(install_lines(&packages));
    }
    let pip = python_of(&venv);
    let mut make = Command::new(PYTHON);
    make.args(["-m", "venv"]).arg(&venv);
    let mut fill = Command::new(&pip);
    fill.args(["-m", "pip", "install", "--requirement"])
        .arg(&requirements);
    if !is_installed {
        output::note("missing: a Python environment with Pinocchio, CasADi and MuJoCo");
        commands.extend([shell::display(&make), shell::display(&fill)]);
    }

    let tools = setup::for_demo(options);
    let may_install = packages.is_empty() || System::this() == System::Debian;
    match tools {
        Err(Error::Missing { commands: first }) => {
            return Err(Error::Missing {
                commands: [first, commands].concat(),
            });
        }
        Ok(_) if !commands.is_empty() && (options.no_install || !may_install) => {
            return Err(Error::Missing { commands });
        }
        _ => {}
    }
    let tools = tools?;
    if !commands.is_empty() {
        setup::may_install(options, &commands, !packages.is_empty())?;
    }
    if !packages.is_empty() {
        system::apt_install(&packages)?;
    }
    if !is_installed {
        std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
        shell::run(&mut make)?;
        shell::run(&mut fill)?;
        workspace::write(&stamp, wanted)?;
    }
    let script = "import sysconfig; print(sysconfig.get_path('purelib'))";
    let packages = shell::capture(Command::new(&pip).args(["-c", script]))?;
    let eigen = eigen().ok_or_else(|| Error::check("Eigen is not where it was installed"))?;
    Ok((
        tools,
        Peers {
            packages: packages.trim().into(),
            python: pip,
            dir,
            requirements,
            eigen,
        },
    ))
}

fn python_of(venv: &Path) -> PathBuf {
    venv.join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    })
}

fn eigen() -> Option<PathBuf> {
    EIGEN
        .iter()
        .map(PathBuf::from)
        .find(|dir| dir.join("Eigen/Core").is_file())
}

/// Debian's packages of what is not there.
fn missing_packages() -> Vec<&'static str> {
    let mut packages: Vec<_> = PROGRAMS
        .iter()
        .filter(|(program, _)| shell::which(program).is_none())
        .map(|(_, package)| *package)
        .collect();
    if eigen().is_none() {
        packages.push("libeigen3-dev");
    }
    // Debian has `python3 -m venv` in a package of its own.
    if !shell::succeeds(Command::new(PYTHON).args(["-c", "import ensurepip, venv"])) {
        packages.push("python3-venv");
    }
    packages.dedup();
    packages
}

fn install_lines(packages: &[&str]) -> Vec<String> {
    if System::this() == System::Debian {
        return system::apt_lines(packages);
    }
    vec![format!(
        "install what Debian calls {} with your system's package manager",
        packages.join(", ")
    )]
}
