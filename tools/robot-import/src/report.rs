//! The report of an import.

use serde::Serialize;

use crate::advice::Advice;
use crate::check::Checked;
use crate::estimate;
use crate::tree::{Body, Tree};

/// The report of an import; its fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The robot's name.
    pub name: String,
    /// The type's name.
    pub type_name: String,
    /// The path of the file.
    pub file: String,
    /// The licence that its comments state.
    pub licence: Option<String>,
    /// The name of the link that stands still.
    pub base: String,
    /// The bodies with their joints.
    pub bodies: Vec<Row>,
    /// The names of the joints that close loops.
    pub loops: Vec<String>,
    /// The number of motors that drive the joints through `COUPLING`, if some follow others.
    pub coupled_motors: Option<usize>,
    /// The numbers of bodies, position and velocity coordinates.
    pub sizes: [usize; 3],
    /// The advice on numbers that are worth a look.
    pub advice: Vec<Advice>,
    /// The roundings that were made exact.
    pub exact: Vec<estimate::Saved>,
    /// Those in the frames of inertias, a sentence each.
    pub exact_inertias: Vec<String>,
    /// The results of the check.
    pub check: Checked,
    /// Cycles of inverse dynamics by the engine, estimated.
    pub estimated_cycles: Option<u64>,
    /// Bytes of its code, estimated.
    pub estimated_flash: Option<u64>,
}

/// A body in the report.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The name of the joint.
    pub joint: String,
    /// The name of the body.
    pub body: String,
    /// The parent body's name.
    pub parent: String,
    /// The kind of joint.
    pub kind: String,
    /// Mass, kg.
    pub mass: f64,
    /// Least and greatest position, rad or m.
    pub range: Option<[f64; 2]>,
    /// Greatest torque, N·m or N.
    pub effort: Option<f64>,
    /// The joint that it follows.
    pub follows: Option<String>,
}

/// The rows of a tree's bodies.
pub fn rows(tree: &Tree) -> Vec<Row> {
    let row = |body: &Body| Row {
        joint: body.joint.clone(),
        body: body.name.clone(),
        parent: body.parent.map_or(tree.base.clone(), |parent| tree.bodies[parent].name.clone()),
        kind: format!("{:?}", body.kind).to_lowercase(),
        mass: body.inertia.mass,
        range: body.limits.position,
        effort: body.limits.effort,
        follows: body.follows.map(|(leader, ..)| tree.bodies[leader].joint.clone()),
    };
    tree.bodies.iter().map(row).collect()
}
