//! The robot of a selection: bodies that move, with all that is fixed to them as one.

use std::collections::HashMap;

use dynamics_core::glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::description::{Description, Joint, Kind, Limits, Link, Pose, Snap};
use crate::error::{Problem, Result};
use crate::inertia::MassProperties;
use crate::number::{Attitude, tidy};
use crate::selection::{Role, Selected};

/// The bodies of a robot, parents first.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tree {
    /// The robot's name.
    pub name: String,
    /// The base's name.
    pub base: String,
    /// The bodies of the robot.
    pub bodies: Vec<Body>,
    /// For each link, the body that it is part of, and its frame in that body's; none is the base,
    /// or not part of the robot.
    #[serde(skip)]
    pub links: Vec<Option<(Option<usize>, Pose)>>,
}

/// A body and its joint.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Body {
    /// The name of its link.
    pub name: String,
    /// The name of its joint.
    pub joint: String,
    /// The line of its joint.
    pub line: u32,
    /// The parent; none is the base.
    pub parent: Option<usize>,
    /// The kind of its joint.
    pub kind: Kind,
    /// The origin of its frame in the parent's at q = 0, m.
    pub xyz: [f64; 3],
    /// The attitude of its frame in the parent's at q = 0.
    pub attitude: Attitude,
    /// The joint's axis in its frame.
    pub axis: [f64; 3],
    /// The mass and the inertia of the body.
    pub inertia: MassProperties,
    /// The joint's limits, where they are stated and possible.
    pub limits: Limits,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub damping: f64,
    /// Coulomb friction, N·m or N.
    pub friction: f64,
    /// Reflected inertia of the rotor, kg·m² or kg.
    pub armature: f64,
    /// Stiffness (N·m/rad or N/m) and rest position (rad or m) of the spring at its joint.
    pub spring: [f64; 2],
    /// Whether its joint has a motor, or a limit of torque.
    pub driven: bool,
    /// The body whose joint this one follows, with ratio and offset.
    pub follows: Option<(usize, f64, f64)>,
    /// The links that are part of it, besides that of its name.
    pub merged: Vec<String>,
    /// The roundings that were made exact in its placement.
    #[serde(skip)]
    pub snapped: Vec<Snap>,
    /// Those in the frames of its links' inertias, with the links' names.
    #[serde(skip)]
    pub roundings: Vec<(String, Snap)>,
}

/// Which numbers of the file a tree has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// The numbers stay as they are.
    AsGiven,
    /// With exact values in place of roundings.
    Exact,
}

impl Tree {
    /// The tree of a selection.
    ///
    /// # Errors
    /// [`Problem::NothingMoves`], [`Problem::NothingBelow`].
    pub fn of(robot: &Description, selected: &Selected, numbers: Numbers) -> Result<Self> {
        let mut tree = Self {
            name: robot.name.clone(),
            base: robot.links[selected.base].name.clone(),
            bodies: Vec::new(),
            links: vec![None; robot.links.len()],
        };
        let mut body_of_joint = HashMap::new();
        if selected.free_base {
            tree.bodies.push(floating(robot, selected.base));
        }
        let base = selected.free_base.then_some(0);
        tree.links[selected.base] = Some((base, Pose::IDENTITY));
        tree.add_mass(robot, selected.base, numbers);
        let mut snapped: Vec<Vec<Snap>> = vec![Vec::new(); robot.links.len()];
        for &j in &selected.order {
            let joint = &robot.joints[j];
            let Some((body, pose)) = tree.links[joint.parent] else {
                continue;
            };
            let (origin, mut snaps) = match numbers {
                Numbers::AsGiven => (&joint.origin, Vec::new()),
                Numbers::Exact => (&joint.exact, snapped[joint.parent].clone()),
            };
            if numbers == Numbers::Exact {
                snaps.extend(joint.snapped.iter().cloned());
            }
            let pose = pose.then(origin);
            match selected.roles[j] {
                Role::Locked(position) => {
                    tree.links[joint.child] =
                        Some((body, pose.then(&displacement(joint, position))));
                    snapped[joint.child] = snaps;
                    if let Some(body) = body {
                        let name = robot.links[joint.child].name.clone();
                        tree.bodies[body].merged.push(name);
                    }
                }
                Role::Moves => {
                    body_of_joint.insert(joint.name.as_str(), tree.bodies.len());
                    let name = robot.links[joint.child].name.clone();
                    tree.links[joint.child] = Some((Some(tree.bodies.len()), Pose::IDENTITY));
                    tree.bodies.push(body_on(joint, name, body, &pose, snaps));
                }
            }
            tree.add_mass(robot, joint.child, numbers);
        }
        if tree.bodies.is_empty() {
            let is_root = |link: &usize| robot.joints.iter().all(|joint| joint.child != *link);
            let root = (0..robot.links.len()).find(is_root).filter(|root| *root != selected.base);
            let below =
                |root: usize| Problem::NothingBelow(tree.base, robot.links[root].name.clone());
            return Err(root.map_or(Problem::NothingMoves, below).into());
        }
        tree.couple(robot, &body_of_joint);
        for body in &mut tree.bodies {
            body.inertia = body.inertia.tidied();
        }
        Ok(tree)
    }

    /// The numbers of position and velocity coordinates.
    pub fn coordinates(&self) -> [usize; 2] {
        let each = self.bodies.iter().map(|body| body.kind.coordinates());
        each.fold([0, 0], |[q, v], [a, b]| [q + a, v + b])
    }

