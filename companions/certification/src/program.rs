//! The program of a robot: built as firmware is, and read.

use std::path::{Path, PathBuf};
use std::process::Command;

use robot_import::import;

use crate::error::{Error, Result};
use crate::function::Function;

/// The robots of the library of which `companions/certification/certificates.md` has certificates,
/// and the source that the firmware includes for each.
pub const LIBRARY: [(&str, &str); 5] = [
    ("ur5e", include_str!("../firmware/robots/ur5e.rs")),
    ("panda", include_str!("../firmware/robots/panda.rs")),
    ("iiwa14", include_str!("../firmware/robots/iiwa14.rs")),
    ("so101", include_str!("../firmware/robots/so101.rs")),
    ("a1_leg", include_str!("../firmware/robots/a1_leg.rs")),
];

/// The robot with a kinematic loop of which the page has a certificate: a program of its own.
pub const CLUSTERED: &str = "four_bar_leg";

const TARGET: &str = "thumbv7em-none-eabihf";
const PACKAGE: &str = "certified";

/// A robot's name and its program.
#[derive(Clone, Debug)]
pub struct Program {
    /// The name of the robot.
    pub robot: String,
    /// The program as an ELF file.
    pub elf: Vec<u8>,
    /// The version of the compiler.
    pub rustc: String,
}

/// Builds the program of a robot of the library, or of a description.
///
/// # Errors
/// [`Error::Robot`] of a description that is not taken, [`Error::Program`] if cargo fails.
pub fn build(robot: &str, options: &import::Options) -> Result<Program> {
    match robot {
        CLUSTERED => bin(robot, options, "clustered", "clustered"),
        _ => bin(robot, options, PACKAGE, "firmware"),
    }
}

impl Program {
    /// The functions that it has, of those that are asked for, each once.
    pub fn functions(&self, asked: &[Function]) -> Vec<Function> {
        let asked = match self.robot.as_str() {
            CLUSTERED => &[Function::Clustered],
            _ => asked,
        };
        let mut functions = Vec::new();
        for function in asked {
            if !functions.contains(function) {
                functions.push(*function);
            }
        }
        functions
    }
}

/// Builds the program of the configurations of a robot: [`crate::configurations`].
///
/// # Errors
/// As [`build`].
pub fn configured(robot: &str, options: &import::Options) -> Result<Program> {
    bin(robot, options, "configured", "configured")
}

fn bin(robot: &str, options: &import::Options, name: &str, feature: &str) -> Result<Program> {
    let bin = name;
    let folder = tempfile::tempdir()
        .map_err(|source| Error::File { path: "a temporary folder".into(), source })?;
    let included = folder.path().join("included.rs");
    let (name, text) = match LIBRARY.iter().find(|(name, _)| *name == robot) {
        Some((name, text)) => ((*name).to_owned(), (*text).to_owned()),
        // Its program names the robot itself.
        None if robot == CLUSTERED => (robot.to_owned(), String::new()),
        None => of_description(Path::new(robot), options, &folder.path().join("robot.rs"))?,
    };
    write(&included, &text)?;
    let words = [
        "build",
        "--quiet",
        "--release",
        "--package",
        PACKAGE,
        "--bin",
        bin,
        "--features",
        feature,
        "--target",
        TARGET,
    ];
    capture(cargo().args(words).env("CERTIFIED_ROBOT", &included))?;
    let path = target().join(TARGET).join("release").join(bin);
    let elf = std::fs::read(&path).map_err(|source| Error::File { path, source })?;
    let rustc = capture(
        Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())).arg("--version"),
    )?;
    Ok(Program { robot: name, elf, rustc: rustc.trim().to_owned() })
}

/// The cycle meter as a plugin of QEMU, built.
///
/// # Errors
/// [`Error::Program`] if cargo fails.
pub fn meter() -> Result<PathBuf> {
    use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
    capture(cargo().args(["build", "--quiet", "--release", "--package", "cycle-meter"]))?;
    Ok(target().join(format!("release/{DLL_PREFIX}cycle_meter{DLL_SUFFIX}")))
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

fn cargo() -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root());
    cargo
}

/// The name of a description's robot and what the firmware includes; the robot's own file is
/// written beside.
fn of_description(
    file: &Path,
    options: &import::Options,
    beside: &Path,
) -> Result<(String, String)> {
    let args =
        import::Args { file: file.to_owned(), options: options.clone(), ..import::Args::default() };
    let imported = import::import(&args, "this day")
        .map_err(|e| Error::Robot(format!("{}: {e}", file.display())))?;
    let robot = imported.robot_file();
    if robot.q != robot.v || !imported.tree.is_single() {
        let what = "certificates are of robots whose joints have one coordinate each, on a base that stands still";
        return Err(Error::Robot(format!("{}: {what}", file.display())));
    }
    write(beside, &robot.text)?;
    let text = format!(
        "#[path = {beside:?}]\nmod robot;\ntype Robot = robot::{};\nconst B: usize = {};\nconst N: usize = {};\n",
        robot.type_name, robot.b, robot.v
    );
    Ok((imported.name, text))
}

/// Writes a text to a file.
///
/// # Errors
/// [`Error::File`].
pub fn write(path: &Path, text: &str) -> Result<()> {
    std::fs::write(path, text).map_err(|source| Error::File { path: path.to_owned(), source })
}

/// The output that a command prints.
pub(crate) fn capture(command: &mut Command) -> Result<String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let failed = |said: String| Error::Program { program: program.clone(), said };
    let output = command.output().map_err(|e| failed(e.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
