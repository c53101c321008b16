//! Cycles of the engine's inverse dynamics on a Cortex-M4F, estimated from what of a tree is not
//! zero or one.
//!
//! The engine folds products with known zeros and ones away. The work that is left depends on how
//! many entries of a placement's rotation are neither, in frames whose z is the joint's axis, and
//! on how many numbers of a body's inertia are not zero.

use dynamics_core::glam::{DMat3, DQuat, DVec3};
use serde::Serialize;

use crate::description::{Description, Kind};
use crate::number::Attitude;
use crate::selection::Selected;
use crate::snap;
use crate::tree::{Body, Numbers, Tree};

/// Cycles of a joint; less on the base; for each entry of a placement's rotation that is neither 0
/// nor ±1, each component of a centre of mass and each product of inertia. Least squares over the
/// published robots that were measured, which the estimates are off by 12 % (RMS; rustc 1.95).
const PER_JOINT: f64 = 127.4;
const LESS_ON_THE_BASE: f64 = 152.4;
const PER_ROTATION_ENTRY: f64 = 14.9;
const PER_COM_ENTRY: f64 = 7.8;
const PER_PRODUCT: f64 = 7.0;
/// Bytes of code per cycle: 3.1 to 3.7 of the same robots.
const FLASH: f64 = 3.6;

/// The roundings of a joint's placement, and what making them exact saves.
#[derive(Clone, Debug, Serialize)]
pub struct Saved {
    /// The joint.
    pub joint: String,
    /// The attributes with the file's text and the exact value.
    pub numbers: Vec<(String, String, String)>,
    /// The estimated number of cycles.
    pub cycles: i64,
}

/// The least estimate of the robots from which it is made, whose fewest cycles are 104: below it
/// says nothing.
const LEAST: f64 = 73.0;

/// Cycles of inverse dynamics with sines and cosines; none of joints that the engine is not
/// measured with, and of a robot that is smaller than those which were measured, such as one of a
/// single joint.
pub fn cycles(tree: &Tree) -> Option<u64> {
    known(tree).map(|cycles| cycles as u64)
}

/// The number of bytes of its code.
pub fn flash(tree: &Tree) -> Option<u64> {
    known(tree).map(|cycles| (FLASH * cycles) as u64)
}

fn known(tree: &Tree) -> Option<f64> {
    let estimated = tree.is_single().then(|| estimated(tree));
    estimated.filter(|cycles| *cycles >= LEAST)
}

fn estimated(tree: &Tree) -> f64 {
    let each = tree.bodies.iter().map(|body| {
        let some = |values: &[f64]| values.iter().filter(|x| x.abs() > 1e-15).count() as f64;
        let [_, xy, xz, _, yz, _] = body.inertia.inertia;
        let of_mass = PER_COM_ENTRY * some(&body.inertia.com) + PER_PRODUCT * some(&[xy, xz, yz]);
        let placed = match body.parent.map(|parent| &tree.bodies[parent]) {
            Some(parent) => PER_ROTATION_ENTRY * general_entries(body, parent) as f64,
            None => -LESS_ON_THE_BASE,
        };
        PER_JOINT + of_mass + placed
    });
    each.sum()
}

/// The number of entries of a placement's rotation that are neither 0 nor ±1.
fn general_entries(body: &Body, parent: &Body) -> usize {
    let to_parent = match body.attitude {
        Attitude::QuarterTurns(turns) => snap::rpy(turns.map(snap::sin_cos)),
        Attitude::Rpy(rpy) => snap::rpy(rpy.map(f64::sin_cos)),
    };
    let rotation = aligned(parent).transpose() * to_parent * aligned(body);
    let is_general = |x: &&f64| [-1.0, 0.0, 1.0].iter().all(|known| (**x - known).abs() > 1e-12);
    rotation.to_cols_array().iter().filter(is_general).count()
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

/// The cycles that each joint's exact values save.
pub fn savings(robot: &Description, selected: &Selected, tree: &Tree) -> Vec<Saved> {
    let mut all = Vec::new();
    for body in tree.bodies.iter().filter(|body| !body.snapped.is_empty()) {
        let mut rounded = robot.clone();
        if let Some(joint) = rounded.joints.iter_mut().find(|joint| joint.name == body.joint) {
            joint.exact = joint.origin;
        }
        let without = Tree::of(&rounded, selected, Numbers::Exact);
        let cycles = without.map_or(0.0, |without| estimated(&without) - estimated(tree));
        all.push(Saved {
            joint: body.joint.clone(),
            numbers: body
                .snapped
                .iter()
                .map(|snap| (snap.attribute.clone(), snap.text.clone(), snap.exact.clone()))
                .collect(),
            cycles: cycles as i64,
        });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::cycles;
    use crate::selection::Selection;
    use crate::source::parse;
    use crate::tree::{Numbers, Tree};

    /// The cycles that the engine was measured to take for the SO-101.
    const MEASURED: f64 = 978.0;

    #[test]
    fn the_cycle_estimate_is_within_27_percent() {
        let robot = parse(include_str!("../tests/urdf/so101.urdf"), ".".as_ref()).expect("a robot");
        let selected = Selection::default().of(&robot).expect("all joints");
        let tree = Tree::of(&robot, &selected, Numbers::Exact).expect("a tree");
        let estimated = cycles(&tree).expect("joints of one coordinate") as f64;
        assert!((estimated / MEASURED - 1.0).abs() < 0.27, "{estimated} of {MEASURED}");
    }
}
