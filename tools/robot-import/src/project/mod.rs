//! A project outside the repository: firmware in Rust, for a board or simulated, or a static
//! library for C.
//!
//! The templates are in `template/rust`, which is one of `cargo generate` as well, `template/c` and
//! `template/board`. A placeholder is replaced by text, nothing else: no condition, no loop. Lines of a
//! board's files are left out if they are for joints that the robot does not have.

mod board;
mod choice;
mod error;
mod feedback;
mod libraries;
mod names;
mod templates;
#[cfg(test)]
mod tests;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::limits::{MOST_JOINTS_FOLDED, MOST_JOINTS_OF_PROJECT};
use crate::text::code_span;
pub use board::{BOARDS, Board, Framework};
use board::{JOINTS, of_joints};
pub use error::ProjectError;
pub use feedback::{Feedback, OMEGA_N};
use names::{check_name, enumerators, snake_case, toml_string};
use templates::{C, File, RUST, constants};

/// A project to be written.
#[derive(Clone, Debug)]
pub struct Project {
    /// Its name: that of the crate, in kebab case or snake case.
    pub name: String,
    /// The robot.
    pub robot: RobotFile,
    /// The place of the library.
    pub library: Library,
    /// The kind of the project.
    pub kind: Kind,
}

/// The kinds of projects.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Firmware in Rust on a simulated robot.
    Simulation,
    /// A static library with a C header.
    C,
    /// Firmware in Rust for a board.
    Board(&'static Board),
}

/// The Rust file of a robot, and what the templates need of it.
#[derive(Clone, Debug)]
pub struct RobotFile {
    /// The type that implements `Robot`.
    pub type_name: String,
    /// The text of the file.
    pub text: String,
    /// The words after `robot-import import` that write it again, as a shell takes them.
    pub again: String,
    /// The names of the joints, one for each velocity coordinate.
    pub joints: Vec<String>,
    /// The names of the bodies, in their order.
    pub bodies: Vec<String>,
    /// The number of bodies.
    pub b: usize,
    /// The number of position coordinates.
    pub q: usize,
    /// The number of velocity coordinates.
    pub v: usize,
    /// Whether joints are coupled (mimic joints): the projects drive each joint by itself.
    pub coupled: bool,
    /// The feedback of its project.
    pub feedback: Feedback,
}

/// The source from which a project gets dynamics-core and the crates beside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Library {
    /// A copy in the project, of a program that was built in the repository.
    Copy,
    /// The crates of this version on crates.io.
    Registry,
    /// The folder of the crate `dynamics-core`.
    Path(PathBuf),
    /// The address of its repository.
    Git(String),
}

/// The version of all crates of the repository.
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The folder of the library.
const DYNAMICS: &str = "dynamics-core";

impl Library {
    /// A dependency on the crate in this folder of the repository, as a value of TOML.
    fn dependency(&self, folder: &str) -> Result<String, ProjectError> {
        match self {
            Self::Copy => {
                let own = folder.rsplit('/').next().unwrap_or_default();
                Ok(format!("{{ path = \"{}/{own}\" }}", libraries::FOLDER))
            }
            Self::Registry => Ok(format!("{{ version = \"{VERSION}\" }}")),
            Self::Path(path) => {
                let path = match folder {
                    DYNAMICS => path.clone(),
                    beside => path.with_file_name(beside),
                };
                let text = path.to_str().and_then(toml_string);
                let wrong = || ProjectError::Library(path.display().to_string());
                Ok(format!("{{ path = {} }}", text.ok_or_else(wrong)?))
            }
            Self::Git(address) => {
                let wrong = || ProjectError::Library(address.clone());
                Ok(format!("{{ git = {} }}", toml_string(address).ok_or_else(wrong)?))
            }
        }
    }
}

/// The files that were written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Created {
    /// The paths of the files.
    pub files: Vec<PathBuf>,
    /// Why it is only the robot's file, if it is.
    pub robot_only: Option<RobotOnly>,
    /// The facts that the user has to know about the project.
    pub notes: Vec<String>,
}

/// A robot for which there is no project; its file was written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotOnly {
    /// A floating base, spherical or planar joints.
    #[error(
        "a project needs joints of one degree of freedom on a fixed base; this robot has {b} \
         bodies, {q} position and {v} velocity coordinates: only its file was written"
    )]
    Coordinates {
        /// The number of bodies.
        b: usize,
        /// The number of position coordinates.
        q: usize,
        /// The number of velocity coordinates.
        v: usize,
    },
    /// More joints than the engine takes.
    #[error(
        "a project has at most {MOST_JOINTS_OF_PROJECT} joints, this robot has {0}: only its file \
         was written"
    )]
    Joints(usize),
}

