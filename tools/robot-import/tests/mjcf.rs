//! The reader of MJCF against MuJoCo: `mjcf_oracle.py` writes `mjcf/recorded.json`.
//!
//! The tree is walked here by the frames of the description alone; nothing of the reader is used
//! for it.

mod exact;
mod hostile;
mod refused;
#[path = "mjcf/walk.rs"]
mod walk;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use dynamics_core::glam::DVec3;
use robot_import::description::{Description, Kind};
use serde::Deserialize;
use walk::{State, Walked};

/// A recording.
#[derive(Deserialize)]
struct Recorded {
    models: HashMap<String, Model>,
}

#[derive(Deserialize)]
struct Model {
    joints: HashMap<String, Properties>,
    states: Vec<State>,
}

#[derive(Deserialize)]
struct Properties {
    kind: String,
    range: Option<[f64; 2]>,
    damping: f64,
    friction: f64,
    armature: f64,
    effort: Option<f64>,
}

/// The bound of each number, relative where it is greater than 1.
const BOUND: f64 = 1e-9;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mjcf")
}

/// The differences of a description and the recording, a sentence each.
fn differences(robot: &Description, model: &Model) -> Vec<String> {
    let mut found = Vec::new();
    let mut compare = |what: String, ours: &[f64], theirs: &[f64]| {
        let scale = theirs.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        let near = ours.len() == theirs.len()
            && ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() <= BOUND * scale);
        if !near {
            found.push(format!("{what}: {ours:?}, recorded {theirs:?}"));
        }
    };
    for (name, properties) in &model.joints {
        let Ok(index) = robot.joint(name) else {
            compare(format!("joint {name}"), &[], &[1.0]);
            continue;
        };
        let joint = &robot.joints[index];
        let kind = match joint.kind {
            Kind::Revolute | Kind::Continuous => "hinge",
            Kind::Prismatic => "slide",
            Kind::Spherical => "ball",
            Kind::Free => "free",
            Kind::Fixed | Kind::Planar => "other",
        };
        let same = f64::from(u8::from(kind == properties.kind));
        compare(format!("kind of {name}"), &[same], &[1.0]);
        let range = joint.limits.position.map_or(vec![], |range| range.to_vec());
        let recorded = properties.range.filter(|_| joint.kind.has_axis());
        compare(
            format!("range of {name}"),
            &range,
            &recorded.map_or(vec![], |range| range.to_vec()),
        );
        let ours = [joint.damping, joint.friction, joint.armature];
        let theirs = [properties.damping, properties.friction, properties.armature];
        compare(format!("damping, friction and armature of {name}"), &ours, &theirs);
        let [ours, theirs] = [joint.limits.effort, properties.effort];
        let vector = |effort: Option<f64>| effort.into_iter().collect::<Vec<_>>();
        compare(format!("effort of {name}"), &vector(ours), &vector(theirs));
    }
    for (i, state) in model.states.iter().enumerate() {
        let walked = Walked::new(robot, state);
        for (name, body) in &state.bodies {
            let Some((mass, com, inertia)) = walked.body(robot, name) else {
                compare(format!("body {name}"), &[], &[1.0]);
                continue;
            };
            compare(format!("mass of {name}"), &[mass], &[body.mass]);
            // Without mass there is no centre of it.
            if body.mass > 0.0 {
                compare(format!("centre of {name} in state {i}"), &com, &body.com);
                compare(format!("inertia of {name} in state {i}"), &inertia, &body.inertia);
            }
        }
        for (name, joint) in &state.joints {
            let Some((kind, anchor, axis)) = walked.joint(robot, name) else {
                continue;
            };
            // A slide's anchor is any point of its line; free joints have none.
            let across = |point: [f64; 3]| {
                let [point, axis] = [point, joint.axis].map(DVec3::from_array);
                (point - axis * axis.dot(point)).to_array()
            };
            match kind {
                Kind::Free => {}
                Kind::Prismatic => compare(
                    format!("line of {name} in state {i}"),
                    &across(anchor),
                    &across(joint.anchor),
                ),
                _ => compare(format!("anchor of {name} in state {i}"), &anchor, &joint.anchor),
            }
            if kind.has_axis() {
                compare(format!("axis of {name} in state {i}"), &axis, &joint.axis);
            }
        }
        for (name, residual) in &state.residuals {
            let ours = walked.residual(robot, state, name);
            // Only the absolute value of a rotation is the same for all conventions.
            let theirs: Vec<f64> = match residual.as_slice() {
                [x, y, z, rotation @ ..] if rotation.len() == 3 => {
                    let square: f64 = rotation.iter().map(|x| x * x).sum();
                    vec![*x, *y, *z, square.sqrt()]
                }
                other => other.to_vec(),
            };
            compare(format!("constraint {name} in state {i}"), &ours, &theirs);
        }
    }
    found
}

