//! Cycles of the engine's inverse dynamics on a Cortex-M4F, estimated from what of a tree is not zero or one.
//!
//! The engine folds products with known zeros and ones away. What is left depends on how many entries of a placement's
//! rotation and offset are neither, in frames whose z is the joint's axis.

use dynamics_core::glam::{DMat3, DQuat, DVec3};
use serde::Serialize;

use crate::description::{Description, Kind};
use crate::number::Attitude;
use crate::selection::Selected;
use crate::snap;
use crate::tree::{Body, Numbers, Tree};

/// Cycles of a call, of a joint, and of each entry of rotation and offset that is neither 0 nor ±1: least squares over
/// the measured robots of docs/robots.md, written there.
const PER_CALL: f64 = 60.0;
const PER_JOINT: f64 = 84.0;
const PER_ROTATION_ENTRY: f64 = 12.0;
const PER_OFFSET_ENTRY: f64 = 9.0;

/// The roundings of a joint's placement, and what making them exact saves.
#[derive(Clone, Debug, Serialize)]
pub struct Saved {
    /// The joint.
    pub joint: String,
    /// The attributes with the file's text and the exact value.
    pub numbers: Vec<(String, String, String)>,
    /// Cycles, estimated.
    pub cycles: i64,
}

/// Cycles of inverse dynamics with sines and cosines; none if the engine does not take the robot's joints.
pub fn cycles(tree: &Tree) -> Option<u64> {
    tree.is_single().then(|| estimated(tree) as u64)
}

fn estimated(tree: &Tree) -> f64 {
    let each = tree.bodies.iter().map(|body| {
        let parent = body.parent.map(|parent| &tree.bodies[parent]);
        let [rotation, offset] = entries(body, parent);
        PER_JOINT + PER_ROTATION_ENTRY * rotation as f64 + PER_OFFSET_ENTRY * offset as f64
    });
    PER_CALL + each.sum::<f64>()
}

/// How many entries of a placement's rotation and offset are neither 0 nor ±1.
pub fn entries(body: &Body, parent: Option<&Body>) -> [usize; 2] {
    let to_parent = match body.attitude {
        Attitude::QuarterTurns(turns) => snap::rpy(turns.map(snap::sin_cos)),
        Attitude::Rpy(rpy) => snap::rpy(rpy.map(f64::sin_cos)),
    };
    let outer = parent.map_or(DMat3::IDENTITY, aligned);
    let rotation = outer.transpose() * to_parent * aligned(body);
    let offset = outer.transpose() * DVec3::from_array(body.xyz);
    let general = |x: &f64| {
        [-1.0, 0.0, 1.0]
            .iter()
            .all(|known| (x - known).abs() > 1e-12)
    };
    let count = |values: &[f64]| values.iter().filter(|x| general(x)).count();
    let some = offset.to_array().iter().filter(|x| x.abs() > 1e-12).count();
    [count(&rotation.to_cols_array()), some]
}

/// The axes of a frame whose z is the joint's axis.
fn aligned(body: &Body) -> DMat3 {
    let axis = DVec3::from_array(body.axis).normalize_or_zero();
    match axis {
        _ if body.kind == Kind::Fixed || axis == DVec3::ZERO || axis == DVec3::Z => DMat3::IDENTITY,
        DVec3::NEG_Z => DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)),
        _ => DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis)),
    }
}

/// What each joint's exact values save.
pub fn savings(robot: &Description, selected: &Selected, tree: &Tree) -> Vec<Saved> {
    let mut all = Vec::new();
    for body in tree.bodies.iter().filter(|body| !body.snapped.is_empty()) {
        let mut rounded = robot.clone();
        if let Some(joint) = rounded
            .joints
            .iter_mut()
            .find(|joint| joint.name == body.joint)
        {
            joint.exact = joint.origin;
        }
        let without = Tree::of(&rounded, selected, Numbers::Exact);
        let cycles = without.map_or(0.0, |without| estimated(&without) - estimated(tree));
        all.push(Saved {
            joint: body.joint.clone(),
            numbers: body
                .snapped
                .iter()
                .map(|snap| {
                    (
                        snap.attribute.clone(),
                        snap.text.clone(),
                        snap.exact.clone(),
                    )
                })
                .collect(),
            cycles: cycles as i64,
        });
    }
    all
}
