//! Facts about a description that its user should know, each with its place and a reason.

pub mod numbers;

use std::f64::consts::PI;

use serde::Serialize;

use self::numbers::{Advise, NumberAdvice};
use crate::description::{Description, Format, Joint, Kind, Mimic};
use crate::inertia::MassProperties;
use crate::model::AnyModel;
#[cfg(feature = "program")]
use crate::model::Motion;
pub use crate::physical::TOLERANCE;
use crate::physical::{impossible, sentence};
use crate::selection::{Role, Selected};
use crate::tree::{Body, Tree};

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
    /// Numbers that look like another unit.
    Units,
    /// Limits of torque that gravity exceeds, or that are far above every need.
    Torque,
    /// Joints without friction and rotors.
    Drivetrain,
    /// A statement of the file that the import leaves out.
    LeftOut,
    /// A type with another name than the robot.
    Renamed,
}

/// A piece of advice.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// The kind of the advice.
    pub topic: Topic,
    /// The line of the file; 0 if none is concerned.
    pub line: u32,
    /// The link or joint that it is about.
    pub name: String,
    /// A sentence with the reason.
    pub text: String,
}

/// The radius of gyration, m, beyond which an inertia is a placeholder or in another unit.
pub const FAR_GYRATION: f64 = 2.0;

/// The longest time for a joint's range at its limit of speed without a word, s.
const SLOWEST: f64 = 600.0;

impl AnyModel {
    /// The numbers that look like another unit, or ask more of the motors than they have.
    pub fn advice(&self) -> Vec<NumberAdvice> {
        match self {
            Self::Small(model) => model.exact.advice().collect(),
            Self::Middle(model) => model.exact.advice().collect(),
            Self::Large(model) => model.exact.advice().collect(),
        }
    }
}

/// The largest ratio of a limit to the torque that a robot needs that passes without a word: legs
/// that carry a body need more than when they hang from it.
#[cfg(feature = "program")]
const MOST_LIMIT: f64 = 30.0;

/// The advice on limits of torque that are far above what the robot needs at the states of a check,
/// of which each joint's is compared with its limit; none if the limit of one joint, the most
/// loaded, is near enough.
#[cfg(feature = "program")]
pub fn needless_torque(tree: &Tree, samples: &[(Motion, Vec<f64>)]) -> Option<Advice> {
    let mut most = vec![0.0_f64; tree.coordinates()[1]];
    let (mut speed, mut acceleration) = (0.0_f64, 0.0_f64);
    for (motion, torque) in samples {
        for (most, torque) in most.iter_mut().zip(torque) {
            *most = most.max(torque.abs());
        }
        speed = motion.qd.iter().fold(speed, |most, x| most.max(x.abs()));
        let rates = motion.qdd.iter();
        acceleration = rates.fold(acceleration, |most, x| most.max(x.abs()));
    }
    let mut at = 0;
    let mut nearest: Option<(f64, &Body, f64, f64)> = None;
    for body in &tree.bodies {
        let first = at;
        at += body.kind.coordinates()[1];
        let (Some(limit), true) = (body.limits.effort, body.kind.has_axis()) else {
            continue;
        };
        let of_joint = body.friction + body.damping * speed + body.armature * acceleration;
        let needed = most.get(first).copied().unwrap_or_default() + of_joint;
        let ratio = limit / needed;
        if needed > 0.0 && nearest.is_none_or(|(other, ..)| ratio < other) {
            nearest = Some((ratio, body, limit, needed));
        }
    }
    let (ratio, body, limit, needed) = nearest.filter(|(ratio, ..)| *ratio > MOST_LIMIT)?;
    let unit = ["N·m", "N"][usize::from(body.kind == Kind::Prismatic)];
    Some(Advice {
        topic: Topic::Limits,
        line: body.line,
        name: body.joint.clone(),
        text: format!(
            "Its limit is {limit} {unit}, {ratio:.0} times the {needed:.2} {unit} that it needs at \
             most at {} random states of up to {speed:.0} rad/s and {acceleration:.0} rad/s²; no \
             joint's limit is nearer to its need, so that a safety gate with these limits never \
             acts. State what the drive can do, or may, in `effort` of <limit> (`forcerange` or \
             `ctrlrange` of an MJCF), or in `torque` of the written file.",
            samples.len(),
        ),
    })
}

