//! Torques by Pinocchio or MuJoCo, where a Python has them.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use super::{Checked, largest};
use crate::description::Description;
use crate::selection::{Role, Selected};
use crate::tree::Tree;

const SCRIPT: &str = include_str!("peer.py");

/// The comparison with a peer.
#[derive(Clone, Debug, Serialize)]
pub struct Peer {
    /// Its name and version.
    pub name: String,
    /// The largest difference of torques, of full scale.
    pub difference: f64,
}

#[derive(Serialize)]
struct Request<'a> {
    path: &'a Path,
    format: String,
    joints: Vec<Moving<'a>>,
    locked: Vec<(&'a str, f64)>,
    motions: Vec<Values<'a>>,
}

#[derive(Serialize)]
struct Moving<'a> {
    name: &'a str,
    kind: String,
    coordinates: [usize; 2],
}

#[derive(Serialize)]
struct Values<'a> {
    q: &'a [f64],
    qd: &'a [f64],
    qdd: &'a [f64],
}

#[derive(Deserialize)]
struct Answer {
    name: String,
    torques: Vec<Vec<f64>>,
}

/// The torques of a check compared with those of a peer; why not, if there is none.
///
/// # Errors
/// A sentence: the Python has no such package, or the peer cannot read the file.
pub fn compare(
    python: &str,
    path: &Path,
    robot: &Description,
    selected: &Selected,
    tree: &Tree,
    checked: &Checked,
) -> Result<Peer, String> {
    let joints = tree.bodies.iter().map(|body| Moving {
        name: &body.joint,
        kind: format!("{:?}", body.kind),
        coordinates: body.kind.coordinates(),
    });
    let locked = selected
        .order
        .iter()
        .filter_map(|&j| match selected.roles[j] {
            Role::Locked(position) if position != 0.0 => {
                Some((robot.joints[j].name.as_str(), position))
            }
            _ => None,
        });
    let motions = checked.samples.iter().map(|(motion, _)| Values {
        q: &motion.q,
        qd: &motion.qd,
        qdd: &motion.qdd,
    });
    let request = Request {
        path,
        format: format!("{:?}", robot.format),
        joints: joints.collect(),
        locked: locked.collect(),
        motions: motions.collect(),
    };
    let request = serde_json::to_vec(&request).map_err(|error| error.to_string())?;
    let output = run(python, &request).map_err(|error| format!("{python}: {error}"))?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        let last = text.lines().rev().find(|line| !line.trim().is_empty());
        return Err(format!("{python}: {}", last.unwrap_or("no message").trim()));
    }
    let start = output
        .stdout
        .iter()
        .position(|&byte| byte == b'{')
        .unwrap_or_default();
    let answer: Answer =
        serde_json::from_slice(&output.stdout[start..]).map_err(|error| error.to_string())?;
    if answer.torques.len() != checked.samples.len() {
        return Err("the peer answered for another number of states".to_owned());
    }
    let pairs = checked.samples.iter().zip(&answer.torques);
    let difference = pairs.fold(0.0, |most: f64, ((_, own), theirs)| {
        match own.len() == theirs.len() {
            true => most.max(largest(own, theirs)),
            false => f64::INFINITY,
        }
    });
    let scale = if checked.full_scale > 0.0 {
        checked.full_scale
    } else {
        1.0
    };
    Ok(Peer {
        name: answer.name,
        difference: difference / scale,
    })
}

fn run(python: &str, request: &[u8]) -> std::io::Result<std::process::Output> {
    let mut child = Command::new(python)
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    if let Some(mut stdin) = child.stdin.take() {
        // A peer that ends early says why on stderr.
        let _ = stdin.write_all(request);
    }
    child.wait_with_output()
}