    /// Whether each joint has one coordinate.
    pub fn is_single(&self) -> bool {
        self.bodies.iter().all(|body| body.kind.has_axis())
    }

    /// Whether a joint follows another.
    pub fn has_followers(&self) -> bool {
        self.bodies.iter().any(|body| body.follows.is_some())
    }

    /// The number of joints that follow none.
    pub fn motors(&self) -> usize {
        self.bodies.iter().filter(|body| body.follows.is_none()).count()
    }

    /// Whether a joint has a spring.
    pub fn has_springs(&self) -> bool {
        self.bodies.iter().any(|body| body.spring[0] != 0.0)
    }

    /// Adds a link's mass to the body that it is part of.
    fn add_mass(&mut self, robot: &Description, link: usize, numbers: Numbers) {
        let Some((Some(body), pose)) = self.links[link] else {
            return;
        };
        let Some(inertial) = &robot.links[link].inertial else {
            return;
        };
        let frame = match numbers {
            Numbers::AsGiven => &inertial.frame,
            Numbers::Exact => &inertial.exact,
        };
        let own = MassProperties::in_frame(inertial.mass, frame, inertial.inertia);
        let body = &mut self.bodies[body];
        body.inertia = body.inertia.plus(&own.moved(&pose));
        if numbers == Numbers::Exact {
            let Link { name, snapped, .. } = &robot.links[link];
            let snaps = snapped.iter().map(|snap| (name.clone(), snap.clone()));
            body.roundings.extend(snaps);
        }
    }

    /// Resolves which body each follower follows, through followers of followers.
    fn couple(&mut self, robot: &Description, body_of_joint: &HashMap<&str, usize>) {
        let joints: HashMap<&str, &Joint> =
            robot.joints.iter().map(|joint| (joint.name.as_str(), joint)).collect();
        for (name, &body) in body_of_joint {
            let (mut ratio, mut offset, mut at) = (1.0, 0.0, *name);
            // One that follows a joint that is not part of the robot moves by itself, and leads.
            while let Some(mimic) = joints.get(at).and_then(|joint| joint.mimic.as_ref())
                && body_of_joint.contains_key(mimic.joint.as_str())
            {
                offset += ratio * mimic.offset;
                ratio *= mimic.multiplier;
                at = &mimic.joint;
            }
            let leader = body_of_joint.get(at).copied();
            self.bodies[body].follows = leader
                .filter(|&leader| leader != body)
                .map(|leader| (leader, tidy(ratio), tidy(offset)));
        }
    }
}

fn floating(robot: &Description, base: usize) -> Body {
    let link = &robot.links[base];
    Body {
        name: link.name.clone(),
        joint: "floating_base".to_owned(),
        line: link.line,
        parent: None,
        kind: Kind::Free,
        xyz: [0.0; 3],
        attitude: Attitude::QuarterTurns([0; 3]),
        axis: [0.0; 3],
        inertia: MassProperties::default(),
        limits: Limits::default(),
        damping: 0.0,
        friction: 0.0,
        armature: 0.0,
        spring: [0.0; 2],
        driven: false,
        follows: None,
        merged: Vec::new(),
        snapped: Vec::new(),
        roundings: Vec::new(),
    }
}

fn body_on(
    joint: &Joint,
    name: String,
    parent: Option<usize>,
    pose: &Pose,
    snapped: Vec<Snap>,
) -> Body {
    Body {
        name,
        joint: joint.name.clone(),
        line: joint.line,
        parent,
        kind: joint.kind,
        xyz: pose.position.to_array().map(tidy),
        attitude: Attitude::of(&pose.rotation),
        axis: match joint.kind.has_axis() {
            true => joint.axis.to_array(),
            false => [0.0; 3],
        },
        inertia: MassProperties::default(),
        limits: possible(joint.kind, &joint.limits),
        damping: joint.damping,
        friction: joint.friction,
        armature: joint.armature,
        // Without stiffness there is no rest position either.
        spring: match joint.spring {
            [0.0, _] => [0.0; 2],
            spring => spring,
        },
        driven: joint.driven || joint.limits.effort.is_some_and(|effort| effort > 0.0),
        follows: None,
        merged: Vec::new(),
        snapped,
        roundings: Vec::new(),
    }
}

/// The limits without those that no joint can have: placeholders of zero, and a lower limit above
/// the upper.
fn possible(kind: Kind, limits: &Limits) -> Limits {
    let positive = |limit: Option<f64>| limit.filter(|&limit| limit > 0.0);
    let bounded = kind != Kind::Continuous;
    Limits {
        position: limits.position.filter(|[lower, upper]| bounded && lower < upper),
        velocity: positive(limits.velocity),
        effort: positive(limits.effort),
    }
}

/// The pose of a joint's child in the joint's frame at a position.
pub fn displacement(joint: &Joint, position: f64) -> Pose {
    let axis = joint.axis.normalize_or_zero();
    match joint.kind {
        _ if position == 0.0 => Pose::IDENTITY,
        Kind::Prismatic => Pose::translation(axis * position),
        Kind::Revolute | Kind::Continuous => {
            Pose { position: DVec3::ZERO, rotation: DMat3::from_axis_angle(axis, position) }
        }
        _ => Pose::IDENTITY,
    }
}