/// The advice on a selection.
pub fn advice(robot: &Description, selected: &Selected, tree: &Tree) -> Vec<Advice> {
    let mut all = Vec::new();
    links(robot, tree, &mut all);
    bodies(tree, &mut all);
    for &j in &selected.order {
        match selected.roles[j] {
            Role::Moves => joint(robot, &robot.joints[j], selected, &mut all),
            Role::Locked(position) => locked(robot, &robot.joints[j], position, selected, &mut all),
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

/// The reason to look for friction and rotors, if no joint has any.
pub fn bare_joints(tree: &Tree) -> Option<&'static str> {
    let is_bare = |body: &Body| [body.damping, body.friction, body.armature] == [0.0; 3];
    (!tree.bodies.is_empty() && tree.bodies.iter().all(is_bare)).then_some(
        "No joint has friction or the inertia of a rotor, since the file states neither damping, \
         friction nor armature. Geared motors have all of them, and the torque of a model without \
         may not move a joint: measure them with `identify`, or take them from the motor's data \
         sheet.",
    )
}

/// Inertias of the file's links that move.
fn links(robot: &Description, tree: &Tree, all: &mut Vec<Advice>) {
    for (link, part_of) in robot.links.iter().zip(&tree.links) {
        let (Some(inertial), Some((Some(_), _))) = (&link.inertial, part_of) else {
            continue;
        };
        let mut add = |topic, text| {
            all.push(Advice { topic, line: link.line, name: link.name.clone(), text });
        };
        let own = MassProperties::in_frame(inertial.mass, &inertial.exact, inertial.inertia);
        if let Some(found) = impossible(own.inertia, TOLERANCE) {
            let words = sentence(&found);
            let text = format!("{words} `--repair` takes the nearest physical one.");
            add(Topic::NonPhysical, text);
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
        } else if own.mass > 0.0 && gyration > FAR_GYRATION {
            add(
                Topic::Placeholder,
                format!(
                    "{} kg with a radius of gyration of {gyration:.1} m: the inertia may be in \
                     other units.",
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

/// Bodies without moments of inertia, and those whose joint moves no mass.
fn bodies(tree: &Tree, all: &mut Vec<Advice>) {
    let mut carried: Vec<f64> =
        tree.bodies.iter().map(|body| body.inertia.mass + size(&body.inertia)).collect();
    for i in (0..tree.bodies.len()).rev() {
        if let Some(parent) = tree.bodies[i].parent {
            carried[parent] += carried[i];
        }
    }
    for (body, carried) in tree.bodies.iter().zip(carried) {
        if body.inertia.mass > 0.0 && size(&body.inertia) == 0.0 {
            all.push(Advice {
                topic: Topic::Placeholder,
                line: body.line,
                name: body.name.clone(),
                text: format!(
                    "{} kg whose six moments of inertia are zero: a mass at one point. M is \
                     singular where a joint's axis passes through it and the joint moves nothing \
                     else: state the moments, or an armature.",
                    body.inertia.mass
                ),
            });
        }
        if carried == 0.0 {
            all.push(Advice {
                topic: Topic::Massless,
                line: body.line,
                name: body.joint.clone(),
                text: "Neither the body nor what it carries has mass: M is singular, and forward \
                    dynamics needs an armature."
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
        all.push(Advice { topic, line: joint.line, name: joint.name.clone(), text });
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
        Some([lower, upper]) if lower == upper && joint.kind != Kind::Continuous => {
            add(Topic::Limits, format!("Both limits of position are {lower}: neither is taken."))
        }
        None if joint.kind != Kind::Continuous => {
            add(Topic::Limits, "It has no limits of position.".to_owned());
        }
        _ => {}
    }
    let range = limits.position.map_or(2.0 * PI, |[lower, upper]| upper - lower);
    if let Some(speed) = limits.velocity.filter(|speed| *speed > 0.0)
        && range / speed > SLOWEST
    {
        let unit = ["rad", "m"][usize::from(joint.kind == Kind::Prismatic)];
        add(
            Topic::Limits,
            format!(
                "At its limit of speed, {speed} {unit}/s, it takes {:.1} hours for its range of \
                 {range:.3} {unit}. The motion of a project moves it as far as it comes in 4 s; \
                 its safety gate may take the last digit of an encoder for more speed.",
                range / speed / 3_600.0
            ),
        );
    }
    // A follower has no motor of its own, nor has a joint without one where the file has some.
    let leader = joint.mimic.as_ref().and_then(|mimic| leader(robot, mimic));
    let is_passive = leader.is_some_and(|leader| selected.order.contains(&leader))
        || robot.format == Format::Mjcf
            && !joint.driven
            && robot.joints.iter().any(|other| other.driven);
    let missing: Vec<&str> = [("speed", limits.velocity), ("torque", limits.effort)]
        .into_iter()
        // MJCF has no limits of speed.
        .filter(|(name, _)| robot.format == Format::Urdf || *name != "speed")
        .filter(|_| !is_passive)
        .filter_map(|(name, limit)| limit.is_none_or(|limit| limit <= 0.0).then_some(name))
        .collect();
    if !missing.is_empty() {
        add(
            Topic::Limits,
            format!("It has no limit of {}: the safety gate needs one.", missing.join(" and of ")),
        );
    }
    if joint.damping < 0.0 || joint.friction < 0.0 {
        add(Topic::Limits, "Its friction is negative: it would drive the joint.".to_owned());
    }
    mimic(robot, joint, selected, &mut add);
}

/// A joint that stands still, where its limits and the joint that it follows would have it.
fn locked(
    robot: &Description,
    joint: &Joint,
    position: f64,
    selected: &Selected,
    all: &mut Vec<Advice>,
) {
    let mut add = |topic, text: String| {
        all.push(Advice { topic, line: joint.line, name: joint.name.clone(), text });
    };
    if !joint.kind.has_axis() {
        return;
    }
    if let Some([lower, upper]) = joint.limits.position
        && position != 0.0
        && joint.kind != Kind::Continuous
        && lower < upper
        && !(lower..=upper).contains(&position)
    {
        add(
            Topic::Limits,
            format!("It stands still at {position}, beyond its limits {lower} to {upper}."),
        );
    }
    let Some(mimic) = &joint.mimic else {
        return;
    };
    let Some(leader) = leader(robot, mimic) else {
        return;
    };
    let name = &mimic.joint;
    match selected.roles[leader] {
        Role::Moves if selected.order.contains(&leader) => add(
            Topic::Mimic,
            format!(
                "It stands still at {position}, although it follows `{name}`, which moves: their \
                 coupling is left out."
            ),
        ),
        Role::Moves => {}
        Role::Locked(at) => {
            let follows = mimic.multiplier * at + mimic.offset;
            let text = match follows == position {
                true if position == 0.0 => return,
                true => format!(
                    "It follows `{name}`, which stands still at {at}: it stands still at \
                     {position}."
                ),
                false => format!(
                    "It stands still at {position}, and `{name}`, which it follows, at {at}, where \
                     it would be at {follows}: the lock is taken."
                ),
            };
            add(Topic::Mimic, text);
        }
    }
}

/// The joint that another follows.
fn leader(robot: &Description, mimic: &Mimic) -> Option<usize> {
    let mut joints = robot.joints.iter();
    joints.position(|other| other.name == mimic.joint)
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
    let Some(leader) = leader(robot, mimic) else {
        let text =
            format!("It follows `{}`, which does not exist: it moves by itself.", mimic.joint);
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
                "Where `{}` is within its limits, it goes from {least:.4} to {most:.4}, beyond its \
                 own {lower} to {upper}.",
                mimic.joint
            ),
        );
    }
}