fn recorded(path: &Path) -> Recorded {
    let text = std::fs::read_to_string(path).expect("a recording");
    serde_json::from_str(&text).expect("a recording")
}

#[test]
fn descriptions_move_as_in_mujoco() {
    let recorded = recorded(&folder().join("recorded.json"));
    assert_eq!(recorded.models.len(), 19);
    let mut all = Vec::new();
    for (file, model) in &recorded.models {
        let robot = robot_import::source::read(&folder().join(file));
        let robot = robot.unwrap_or_else(|error| panic!("{file}: {error}"));
        let found = differences(&robot, model);
        all.extend(found.into_iter().map(|found| format!("{file}: {found}")));
    }
    assert!(all.is_empty(), "{} differences:\n{}", all.len(), all.join("\n"));
}

/// The comparison finds what it is for: each of these changes of a fixture's text is a difference.
#[test]
fn a_change_of_a_text_is_a_difference() {
    let recorded = recorded(&folder().join("recorded.json"));
    let changes = [
        ("default_classes.xml", "childclass=\"arm\"", "childclass=\"wrist\""),
        ("joints_of_a_body.xml", "pos=\"0.1 0 -0.2\"", "pos=\"0.1 0 -0.1999999\""),
        ("euler_moving_axes.xml", "\"zyx\"", "\"ZYX\""),
        ("fullinertia.xml", "0.01 -0.02 0.005", "0.01 0.005 -0.02"),
        ("geoms.xml", "density=\"2700\"", "density=\"2700.00001\""),
        ("reference.xml", "ref=\"30\"", "ref=\"30.00001\""),
        ("equality.xml", "polycoef=\"0.3 -2", "polycoef=\"0.3 -2.0000001"),
        ("equality.xml", "anchor=\"0.1 0.2 -0.1\"", "anchor=\"0.1 0.2 -0.1000001\""),
        ("actuators.xml", "gear=\"-5\"", "gear=\"-5.00001\""),
        ("total_mass.xml", "settotalmass=\"7\"", "settotalmass=\"7.0000001\""),
    ];
    for (file, from, to) in changes {
        let text = std::fs::read_to_string(folder().join(file)).expect("a fixture");
        assert!(text.contains(from), "{file} has no {from}");
        let robot = robot_import::source::parse(&text.replacen(from, to, 1), &folder());
        let robot = robot.expect("a model");
        assert!(!differences(&robot, &recorded.models[file]).is_empty(), "{file}: {to}");
    }
}

/// The same of other models: `MJCF_RECORDED` names a recording that
/// `mjcf_oracle.py OUT.json FILE...` has written.
#[test]
#[ignore = "needs a recording of models that are not in the repository"]
fn other_models_move_as_in_mujoco() {
    let path = std::env::var("MJCF_RECORDED").expect("MJCF_RECORDED");
    let mut bad = 0;
    for (file, model) in &recorded(Path::new(&path)).models {
        match robot_import::source::read(Path::new(file)) {
            Err(error) => println!("refused {file}: {error}"),
            Ok(robot) => {
                let found = differences(&robot, model);
                let (links, joints) = (robot.links.len(), model.joints.len());
                let mut notes = robot.notes.clone();
                notes.sort();
                println!(
                    "read {file}: {links} links, {joints} joints, {} differences, notes: {notes:#?}",
                    found.len()
                );
                for found in found.iter().take(5) {
                    println!("    {found}");
                }
                bad += found.len();
            }
        }
    }
    assert_eq!(bad, 0);
}
