//! What a description has that its user should know: each with its place and a reason.

use std::f64::consts::PI;

use serde::Serialize;

use crate::description::{Description, Format, Joint, Kind};
use crate::inertia::MassProperties;
use crate::physical::violation;
use crate::selection::{Role, Selected};
use crate::tree::Tree;

/// A kind of advice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Topic {
    /// No distribution of mass has this inertia.
    NonPhysical,
    /// A number that stands for none.
    Placeholder,
    /// An inertia that rounding in f32 may lose.
    Tiny,
    /// A body that moves without mass.
    Massless,
    /// An axis that is not of length one.
    Axis,
    /// A joint without limits, or with impossible ones.
    Limits,
    /// A joint that follows another inconsistently.
    Mimic,
    /// What the file states and the import leaves out.
    LeftOut,
}

/// A piece of advice.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// Its kind.
    pub topic: Topic,
    /// The line of the file; 0 if none is concerned.
    pub line: u32,
    /// The link or joint.
    pub name: String,
    /// A sentence with the reason.
    pub text: String,
}

/// By how much a principal moment may exceed the sum of the others: the rounding of a file's digits.
const TOLERANCE: f64 = 1e-3;

/// The advice on a selection.
pub fn advice(robot: &Description, selected: &Selected, tree: &Tree) -> Vec<Advice> {
    let mut all = Vec::new();
    links(robot, tree, &mut all);
    bodies(tree, &mut all);
    for &j in &selected.order {
        if selected.roles[j] == Role::Moves {
            joint(robot, &robot.joints[j], selected, &mut all);
        }
    }
    all.extend(robot.notes.iter().map(|note| Advice {
        topic: Topic::LeftOut,
        line: 0,
        name: robot.name.clone(),
        text: note.clone(),
    }));
    all.sort_by_key(|advice| (advice.topic, advice.line));
    all
}

/// Inertias of the file's links that move.
fn links(robot: &Description, tree: &Tree, all: &mut Vec<Advice>) {
    for (link, part_of) in robot.links.iter().zip(&tree.links) {
        let (Some(inertial), Some((Some(_), _))) = (&link.inertial, part_of) else {
            continue;
        };
        let mut add = |topic, text| {
            all.push(Advice {
                topic,
                line: link.line,
                name: link.name.clone(),
                text,
            });
        };
        let own = MassProperties::in_frame(inertial.mass, &inertial.exact, inertial.inertia);
        if let Some(found) = violation(own.inertia, TOLERANCE) {
            let axis = found.axis.to_array().map(|x| format!("{x:.2}")).join(", ");
            add(
                Topic::NonPhysical,
                format!(
                    "The moment of inertia about ({axis}) exceeds the sum of the two others by {:.1} %: \
                     no body has it. `--repair` takes the nearest physical one.",
                    100.0 * found.excess
                ),
            );
        }
        let [xx, xy, xz, yy, yz, zz] = own.inertia;
        let largest = xx.max(yy).max(zz);
        let gyration = (largest / own.mass).sqrt();
        let equal = xx == yy && yy == zz && [xy, xz, yz] == [0.0; 3];
        if equal && xx > 0.0 && xx.log10().fract() == 0.0 {
            add(
                Topic::Placeholder,
                format!("The inertia is {xx} kg·m² about every axis: a placeholder."),
            );
        } else if own.mass > 0.0 && gyration > 2.0 {
            add(
                Topic::Placeholder,
                format!(
                    "{} kg with a radius of gyration of {gyration:.1} m: the inertia may be in other units.",
                    own.mass
                ),
            );
        } else if own.mass == 0.0 && own.inertia != [0.0; 6] {
            add(Topic::Massless, "It has inertia but no mass.".to_owned());
        } else if own.mass > 0.0 && own.mass < 1e-3 {
            add(
                Topic::Tiny,
                format!(
                    "A mass of {:e} kg: a placeholder, or a part whose mass can be left out.",
                    own.mass
                ),
            );
        }
    }
}

