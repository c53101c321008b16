//! Files of descriptions, each format in a module.

mod encoding;
mod extensions;
mod limits;
mod lines;
mod mjcf;
mod tolerant;
mod urdf;
mod xacro;
pub mod xml;

use std::collections::HashMap;
use std::io::Read as _;
use std::path::Path;

use xml::Xml;

use dynamics_core::glam::DVec3;

use crate::description::{Description, Format, Kind, Pose, shortened};
use crate::error::{ImportError, Problem, Result};
use crate::limits::{LEAST, MOST, MOST_BYTES, MOST_LINKS, MOST_OF_JOINT, STACK};

/// Runs what is recursive in the nesting of a file on a stack that is large enough, whichever
/// thread calls.
fn on_a_large_stack<T: Send>(work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    // WebAssembly has no threads: its only stack is as large as its linker was told.
    if cfg!(target_family = "wasm") {
        return work();
    }
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let thread = thread.spawn_scoped(scope, work);
        let no_thread = |error: std::io::Error| Problem::File {
            path: "a thread that reads it".into(),
            reason: error.to_string(),
        };
        let finished = thread.map_err(no_thread)?.join();
        finished.unwrap_or_else(|panicked| std::panic::resume_unwind(panicked))
    })
}

/// The folders of files that a description may include.
#[derive(Clone, Copy, Debug)]
pub struct Folders<'p> {
    /// The folder of the description; what is below it is read.
    pub model: &'p Path,
    /// A folder that its user names, below which files are read, too.
    pub include_root: Option<&'p Path>,
}

impl<'p> Folders<'p> {
    /// The folders for the file of a description.
    pub fn of(path: &'p Path, include_root: Option<&'p Path>) -> Self {
        let model = path.parent().unwrap_or(Path::new("."));
        Self { model, include_root }
    }
}

/// The robot that a file describes.
///
/// # Errors
/// [`ImportError`] with the line and the element.
pub fn read(path: &Path) -> Result<Description> {
    read_below(path, None)
}

/// The robot that a file describes, which may include files below a folder that its user names,
/// besides those beside it.
///
/// # Errors
/// As [`read`].
pub fn read_below(path: &Path, include_root: Option<&Path>) -> Result<Description> {
    let (text, note) = text(path)?;
    let mut robot = on_a_large_stack(|| described(&text, Folders::of(path, include_root)))?;
    robot.notes.splice(0..0, note);
    Ok(robot)
}

/// The text of a file that is not too large, and a sentence if it is not of the encoding that it
/// declares.
fn text(path: &Path) -> Result<(String, Option<String>)> {
    let unreadable = |reason: std::io::Error| Problem::File {
        path: path.display().to_string(),
        reason: reason.to_string(),
    };
    let too_large =
        |found: usize| Problem::TooLarge { what: "bytes in the file", found, most: MOST_BYTES };
    let length = std::fs::metadata(path).map_err(unreadable)?.len();
    if length > MOST_BYTES as u64 {
        return Err(too_large(length as usize).into());
    }
    // A pipe, for example, is no file and has no length.
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    let mut beginning = file.take(MOST_BYTES as u64 + 1);
    beginning.read_to_end(&mut bytes).map_err(unreadable)?;
    match bytes.len() {
        0..=MOST_BYTES => encoding::decode(&bytes),
        found => Err(too_large(found).into()),
    }
}

/// The robot that a text describes; other files that it names are in `folder`.
///
/// # Errors
/// [`ImportError`] with the line and the element.
pub fn parse(text: &str, folder: &Path) -> Result<Description> {
    let folders = Folders { model: folder, include_root: None };
    on_a_large_stack(|| described(text, folders))
}

fn described(text: &str, folders: Folders<'_>) -> Result<Description> {
    let xml = Xml::of(text)?;
    let document = xml.document()?;
    let root = document.root_element();
    let mut robot = match xml::tag(root) {
        "robot" => urdf::read(root)?,
        "mujoco" => mjcf::read(root, folders)?,
        _ => return Err(xml::error(root, Problem::Format)),
    };
    if robot.licence.is_none() {
        robot.licence = licence(text);
    }
    robot.notes.splice(0..0, xml.notes());
    limits::without(&mut robot);
    check(&robot)?;
    Ok(robot)
}

/// A licence's name in the comments at the beginning.
fn licence(text: &str) -> Option<String> {
    let names = [
        "Apache-2.0",
        "Apache License",
        "BSD-3-Clause",
        "BSD-2-Clause",
        "BSD",
        "MIT",
        "MPL-2.0",
        "LGPL",
        "GPL",
        "CC-BY",
    ];
    let start: String = text.chars().take(4_000).collect();
    let comments = start.split("<!--").skip(1);
    let comments: String = comments.filter_map(|part| part.split("-->").next()).collect();
    let found = names.iter().find(|name| comments.contains(*name));
    found.map(|name| (*name).to_owned())
}

/// Fails if there are more links or joints than a robot has.
fn few_enough(count: usize) -> Result<()> {
    if count <= MOST_LINKS {
        return Ok(());
    }
    Err(Problem::TooLarge { what: "links or joints", found: count, most: MOST_LINKS }.into())
}

/// The requirements of both formats: few enough links, different names, numbers of a robot's size,
/// joints that are a tree.
fn check(robot: &Description) -> Result<()> {
    few_enough(robot.links.len().max(robot.joints.len()))?;
    let links = robot.links.iter().map(|link| (&link.name, link.line));
    let joints = robot.joints.iter().map(|joint| (&joint.name, joint.line));
    unique("link", links)?;
    unique("joint", joints)?;
    sizes(robot)?;
    tree(robot)
}