/// The sentence about coupled joints.
const COUPLED: &str = "the joints coupled by `COUPLING` are driven each by itself in this project: \
                       use the Transmission in src/robot.rs where a motor moves several of them";

/// Fails if a folder has files, or a project cannot have its name: what can be said before the
/// robot is read.
///
/// # Errors
/// [`ProjectError::NotEmpty`], [`ProjectError::Name`].
pub fn check_folder(folder: &Path, name: &str) -> Result<(), ProjectError> {
    let is_used = match fs::read_dir(folder) {
        Ok(mut entries) => entries.next().is_some(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => false,
        Err(error) => return Err(ProjectError::io("read", folder)(error)),
    };
    if is_used {
        return Err(ProjectError::NotEmpty(folder.to_path_buf()));
    }
    check_name(name)
}

/// Writes a project into a folder that is empty or not there, and formats it if rustfmt is
/// installed.
///
/// # Errors
/// [`ProjectError`]; no file that was there is overwritten.
pub fn create(folder: &Path, project: &Project) -> Result<Created, ProjectError> {
    let planned = files(project)?;
    check_folder(folder, &project.name)?;
    let mut files = Vec::new();
    for (path, text) in &planned {
        write(folder, path, text, &mut files)?;
    }
    format(&files, &folder.join(libraries::FOLDER));
    let robot_only = project.robot.robot_only();
    let notes = match robot_only {
        Some(_) => Vec::new(),
        None => notes(project),
    };
    Ok(Created { files, robot_only, notes })
}

/// Notes for the user of a project.
fn notes(project: &Project) -> Vec<String> {
    let Feedback { omega_n, words } = &project.robot.feedback;
    let mut notes: Vec<String> =
        project.robot.coupled.then(|| COUPLED.to_owned()).into_iter().collect();
    let is_c = matches!(project.kind, Kind::C);
    if *omega_n > OMEGA_N {
        let taken =
            if is_c { "give the controller as much" } else { "`OMEGA_N` in src/scene.rs is that" };
        notes.push(format!(
            "the links of this file have little inertia for their weight, and a feedback of \
             {OMEGA_N} rad/s does not hold them against gravity within the joints' limits; \
             {omega_n:.1} rad/s does: {taken}, or state the rotors' inertia (armature) in the file"
        ));
    }
    if !is_c {
        notes.extend(words.iter().cloned());
    }
    notes
}

/// The path of each file of a project in its folder, and its text before it is formatted.
///
/// # Errors
/// A name or an address that cannot be used, or more joints than the board has.
pub fn files(project: &Project) -> Result<Vec<(String, String)>, ProjectError> {
    check_name(&project.name)?;
    let robot = ("src/robot.rs".to_owned(), project.robot.text.clone());
    if project.robot.robot_only().is_some() {
        project.library.dependency(DYNAMICS)?;
        return Ok(vec![robot]);
    }
    let values = values(project)?;
    let filled = |file: &File| [file.path, file.text].map(|template| substitute(template, &values));
    let mut files: Vec<(String, String)> = match project.kind {
        Kind::Simulation => RUST.iter().map(|file| filled(file).into()).collect(),
        Kind::C => C.iter().map(|file| filled(file).into()).collect(),
        Kind::Board(board) => {
            let of_robot = |file: &File| {
                let [path, text] = filled(file);
                (path, of_joints(&text, project.robot.v))
            };
            board.files().map(of_robot).collect()
        }
    };
    if project.library == Library::Copy {
        let manifest = files.iter().find(|file| file.0 == "Cargo.toml");
        let copies = manifest.map(|(_, text)| libraries::copies(text));
        files.extend(copies.unwrap_or_default());
    }
    let lock = match project.kind {
        Kind::Board(_) => libraries::LOCK_OF_BOARDS,
        Kind::Simulation | Kind::C => libraries::LOCK,
    };
    if project.library != Library::Registry {
        files.push(("Cargo.lock".to_owned(), lock.to_owned()));
    }
    files.push(robot);
    Ok(files)
}

fn write(
    folder: &Path,
    path: &str,
    text: &str,
    files: &mut Vec<PathBuf>,
) -> Result<(), ProjectError> {
    let path = folder.join(path);
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent).map_err(ProjectError::io("create", parent))?;
    }
    fs::write(&path, text).map_err(ProjectError::io("write", &path))?;
    files.push(path);
    Ok(())
}

