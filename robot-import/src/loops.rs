//! Joints that close loops, on the bodies of a tree.

use std::fmt::Write as _;

use crate::description::{Description, Kind, Pose};
use crate::number::{Attitude, tidy};
use crate::tree::Tree;
use crate::write::placed;

/// A joint that closes a loop.
#[derive(Clone, Debug)]
pub struct Closed {
    /// Its index in the description.
    pub source: usize,
    /// Its name.
    pub name: String,
    /// `Spherical` for a common point, `Fixed` for a common frame.
    pub kind: Kind,
    /// The bodies, none is the base, and the frames on them.
    pub ends: [(Option<usize>, [f64; 3], Attitude); 2],
}

/// The loops of a description on the bodies of a tree, and a sentence for each that is left out.
pub fn closed(robot: &Description, tree: &Tree) -> (Vec<Closed>, Vec<String>) {
    let (mut all, mut notes) = (Vec::new(), Vec::new());
    for (source, one) in robot.loops.iter().enumerate() {
        let ends = [0, 1].map(|i| {
            let (body, link) = tree.links[one.links[i]]?;
            let Pose { position, rotation } = link.then(&one.frames[i]);
            Some((body, position.to_array().map(tidy), Attitude::of(&rotation)))
        });
        match ends {
            [Some(a), Some(b)] if a.0 != b.0 => all.push(Closed {
                source,
                name: one.name.clone(),
                kind: one.kind,
                ends: [a, b],
            }),
            [Some(_), Some(_)] => {
                notes.push(format!(
                    "Loop `{}` is left out: both ends are on one body.",
                    one.name
                ));
            }
            _ => notes.push(format!(
                "Loop `{}` is left out: an end is not part of the robot.",
                one.name
            )),
        }
    }
    (all, notes)
}

/// The `impl LoopRobot` of a tree with loops, whose actuated coordinates are those of joints with a limit of torque; empty
/// without loops.
pub fn source(tree: &Tree, type_name: &str, loops: &[Closed]) -> String {
    if loops.is_empty() {
        return String::new();
    }
    let rows = loops
        .iter()
        .map(|one| if one.kind == Kind::Fixed { 6 } else { 3 });
    let [q, v] = tree.coordinates();
    let (mut actuated, mut first) = (Vec::new(), 0);
    for body in &tree.bodies {
        let own = first..first + body.kind.coordinates()[1];
        first = own.end;
        if body.limits.effort.is_some() {
            actuated.extend(own.map(|k| k.to_string()));
        }
    }
    let sizes = format!(
        "{}, {}, {}",
        loops.len(),
        rows.sum::<usize>(),
        actuated.len()
    );
    let mut joints = String::new();
    for one in loops {
        let kind = if one.kind == Kind::Fixed {
            "fixed"
        } else {
            "spherical"
        };
        let frames: Vec<String> = one.ends.iter().map(frame).collect();
        let _ = writeln!(
            joints,
            "LoopJoint::new({:?}, Joint::{kind}(), [{}]),",
            one.name,
            frames.join(", ")
        );
    }
    format!(
        "\nuse dynamics_core::loops::{{BodyFrame, LoopJoint, LoopRobot, Loops}};\n\n\
         impl LoopRobot<{b}, {q}, {v}, {sizes}> for {type_name} {{\n\
         /// The actuated coordinates are those of the joints with a limit of torque.\n\
         const LOOPS: Loops<{sizes}> = Loops::new(&{type_name}::MODEL, [{joints}], [{actuated}]);\n}}\n\n\
         const _: Loops<{sizes}> = {type_name}::LOOPS;\n",
        b = tree.bodies.len(),
        actuated = actuated.join(", "),
    )
}

fn frame((body, xyz, attitude): &(Option<usize>, [f64; 3], Attitude)) -> String {
    let body = body.map_or("BASE".to_owned(), |body| body.to_string());
    format!("BodyFrame::new({body}){}", placed(*xyz, *attitude))
}
