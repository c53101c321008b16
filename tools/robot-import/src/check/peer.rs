//! Torques by Pinocchio or MuJoCo, where a Python has them.
//!
//! A description from elsewhere is hostile until it is read. The Python is isolated: it sees
//! neither the current folder nor the user's variables and packages, runs in an empty folder of its
//! own, and has bounds of time and output. It gets the text of the description as data on its
//! stdin, so that a peer opens no file for it.

use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::process::{Bounds, Ended, Failure, run};
use super::{Checked, largest};
use crate::description::{Description, Kind};
use crate::limits::{MOST_ANSWER, MOST_COMPLAINTS};
use crate::selection::{Role, Selected};
use crate::tree::Tree;

const SCRIPT: &str = include_str!("peer.py");
/// The exit status of the script where there is no package, or a kind of joint that it does not
/// compare.
const NO_PEER: i32 = 3;

/// The Python that has the peers.
#[derive(Clone, Debug)]
pub struct Python {
    /// The program that was called.
    pub program: String,
    /// Whether it sees PYTHONPATH and the packages of the user's own folder.
    pub environment: bool,
    /// The time that a comparison may take.
    pub time: Duration,
}

/// The comparison with a peer.
#[derive(Clone, Debug, Serialize)]
pub struct Peer {
    /// The name and the version of the library.
    pub name: String,
    /// The largest difference of torques, of full scale.
    pub difference: f64,
    /// The joint with the largest difference.
    #[serde(skip)]
    pub joint: String,
    /// Its words on the description, such as a part that it leaves out; empty if nothing.
    #[serde(skip)]
    pub complaint: String,
}

/// Why there is no comparison, a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoPeer {
    /// There is no peer, or it has not all of the robot's kinds of joints.
    Absent(String),
    /// There may be one, but it did not answer: its user should know.
    Failed(String),
}

impl NoPeer {
    /// The sentence that gives the reason.
    pub fn reason(&self) -> &str {
        match self {
            Self::Absent(reason) | Self::Failed(reason) => reason,
        }
    }
}

#[derive(Serialize)]
struct Request<'a> {
    text: &'a str,
    format: String,
    joints: Vec<Moving<'a>>,
    locked: Vec<Locked<'a>>,
    motions: Vec<Values<'a>>,
}

#[derive(Serialize)]
struct Moving<'a> {
    name: &'a str,
    /// Its number among the joints of the file that are not fixed.
    index: usize,
    kind: String,
    coordinates: [usize; 2],
}

#[derive(Serialize)]
struct Locked<'a> {
    name: &'a str,
    index: usize,
    /// The position coordinates of the state.
    position: Vec<f64>,
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

/// The torques of a check compared with those of a peer, which reads `text`; why not, if there is
/// none.
///
/// # Errors
/// [`NoPeer`].
pub fn compare(
    python: &Python,
    text: &str,
    robot: &Description,
    selected: &Selected,
    tree: &Tree,
    checked: &Checked,
) -> Result<Peer, NoPeer> {
    if python.program == "none" {
        return Err(NoPeer::Absent("none is wanted".to_owned()));
    }
    let failed = |reason: String| NoPeer::Failed(format!("{}: {reason}", python.program));
    let request = serde_json::to_vec(&request(text, robot, selected, tree, checked));
    let request = request.map_err(|error| failed(error.to_string()))?;
    let ended = started(python, request)?;
    if ended.code != Some(0) {
        let last = last_line(&ended.messages);
        return Err(match ended.code {
            Some(NO_PEER) => NoPeer::Absent(format!("{}: {last}", python.program)),
            _ => failed(last),
        });
    }
    let answer: Answer = serde_json::from_slice(&ended.stdout)
        .map_err(|error| failed(format!("its answer is none: {error}")))?;
    if answer.torques.len() != checked.samples.len() {
        return Err(failed("it answered for another number of states".to_owned()));
    }
    let mut peer = difference(&answer, tree, checked);
    peer.complaint = complaint(&ended.messages);
    Ok(peer)
}

/// The comparison of an answer.
fn difference(answer: &Answer, tree: &Tree, checked: &Checked) -> Peer {
    let joints = tree.bodies.iter();
    let joints: Vec<&str> =
        joints.flat_map(|body| vec![body.joint.as_str(); body.kind.coordinates()[1]]).collect();
    let (mut most, mut joint) = (0.0, "");
    for ((_, own), theirs) in checked.samples.iter().zip(&answer.torques) {
        if own.len() != theirs.len() {
            most = f64::INFINITY;
        }
        for ((own, theirs), name) in own.iter().zip(theirs).zip(&joints) {
            let apart = largest(&[*own], &[*theirs]);
            if apart > most {
                (most, joint) = (apart, name);
            }
        }
    }
    let scale = if checked.full_scale > 0.0 { checked.full_scale } else { 1.0 };
    Peer {
        name: printable(&answer.name),
        difference: most / scale,
        joint: joint.to_owned(),
        complaint: String::new(),
    }
}