/// Formats Rust files, where rustfmt is installed: how long a line is depends on the project's
/// name.
fn format(files: &[PathBuf], libraries: &Path) {
    let sources = (files.iter()).filter(|path| {
        path.extension().is_some_and(|end| end == "rs") && !path.starts_with(libraries)
    });
    let mut rustfmt = Command::new("rustfmt");
    rustfmt.args(["--quiet", "--edition", "2024"]);
    // In the project: a `rust-toolchain.toml` of the current folder would name the program that
    // runs.
    if let Some(folder) = files.first().and_then(|file| file.parent()) {
        rustfmt.current_dir(folder);
    }
    let silent = rustfmt.args(sources).stdout(Stdio::null()).stderr(Stdio::null());
    // A project whose lines are too long is as good.
    let _ = silent.status();
}

impl RobotFile {
    fn robot_only(&self) -> Option<RobotOnly> {
        let Self { b, q, v, .. } = *self;
        if b != v || q != v || self.joints.len() != v {
            return Some(RobotOnly::Coordinates { b, q, v });
        }
        (v > MOST_JOINTS_OF_PROJECT).then_some(RobotOnly::Joints(v))
    }
}

/// A placeholder between its braces, and its value.
type Value = (&'static str, String);

fn values(project: &Project) -> Result<Vec<Value>, ProjectError> {
    let dependency = |name| project.library.dependency(name);
    let robot = &project.robot;
    let crate_name = snake_case(&project.name);
    let prefix = crate_name.to_ascii_uppercase();
    let form = if robot.v > MOST_JOINTS_FOLDED { "Core" } else { "Engine" };
    let taken = &constants(C);
    let tick = match project.kind {
        Kind::Board(board) => board.parts.tick,
        Kind::Simulation | Kind::C => "1e-3",
    };
    let mut values = vec![
        ("project-name", project.name.clone()),
        ("joints", enumerators(&prefix, "JOINT", &robot.joints, taken)),
        ("bodies", enumerators(&prefix, "BODY", &robot.bodies, taken)),
        ("n", robot.v.to_string()),
        ("omega_n", format!("{:.1}", robot.feedback.omega_n)),
        ("form", form.into()),
        ("tick", tick.into()),
        ("crate_name", crate_name),
        ("crate_name | upcase", prefix),
        ("library", dependency(DYNAMICS)?),
        ("dynamics_c", dependency("c")?),
        ("motion_control", dependency("motion-control")?),
        ("joint_drivers", dependency("drivers")?),
        ("machine_link", with(&dependency("telemetry")?, "optional = true")),
        ("robot", robot.type_name.clone()),
        ("import_again", robot.again.clone()),
        ("library_note", project.library.note()?),
    ];
    if let Kind::Board(board) = project.kind {
        if robot.v > board.most_joints {
            return Err(ProjectError::TooManyJoints {
                joints: robot.v,
                board: board.name,
                most: board.most_joints,
            });
        }
        // In a cell of a table.
        let name = |joint: &String| code_span(joint).replace('|', "\\u{7c}");
        values.extend(JOINTS.into_iter().zip(robot.joints.iter().map(name)));
        let pins = substitute(&of_joints(board.pins, robot.v), &values);
        values.push(("pins", pins));
        values.extend(board.values());
        let features = format!("features = [{}]", board.features);
        let support = dependency("firmware-demo/boards/support")?;
        values.push(("board_support", with(&support, &features)));
        let of_bench = |&(name, folder): &(&str, &str)| {
            let value = project.library.dependency(folder)?;
            let inside = format!("path = \"{}/", libraries::FOLDER);
            let value = value.replace(&inside, &format!("path = \"../{}/", libraries::FOLDER));
            Ok(format!("{name} = {value}\n"))
        };
        let bench: Result<String, ProjectError> = board.parts.bench.iter().map(of_bench).collect();
        values.push((
            "bench",
            format!("{}embedded-can = \"0.4.1\"\nembedded-hal = \"1.0.0\"\nnb = \"1.1.0\"", bench?),
        ));
        let members = if board.parts.bench.is_empty() { "" } else { "members = [\"bench\"]\n" };
        values.push(("members", members.to_owned()));
        let parts = substitute(board.parts.expected, &values);
        values.push(("parts", parts.trim_end().to_owned()));
    }
    Ok(values)
}

/// A dependency with a further key.
fn with(dependency: &str, key: &str) -> String {
    format!("{}, {key} }}", dependency.trim_end_matches(" }"))
}

/// The text with each `{{placeholder}}` replaced by its value; values are not searched for further
/// ones.
fn substitute(text: &str, values: &[Value]) -> String {
    let mut parts = text.split("{{");
    let mut result = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let known = part.split_once("}}").and_then(|(name, rest)| {
            let (_, value) = values.iter().find(|(known, _)| *known == name)?;
            Some((value, rest))
        });
        match known {
            Some((value, rest)) => result.extend([value.as_str(), rest]),
            None => result.extend(["{{", part]),
        }
    }
    result
}
