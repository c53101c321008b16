//! The part of a description that becomes the robot: its base, and which of its joints move.

use std::collections::HashMap;

use crate::description::{Description, Kind};
use crate::error::{ImportError, Problem, Result};

/// The selection of a user.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The link that stands still; the root if none.
    pub base: Option<String>,
    /// Only the joints between the base and this link move.
    pub tip: Option<String>,
    /// These links, and all that they carry, are not part of the robot.
    pub without: Vec<String>,
    /// Only these joints move.
    pub joints: Vec<String>,
    /// These joints stand still at a position, rad or m.
    pub lock: Vec<(String, f64)>,
    /// The base moves freely.
    pub free_base: bool,
}

/// The role of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// The joint moves.
    Moves,
    /// It stands still at a position, rad or m.
    Locked(f64),
}

/// A selection in a description.
#[derive(Clone, Debug)]
pub struct Selected {
    /// The index of the base link.
    pub base: usize,
    /// The joints below the base, parents first, by index.
    pub order: Vec<usize>,
    /// The role of each joint of the description.
    pub roles: Vec<Role>,
    /// Whether the base moves freely.
    pub free_base: bool,
}

impl Selection {
    /// Applies the selection to a description.
    ///
    /// # Errors
    /// Names that the description lacks, a tip that is not below the base, a joint that cannot be
    /// locked at a position.
    pub fn of(&self, robot: &Description) -> Result<Selected> {
        let mut joint_of = vec![None; robot.links.len()];
        for (j, joint) in robot.joints.iter().enumerate() {
            joint_of[joint.child] = Some(j);
        }
        let base = match &self.base {
            Some(name) => robot.link(name)?,
            None => joint_of.iter().position(Option::is_none).unwrap_or_default(),
        };
        let mut absent = vec![false; robot.links.len()];
        for name in &self.without {
            absent[robot.link(name)?] = true;
        }
        if absent[base] {
            let name = &robot.links[base].name;
            let problem = format!("link `{name}` is the base, which cannot be left out");
            return Err(Problem::Value(problem).into());
        }
        let order = order(robot, base, &absent);
        let mut roles: Vec<Role> = robot
            .joints
            .iter()
            .map(|joint| match joint.kind {
                Kind::Fixed => Role::Locked(0.0),
                _ => Role::Moves,
            })
            .collect();
        if let Some(tip) = &self.tip {
            let mut on_path = vec![false; robot.joints.len()];
            let mut at = robot.link(tip)?;
            while at != base {
                let Some(j) = joint_of[at] else {
                    return Err(
                        Problem::Value(format!("link `{tip}` is not below the base")).into()
                    );
                };
                on_path[j] = true;
                at = robot.joints[j].parent;
            }
            lock_others(&mut roles, &on_path);
        }
        if !self.joints.is_empty() {
            let mut listed = vec![false; robot.joints.len()];
            for name in &self.joints {
                let j = robot.joint(name)?;
                if robot.joints[j].kind == Kind::Fixed || !order.contains(&j) {
                    let problem =
                        Problem::Value("it does not move, or is not below the base".to_owned());
                    return Err(at_joint(robot, j, problem));
                }
                listed[j] = true;
            }
            lock_others(&mut roles, &listed);
        }
        let mut locked = HashMap::new();
        for (name, position) in &self.lock {
            let j = robot.joint(name)?;
            let kind = robot.joints[j].kind;
            if !position.is_finite() || (*position != 0.0 && !kind.has_axis()) {
                let problem = format!("it cannot be locked at {position}");
                return Err(at_joint(robot, j, Problem::Value(problem)));
            }
            roles[j] = Role::Locked(*position);
            locked.insert(j, *position);
        }
        follow(robot, &mut roles, &order, &locked)?;
        Ok(Selected { base, order, roles, free_base: self.free_base })
    }
}

fn at_joint(robot: &Description, j: usize, problem: Problem) -> ImportError {
    let joint = &robot.joints[j];
    ImportError::at(joint.line, format!("joint `{}`", joint.name), problem)
}

fn lock_others(roles: &mut [Role], moves: &[bool]) {
    for (role, moves) in roles.iter_mut().zip(moves) {
        if !moves {
            *role = Role::Locked(0.0);
        }
    }
}

/// The joints below a link, parents first, each branch as a whole and in the order of the file;
/// none to or beyond an absent link.
fn order(robot: &Description, base: usize, absent: &[bool]) -> Vec<usize> {
    let mut below = vec![Vec::new(); robot.links.len()];
    for (j, joint) in robot.joints.iter().enumerate().rev() {
        if !absent[joint.child] {
            below[joint.parent].push(j);
        }
    }
    let (mut order, mut next) = (Vec::new(), below[base].clone());
    while let Some(j) = next.pop() {
        order.push(j);
        next.extend(&below[robot.joints[j].child]);
    }
    order
}

/// Locks each joint that follows one that stands still, where it follows to; none follows itself.
///
/// A joint of `locked`, which the user has locked, stands still where the user says, whatever it
/// follows. A leader that is not below the base and that nobody has locked leads nothing.
fn follow(
    robot: &Description,
    roles: &mut [Role],
    order: &[usize],
    locked: &HashMap<usize, f64>,
) -> Result<()> {
    let mut below = vec![false; robot.joints.len()];
    order.iter().for_each(|&j| below[j] = true);
    let leaders = leaders(robot);
    for j in 0..robot.joints.len() {
        // From the joint to the last one that it follows, and back: each after its leader.
        let mut chain = vec![j];
        while let Some(leader) = leaders[chain[chain.len() - 1]] {
            if chain.len() > robot.joints.len() {
                let problem = Problem::Value("it follows itself".to_owned());
                return Err(at_joint(robot, j, problem));
            }
            chain.push(leader);
        }
        for pair in chain.windows(2).rev() {
            let [follower, leader] = [pair[0], pair[1]];
            let stands = below[leader] || locked.contains_key(&leader);
            let free =
                !locked.contains_key(&follower) && robot.joints[follower].kind != Kind::Fixed;
            if let (true, true, Role::Locked(position), Some(mimic)) =
                (stands, free, roles[leader], &robot.joints[follower].mimic)
            {
                roles[follower] = Role::Locked(mimic.multiplier * position + mimic.offset);
            }
        }
    }
    Ok(())
}

/// The joint that each joint follows; none of one that follows none, or none of the file's.
fn leaders(robot: &Description) -> Vec<Option<usize>> {
    let names = robot.joints.iter().enumerate();
    let index: HashMap<&str, usize> = names.map(|(j, joint)| (joint.name.as_str(), j)).collect();
    let each = robot.joints.iter();
    each.map(|joint| index.get(joint.mimic.as_ref()?.joint.as_str()).copied()).collect()
}
