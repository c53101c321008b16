//! Numbers of a robot that look like another unit, or ask more of its motors than they have:
//! [`NumberAdvice`] on the imported robot, with the file's names and lines.

use dynamics_core::advice::AdvisedJoint;

use crate::advice::numbers::NumberAdvice;
use crate::advice::{Advice, FAR_GYRATION, Topic};
use crate::model::{AnyModel, number_of};
use crate::physical::capitalised;
use crate::tree::{Body, Tree};

/// The advice on a tree; none for one that is too large for the library.
pub fn plausible(tree: &Tree, robot: &str) -> Vec<Advice> {
    let all = AnyModel::of(tree).map_or(Vec::new(), |model| model.advice());
    all.iter()
        .filter(|advice| !is_covered(advice))
        .map(|advice| placed(advice, tree, robot))
        .collect()
}

/// Whether the advice on the file covers it: on limits of torque this knows the accelerations that a
/// robot needs, too, on inertias their links.
fn is_covered(advice: &NumberAdvice) -> bool {
    match advice {
        NumberAdvice::TorqueLimitsFarAbove { .. } | NumberAdvice::ImpossibleInertia { .. } => true,
        NumberAdvice::InertiaInMillimetres { gyration, .. } => *gyration > FAR_GYRATION,
        _ => false,
    }
}

/// With the name and line of the joint or body in place of its number.
fn placed(advice: &NumberAdvice, tree: &Tree, robot: &str) -> Advice {
    let topic = match advice.is_about_units() {
        true => Topic::Units,
        false => Topic::Torque,
    };
    // The text begins with what it is about, which stands in a column of its own.
    let text = advice.to_string();
    let (subject, reason) = text.split_once(": ").unwrap_or(("", &text));
    let number = subject.strip_prefix("body `").map(|name| name.trim_end_matches('`'));
    let body = number.and_then(number_of).and_then(|i| tree.bodies.get(i));
    let joint = advice.joint().and_then(|joint| of_coordinate(tree, joint));
    let name = body.map(|body| &body.name).or(joint.map(|body| &body.joint));
    Advice {
        topic,
        line: body.or(joint).map_or(0, |body| body.line),
        name: name.map_or(robot, |name| name).to_owned(),
        text: capitalised(reason),
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