fn unique<'a>(what: &'static str, names: impl Iterator<Item = (&'a String, u32)>) -> Result<()> {
    let mut lines = HashMap::new();
    for (name, line) in names {
        if lines.insert(name, line).is_some() {
            let element = format!("{what} `{}`", shortened(name));
            return Err(ImportError::at(line, element, Problem::Duplicate(what)));
        }
    }
    Ok(())
}

/// A number by the name that its format has for it, and the largest size that it may have.
type Bounded = (&'static str, f64, f64);

/// The number that is beyond its bound, in words.
fn beyond(numbers: impl IntoIterator<Item = Bounded>) -> Option<String> {
    let mut all = numbers.into_iter();
    let (name, x, most) = all.find(|(_, x, most)| x.is_nan() || x.abs() > *most)?;
    Some(format!("`{name}` is {x:e}, at most {most:e} in size"))
}

/// The parts of a placement, by the names of a format.
fn of_pose(format: Format, pose: &Pose) -> impl Iterator<Item = Bounded> {
    let [position, turn] = match format {
        Format::Urdf => ["xyz", "rpy"],
        Format::Mjcf => ["pos", "quat"],
    };
    let turns = pose.rotation.to_cols_array().map(|x| (turn, x, MOST));
    pose.position.to_array().map(|x| (position, x, MOST)).into_iter().chain(turns)
}

/// Numbers with which f64 does not overflow, and axes that are directions.
fn sizes(robot: &Description) -> Result<()> {
    for link in &robot.links {
        let Some(inertial) = &link.inertial else {
            continue;
        };
        let names = match robot.format {
            Format::Urdf => ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"],
            Format::Mjcf => {
                ["inertia xx", "inertia xy", "inertia xz", "inertia yy", "inertia yz", "inertia zz"]
            }
        };
        let entries = names.into_iter().zip(inertial.inertia).map(|(name, x)| (name, x, MOST));
        let all = [("mass", inertial.mass, MOST)]
            .into_iter()
            .chain(of_pose(robot.format, &inertial.frame));
        let problem = match beyond(all.chain(entries)) {
            Some(problem) => problem,
            None if inertial.mass < 0.0 => format!("its mass is {} kg", inertial.mass),
            None if 0.0 < inertial.mass && inertial.mass < LEAST => {
                format!(
                    "its mass is {:e} kg, which f32 does not compute with: at least {LEAST:e} kg, \
                     or 0",
                    inertial.mass
                )
            }
            None => continue,
        };
        let element = format!("link `{}`", shortened(&link.name));
        return Err(ImportError::at(link.line, element, Problem::Value(problem)));
    }
    for joint in &robot.joints {
        let friction = match robot.format {
            Format::Urdf => "friction",
            Format::Mjcf => "frictionloss",
        };
        let of_joint = [
            ("damping", joint.damping, MOST_OF_JOINT),
            (friction, joint.friction, MOST_OF_JOINT),
            ("armature", joint.armature, MOST_OF_JOINT),
            ("stiffness of its spring", joint.spring[0], MOST_OF_JOINT),
            ("reference of its spring", joint.spring[1], MOST),
        ];
        let axis = joint.axis.length();
        let problem = match beyond(of_pose(robot.format, &joint.origin).chain(of_joint)) {
            Some(problem) => problem,
            None if joint.kind.has_axis() && !(1e-6..1e6).contains(&axis) => {
                format!("its axis has the length {axis}")
            }
            None if joint.kind == Kind::Planar && joint.axis.normalize_or_zero() != DVec3::Z => {
                "the normal of a planar joint has to be z: turn its frame".to_owned()
            }
            None => continue,
        };
        let element = format!("joint `{}`", shortened(&joint.name));
        return Err(ImportError::at(joint.line, element, Problem::Value(problem)));
    }
    Ok(())
}

/// Each link is the child of one joint at most, one of none, and all are below that one.
fn tree(robot: &Description) -> Result<()> {
    let mut joint_of = vec![None; robot.links.len()];
    for (j, joint) in robot.joints.iter().enumerate() {
        let name = || shortened(&robot.links[joint.child].name);
        let at = |problem| {
            let element = format!("joint `{}`", shortened(&joint.name));
            ImportError::at(joint.line, element, problem)
        };
        if joint_of[joint.child].replace(j).is_some() {
            return Err(at(Problem::TwoParents(name())));
        }
        if joint.child == joint.parent {
            return Err(at(Problem::Cycle(name())));
        }
    }
    let roots = robot.links.iter().zip(&joint_of);
    let roots = roots.filter(|(_, joint)| joint.is_none());
    let roots: Vec<&str> = roots.map(|(link, _)| link.name.as_str()).collect();
    if roots.is_empty() && robot.links.is_empty() {
        return Err(Problem::MissingElement("link").into());
    }
    // Marks: 0 not reached, i + 1 reached from link i first.
    let mut marks = vec![0; robot.links.len()];
    for i in 0..robot.links.len() {
        let mut at = i;
        while marks[at] == 0 {
            marks[at] = i + 1;
            match joint_of[at] {
                Some(j) => at = robot.joints[j].parent,
                None => break,
            }
        }
        if marks[at] == i + 1 && joint_of[at].is_some() {
            let joint = &robot.joints[joint_of[at].unwrap_or_default()];
            let element = format!("joint `{}`", shortened(&joint.name));
            let name = shortened(&robot.links[at].name);
            return Err(ImportError::at(joint.line, element, Problem::Cycle(name)));
        }
    }
    if roots.len() != 1 {
        let some = roots.iter().take(5).map(|name| shortened(name));
        let some = some.collect::<Vec<_>>().join(", ");
        return Err(Problem::Roots(roots.len(), some).into());
    }
    Ok(())
}
