//! Files of descriptions, each format in a module.

mod mjcf;
mod urdf;
mod xacro;
pub mod xml;

use std::collections::HashMap;
use std::io::Read as _;
use std::path::Path;

use crate::description::{Description, shortened};
use crate::error::{ImportError, Problem, Result};

/// The most links of a robot.
pub const MOST_LINKS: usize = 2_000;
/// The largest length (m), mass (kg), inertia and other number.
const MOST: f64 = 1e9;
/// The stack, bytes, for the deepest nesting that is read, by an unoptimised build.
const STACK: usize = 32 << 20;

/// Runs what is recursive in the nesting of a file on a stack that is large enough, whichever thread calls.
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

/// The robot that a file describes.
///
/// # Errors
/// [`ImportError`] with the line and the element.
pub fn read(path: &Path) -> Result<Description> {
    parse(&text(path)?, folder(path))
}

/// The folder of a file.
fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new("."))
}

/// The description in a file as another reader is given it: a URDF as it is, an MJCF with its included files and without the
/// names of others, so that the reader opens none.
///
/// # Errors
/// As [`read`].
pub fn for_peer(path: &Path) -> Result<String> {
    let text = text(path)?;
    let text = text.trim_start_matches('\u{feff}');
    on_a_large_stack(|| {
        let document = xml::parse(text)?;
        match document.root_element().tag_name().name() {
            "mujoco" => mjcf::text::of(document.root_element(), folder(path)),
            _ => Ok(text.to_owned()),
        }
    })
}

/// The text of a file that is not too large.
fn text(path: &Path) -> Result<String> {
    let unreadable = |reason: std::io::Error| Problem::File {
        path: path.display().to_string(),
        reason: reason.to_string(),
    };
    let length = std::fs::metadata(path).map_err(unreadable)?.len();
    if length > xml::MOST_BYTES as u64 {
        return Err(Problem::TooLarge {
            what: "bytes in the file",
            found: length as usize,
            most: xml::MOST_BYTES,
        }
        .into());
    }
    // What is no file, such as a pipe, has no length.
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let mut text = String::new();
    file.take(xml::MOST_BYTES as u64 + 1)
        .read_to_string(&mut text)
        .map_err(unreadable)?;
    Ok(text)
}

/// The robot that a text describes; other files that it names are in `folder`.
///
/// # Errors
/// [`ImportError`] with the line and the element.
pub fn parse(text: &str, folder: &Path) -> Result<Description> {
    on_a_large_stack(|| described(text, folder))
}

fn described(text: &str, folder: &Path) -> Result<Description> {
    let text = text.trim_start_matches('\u{feff}');
    let document = xml::parse(text)?;
    let root = document.root_element();
    let mut robot = match root.tag_name().name() {
        "robot" => urdf::read(root)?,
        "mujoco" => mjcf::read(root, folder)?,
        _ => return Err(xml::error(root, Problem::Format)),
    };
    if robot.licence.is_none() {
        robot.licence = licence(text);
    }
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
    let comments: String = comments
        .filter_map(|part| part.split("-->").next())
        .collect();
    let found = names.iter().find(|name| comments.contains(*name));
    found.map(|name| (*name).to_owned())
}

/// Fails if there are more links or joints than a robot has.
fn few_enough(count: usize) -> Result<()> {
    if count <= MOST_LINKS {
        return Ok(());
    }
    Err(Problem::TooLarge {
        what: "links or joints",
        found: count,
        most: MOST_LINKS,
    }
    .into())
}

/// What both formats require: few enough links, different names, numbers of a robot's size, joints that are a tree.
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

/// The largest size of some numbers; infinite if one is not a number.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |most: f64, x| {
        if x.is_nan() {
            f64::INFINITY
        } else {
            most.max(x.abs())
        }
    })
}

/// Numbers with which f64 does not overflow, and axes that are directions.
fn sizes(robot: &Description) -> Result<()> {
    for link in &robot.links {
        let Some(inertial) = &link.inertial else {
            continue;
        };
        let position = inertial.frame.position.to_array();
        let all = [inertial.mass].into_iter().chain(position);
        let turn = inertial.frame.rotation.to_cols_array();
        let largest = largest(all.chain(inertial.inertia).chain(turn));
        let problem = match () {
            () if largest > MOST => format!("a number of its inertia is {largest:e}"),
            () if inertial.mass < 0.0 => format!("its mass is {} kg", inertial.mass),
            () => continue,
        };
        let element = format!("link `{}`", shortened(&link.name));
        return Err(ImportError::at(link.line, element, Problem::Value(problem)));
    }
    for joint in &robot.joints {
        let all = joint.origin.position.to_array().into_iter();
        let all = all.chain([joint.damping, joint.friction, joint.armature]);
        let turn = joint.origin.rotation.to_cols_array();
        let largest = largest(all.chain(turn));
        let axis = joint.axis.length();
        let problem = match () {
            () if largest > MOST => format!("a number of it is {largest:e}"),
            () if joint.kind.has_axis() && !(1e-6..1e6).contains(&axis) => {
                format!("its axis has the length {axis}")
            }
            () if joint.kind == crate::description::Kind::Planar
                && joint.axis.normalize_or_zero() != dynamics_core::glam::DVec3::Z =>
            {
                "the normal of a planar joint has to be z: turn its frame".to_owned()
            }
            () => continue,
        };
        let element = format!("joint `{}`", shortened(&joint.name));
        return Err(ImportError::at(
            joint.line,
            element,
            Problem::Value(problem),
        ));
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