/// Bodies whose joint moves no mass.
fn bodies(tree: &Tree, all: &mut Vec<Advice>) {
    let mut carried: Vec<f64> = tree
        .bodies
        .iter()
        .map(|body| body.inertia.mass + size(&body.inertia))
        .collect();
    for i in (0..tree.bodies.len()).rev() {
        if let Some(parent) = tree.bodies[i].parent {
            carried[parent] += carried[i];
        }
    }
    for (body, carried) in tree.bodies.iter().zip(carried) {
        if carried == 0.0 {
            all.push(Advice {
                topic: Topic::Massless,
                line: body.line,
                name: body.joint.clone(),
                text: "Neither the body nor what it carries has mass: M is singular, and forward dynamics needs an armature."
                    .to_owned(),
            });
        }
    }
}

fn size(inertia: &MassProperties) -> f64 {
    inertia.inertia.iter().map(|x| x.abs()).sum()
}

fn joint(robot: &Description, joint: &Joint, selected: &Selected, all: &mut Vec<Advice>) {
    let mut add = |topic, text: String| {
        all.push(Advice {
            topic,
            line: joint.line,
            name: joint.name.clone(),
            text,
        });
    };
    let length = joint.axis.length();
    if joint.kind.has_axis() && (length - 1.0).abs() > 1e-6 {
        add(
            Topic::Axis,
            format!("Its axis has the length {length:.6}; it is taken as a direction."),
        );
    }
    if !joint.kind.has_axis() {
        return;
    }
    let limits = &joint.limits;
    match limits.position {
        Some([lower, upper]) if lower > upper => add(
            Topic::Limits,
            format!("The lower limit {lower} is above the upper one {upper}: neither is taken."),
        ),
        Some([lower, upper]) if lower == upper && joint.kind != Kind::Continuous => add(
            Topic::Limits,
            format!("Both limits of position are {lower}: neither is taken."),
        ),
        None if joint.kind != Kind::Continuous => {
            add(Topic::Limits, "It has no limits of position.".to_owned());
        }
        _ => {}
    }
    let missing: Vec<&str> = [("speed", limits.velocity), ("torque", limits.effort)]
        .into_iter()
        // MJCF has no limits of speed.
        .filter(|(name, _)| robot.format == Format::Urdf || *name != "speed")
        .filter_map(|(name, limit)| limit.is_none_or(|limit| limit <= 0.0).then_some(name))
        .collect();
    if !missing.is_empty() {
        add(
            Topic::Limits,
            format!(
                "It has no limit of {}: the safety gate needs one.",
                missing.join(" and of ")
            ),
        );
    }
    if joint.damping < 0.0 || joint.friction < 0.0 {
        add(
            Topic::Limits,
            "Its friction is negative: it would drive the joint.".to_owned(),
        );
    }
    mimic(robot, joint, selected, &mut add);
}

fn mimic(
    robot: &Description,
    joint: &Joint,
    selected: &Selected,
    add: &mut impl FnMut(Topic, String),
) {
    let Some(mimic) = &joint.mimic else {
        return;
    };
    let leader = robot
        .joints
        .iter()
        .position(|other| other.name == mimic.joint);
    let Some(leader) = leader else {
        let text = format!(
            "It follows `{}`, which does not exist: it moves by itself.",
            mimic.joint
        );
        return add(Topic::Mimic, text);
    };
    if !selected.order.contains(&leader) {
        let text = format!(
            "It follows `{}`, which is not below the base: it moves by itself.",
            mimic.joint
        );
        return add(Topic::Mimic, text);
    }
    let (Some([lower, upper]), Some(range)) =
        (joint.limits.position, robot.joints[leader].limits.position)
    else {
        return;
    };
    let [a, b] = range.map(|x| mimic.multiplier * x + mimic.offset);
    let (least, most) = (a.min(b), a.max(b));
    let slack = 1e-3 * (upper - lower).abs().max(PI * 1e-3);
    if lower < upper && (least < lower - slack || most > upper + slack) {
        add(
            Topic::Mimic,
            format!(
                "Where `{}` is within its limits, it goes from {least:.4} to {most:.4}, beyond its own {lower} to {upper}.",
                mimic.joint
            ),
        );
    }
}