fn request<'a>(
    text: &'a str,
    robot: &'a Description,
    selected: &Selected,
    tree: &'a Tree,
    checked: &'a Checked,
) -> Request<'a> {
    let moving = |j: usize| robot.joints[j].kind != Kind::Fixed;
    let index = |j: usize| (0..j).filter(|&other| moving(other)).count();
    let joints = tree.bodies.iter().map(|body| Moving {
        name: &body.joint,
        // A free base is no joint of the file.
        index: robot.joint(&body.joint).map_or(0, index),
        kind: format!("{:?}", body.kind),
        coordinates: body.kind.coordinates(),
    });
    let locked = (0..robot.joints.len()).filter_map(|j| match selected.roles[j] {
        Role::Locked(position) if moving(j) => Some(Locked {
            name: &robot.joints[j].name,
            index: index(j),
            position: locked_at(robot.joints[j].kind, position),
        }),
        _ => None,
    });
    let motions = checked.samples.iter().map(|(motion, _)| Values {
        q: &motion.q,
        qd: &motion.qd,
        qdd: &motion.qdd,
    });
    Request {
        text,
        format: format!("{:?}", robot.format),
        joints: joints.collect(),
        locked: locked.collect(),
        motions: motions.collect(),
    }
}

/// The q of a locked joint: only those with an axis are locked elsewhere than at zero.
fn locked_at(kind: Kind, position: f64) -> Vec<f64> {
    match kind.coordinates()[0] {
        1 => vec![position],
        // A quaternion is before the position.
        n @ (4 | 7) => (0..n).map(|k| if k == 3 { 1.0 } else { 0.0 }).collect(),
        n => vec![0.0; n],
    }
}

/// The script on a request, isolated and within its bounds.
fn started(python: &Python, request: Vec<u8>) -> Result<Ended, NoPeer> {
    let failed = |reason: String| NoPeer::Failed(format!("{}: {reason}", python.program));
    // Not the current folder, where modules may be that came with the description; MuJoCo writes
    // its log there, too.
    let folder = tempfile::tempdir().map_err(|error| failed(error.to_string()))?;
    let isolation: &[&str] = match python.environment {
        // Without -P, which Python has from 3.11 on, the script itself takes the folder from its
        // path.
        true => &[],
        false => &["-I"],
    };
    let mut command = Command::new(absolute(&python.program));
    command.args(isolation).args(["-c", SCRIPT]).current_dir(folder.path());
    let bounds = Bounds { time: python.time, bytes: MOST_ANSWER };
    run(&mut command, request, bounds).map_err(|failure| match failure {
        Failure::System(error) if error.kind() == std::io::ErrorKind::NotFound => {
            NoPeer::Absent(format!("{}: {error}", python.program))
        }
        Failure::System(error) => failed(error.to_string()),
        Failure::Time => failed(format!(
            "it had not answered after {} s and was ended; `--peer-time` gives it more",
            python.time.as_secs_f64()
        )),
        Failure::Bytes => {
            failed(format!("it wrote more than {} MB and was ended", MOST_ANSWER >> 20))
        }
    })
}

/// A program by its path holds in another folder, too; one by its name is found as ever.
fn absolute(program: &str) -> PathBuf {
    let given = PathBuf::from(program);
    match given.components().count() {
        0 | 1 => given,
        _ => std::path::absolute(&given).unwrap_or(given),
    }
}

/// The last line of some messages, of which the texts may be the description's.
fn last_line(messages: &[u8]) -> String {
    let text = String::from_utf8_lossy(messages);
    let last = text.lines().rev().find(|line| !line.trim().is_empty());
    printable(last.unwrap_or("no message"))
}

/// The first messages, without the places in the peer's own source.
fn complaint(messages: &[u8]) -> String {
    let text = String::from_utf8_lossy(messages);
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("at line"));
    let mut shown: Vec<String> = Vec::new();
    for line in lines.map(printable).filter(|line| !line.is_empty()) {
        if !shown.contains(&line) && shown.len() < MOST_COMPLAINTS {
            shown.push(line);
        }
    }
    shown.join("; ")
}

/// A text of another program for a message: short, and without what moves a terminal's cursor.
fn printable(text: &str) -> String {
    let plain: String = text.trim().chars().filter(|c| !c.is_control()).collect();
    match plain.chars().count() {
        0..=200 => plain,
        _ => plain.chars().take(200).chain(['…']).collect(),
    }
}
