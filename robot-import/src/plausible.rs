//! Numbers of a robot that look like another unit, or ask more of its motors than they have:
//! [`Model::advice`](dynamics_core::model::Model::advice) of the imported robot, with the file's names and lines.

use dynamics_core::advice::{self as library, AdvisedJoint};

use crate::advice::{Advice, Topic};
use crate::model::AnyModel;
use crate::tree::{Body, Tree};

/// The advice of the library; none for a tree that is too large for it.
pub fn plausible(tree: &Tree, robot: &str) -> Vec<Advice> {
    let all = AnyModel::of(tree).map_or(Vec::new(), |model| model.advice());
    // The importer's own advice on such limits knows the accelerations that a robot needs, too.
    let is_own =
        |advice: &&library::Advice| matches!(advice, library::Advice::TorqueLimitsFarAbove { .. });
    all.iter()
        .filter(|advice| !is_own(advice))
        .map(|advice| placed(advice, tree, robot))
        .collect()
}

/// With the joint's name and line in place of its number.
fn placed(advice: &library::Advice, tree: &Tree, robot: &str) -> Advice {
    let topic = match advice.is_about_units() {
        true => Topic::Units,
        false => Topic::Torque,
    };
    let body = advice.joint().and_then(|joint| of_coordinate(tree, joint));
    // The text begins with what it is about, which stands in a column of its own.
    let text = advice.to_string();
    let (_, reason) = text.split_once(": ").unwrap_or(("", &text));
    let mut letters = reason.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    Advice {
        topic,
        line: body.map_or(0, |body| body.line),
        name: body.map_or(robot, |body| &body.joint).to_owned(),
        text: first.chain(letters).chain(['.']).collect(),
    }
}

/// The body that a velocity coordinate moves.
fn of_coordinate(tree: &Tree, joint: AdvisedJoint) -> Option<&Body> {
    let mut first = 0;
    tree.bodies.iter().find(|body| {
        let [_, count] = body.kind.coordinates();
        let own = first..first + count;
        first += count;
        own.contains(&joint.number)
    })
}
