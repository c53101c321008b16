//! Joints that close loops, on the bodies of a tree.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use crate::description::{Description, Kind, Pose, most_similar, shortened};
use crate::error::{Problem, Result};
use crate::number::{Attitude, tidy};
use crate::text::string_literal;
use crate::tree::{Body, Tree};
use crate::write::placed;

/// A joint that closes a loop.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Closed {
    /// Its index in the description.
    pub source: usize,
    /// The name of the loop.
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
            [Some(a), Some(b)] if a.0 != b.0 => {
                all.push(Closed { source, name: one.name.clone(), kind: one.kind, ends: [a, b] })
            }
            [Some(_), Some(_)] => {
                notes.push(format!("Loop `{}` is left out: both ends are on one body.", one.name));
            }
            _ => notes
                .push(format!("Loop `{}` is left out: an end is not part of the robot.", one.name)),
        }
    }
    (all, notes)
}

/// The actuated coordinates of a machine with loops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motors {
    /// The indices of the actuated coordinates in q̇.
    pub actuated: Vec<usize>,
    /// Which they are, a sentence.
    pub which: &'static str,
    /// A note for its user, if the file does not say which they are.
    pub advice: Option<String>,
}

impl Motors {
    /// Those of some joints if there are names, otherwise those that the file drives; all where
    /// these are too few.
    ///
    /// # Errors
    /// A name that no moving joint has, or fewer joints than the library takes.
    pub fn of(tree: &Tree, loops: &[Closed], names: &[String]) -> Result<Self> {
        let moving = tree.bodies.iter().map(|body| body.joint.as_str());
        if let Some(name) = names.iter().find(|name| !moving.clone().any(|joint| joint == **name)) {
            let like = most_similar(name, moving)
                .map_or(String::new(), |like| format!("; did you mean `{}`?", shortened(like)));
            let name = shortened(name);
            let problem = format!("`--motors {name}`: no joint of this name moves{like}");
            return Err(Problem::Value(problem).into());
        }
        if let (false, true) = (names.is_empty(), loops.is_empty()) {
            let problem = "`--motors`: the robot has no loop, and its torques are those of all \
                           joints: that of a joint without a motor is zero";
            return Err(Problem::Value(problem.to_owned()).into());
        }
        let of = |driven: &dyn Fn(&Body) -> bool| {
            let (mut all, mut first) = (Vec::new(), 0);
            for body in &tree.bodies {
                let own = first..first + body.kind.coordinates()[1];
                first = own.end;
                if driven(body) {
                    all.extend(own);
                }
            }
            all
        };
        if loops.is_empty() {
            return Ok(Self {
                actuated: of(&|_| true),
                which: "Every coordinate has a motor.",
                advice: None,
            });
        }
        let [_, v] = tree.coordinates();
        // At least this many coordinates move freely; the library asks for as many motors.
        let least = v.saturating_sub(rows(loops)).max(1);
        if !names.is_empty() {
            let actuated = of(&|body| names.contains(&body.joint));
            if actuated.len() < least {
                let given = actuated.len();
                let problem = format!(
                    "`--motors` has {given} coordinates, and at least {least} move freely: name \
                     more joints"
                );
                return Err(Problem::Value(problem).into());
            }
            return Ok(Self {
                actuated,
                which: "The actuated coordinates are those of the joints that were named as \
                    driven.",
                advice: None,
            });
        }
        let actuated = of(&|body| body.driven);
        if actuated.len() >= least {
            return Ok(Self {
                actuated,
                which: "The actuated coordinates are those of the joints with a motor.",
                advice: None,
            });
        }
        let driven = match actuated.len() {
            0 => "The file has no motor on a joint of its machine with loops".to_owned(),
            n => format!("The file has motors on {n} coordinates of its machine with loops"),
        };
        Ok(Self {
            actuated: of(&|_| true),
            which: "The file has too few motors: every coordinate is taken as actuated.",
            advice: Some(format!(
                "{driven}, and at least {least} move freely: every joint is taken as driven. \
                 `--motors A,B` names those with a motor, or `<motor joint=…/>` in the file."
            )),
        })
    }
}

/// The number of directions that the loops constrain.
fn rows(loops: &[Closed]) -> usize {
    let each = loops.iter();
    each.map(|one| if one.kind == Kind::Fixed { 6 } else { 3 }).sum()
}

/// The `impl LoopRobot` of a tree with loops; empty without loops.
pub fn source(tree: &Tree, type_name: &str, loops: &[Closed], motors: &Motors) -> String {
    if loops.is_empty() {
        return String::new();
    }
    let [q, v] = tree.coordinates();
    let actuated: Vec<String> = motors.actuated.iter().map(usize::to_string).collect();
    let sizes = format!("{}, {}, {}", loops.len(), rows(loops), actuated.len());
    let mut joints = String::new();
    for one in loops {
        let kind = if one.kind == Kind::Fixed { "fixed" } else { "spherical" };
        let frames: Vec<String> = one.ends.iter().map(frame).collect();
        let _ = writeln!(
            joints,
            "LoopJoint::new({}, Joint::{kind}(), [{}]),",
            string_literal(&one.name),
            frames.join(", ")
        );
    }
    format!(
        "\nuse ::dynamics_core::loops::{{BodyFrame, LoopJoint, LoopRobot, Loops}};\n\n\
         impl LoopRobot<{b}, {q}, {v}, {sizes}> for {type_name} {{\n\
         /// {which}\n\
         const LOOPS: Loops<{sizes}> = Loops::new(&{type_name}::MODEL, [{joints}], \
         [{actuated}]);\n}}\n\n\
         const _: Loops<{sizes}> = {type_name}::LOOPS;\n",
        b = tree.bodies.len(),
        actuated = actuated.join(", "),
        which = motors.which,
    )
}

fn frame((body, xyz, attitude): &(Option<usize>, [f64; 3], Attitude)) -> String {
    let body = body.map_or("BASE".to_owned(), |body| body.to_string());
    format!("BodyFrame::new({body}){}", placed(*xyz, *attitude))
}
