//! Proof of an import: torques of the tree against paths that do not share its code.

pub mod coordinates;
pub mod energy;
mod loops;
mod random;

pub use loops::loops;

use crate::description::Description;
use crate::error::Result;
use crate::limits::{MOST_WORK, MOST_WORK_OF_INERTIA};
use crate::model::{AnyModel, Motion};
use crate::selection::Selected;
use crate::tree::{Numbers, Tree};
use energy::Energy;
use random::Random;

/// The number of states.
pub const STATES: usize = 100;
/// The largest random position, rad or m: attitudes within a quarter turn keep the chain of a ball
/// joint away from its singularity.
const SIZE: f64 = 1.2;
/// The largest difference of torques, of full scale.
pub const MOST: f64 = 1e-10;

/// The findings of a check; differences are shares of the largest torque.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Checked {
    /// The number of states.
    pub states: usize,
    /// The largest torque, N·m or N.
    pub full_scale: f64,
    /// From Lagrange's equations of the file's links, in f64.
    pub energy: f64,
    /// The difference of the exact numbers from those of the file: the price of the snaps.
    pub snapping: f64,
    /// The difference of f32 from f64.
    pub f32: f64,
    /// The distance of the frames of written loops from those on the file's links, m, if it has
    /// loops.
    pub loops: Option<f64>,
    /// The logarithm of the condition number of M, the largest of the states, or of the first of
    /// them for a large robot.
    pub condition: f64,
    /// The motions and the torques.
    #[serde(skip)]
    pub samples: Vec<(Motion, Vec<f64>)>,
}

impl Checked {
    /// Whether the energies and the loops agree with the library.
    pub fn holds(&self) -> bool {
        self.energy <= MOST && self.loops.is_none_or(|loops| loops <= MOST)
    }
}

/// Checks a selection at random states.
///
/// # Errors
/// A robot that is too large, or that the library refuses.
pub fn check(robot: &Description, selected: &Selected, states: usize) -> Result<Checked> {
    let given = Tree::of(robot, selected, Numbers::AsGiven)?;
    let exact = Tree::of(robot, selected, Numbers::Exact)?;
    check_trees(robot, selected, [&given, &exact], states)
}

/// Checks trees of a selection, one of the file's numbers and one with exact values.
///
/// # Errors
/// As [`check()`].
pub fn check_trees(
    robot: &Description,
    selected: &Selected,
    [given, exact]: [&Tree; 2],
    states: usize,
) -> Result<Checked> {
    let (library, snapped) = (AnyModel::of(given)?, AnyModel::of(exact)?);
    let energy = Energy::of(robot, selected);
    let states = states.min(MOST_WORK / robot.links.len()).max(1);
    let mut random = Random::new(1);
    let mut checked = Checked {
        states,
        full_scale: 0.0,
        energy: 0.0,
        snapping: 0.0,
        f32: 0.0,
        loops: None,
        condition: 0.0,
        samples: Vec::new(),
    };
    let v = given.coordinates()[1].max(1);
    let of_inertia = (MOST_WORK_OF_INERTIA / (v * v)).max(1);
    for state in 0..states {
        let mut draw = |size: f64| -> Vec<f64> {
            (0..energy.coordinates).map(|_| size * random.symmetric()).collect()
        };
        let (u, ud, udd) = (draw(SIZE), draw(2.0), draw(5.0));
        let by_energy = energy.torque(&u, &ud, &udd);
        let (motion, columns) = in_library(given, &u, &ud, &udd);
        let found = library.torque(&motion);
        let (moved, rounded) = (snapped.torque(&motion), snapped.torque_f32(&motion));
        let in_chain = on_chain(&columns, &found);
        let size = |values: &[f64]| values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        checked.full_scale = checked.full_scale.max(size(&by_energy)).max(size(&found));
        checked.energy = checked.energy.max(largest(&by_energy, &in_chain));
        checked.snapping = checked.snapping.max(largest(&found, &moved));
        checked.f32 = checked.f32.max(largest(&moved, &rounded));
        if state < of_inertia {
            let m = snapped.inertia(&motion.q, given.coordinates()[1]);
            checked.condition = checked.condition.max(condition(&m));
        }
        checked.samples.push((motion, found));
    }
    // A robot without mass has no torque.
    let scale = if checked.full_scale > 0.0 { checked.full_scale } else { 1.0 };
    for difference in [&mut checked.energy, &mut checked.snapping, &mut checked.f32] {
        *difference /= scale;
    }
    Ok(checked)
}

/// A motion of the chains in the library's coordinates, with ∂v/∂u̇ of each body.
fn in_library(tree: &Tree, u: &[f64], ud: &[f64], udd: &[f64]) -> (Motion, Vec<Vec<Vec<f64>>>) {
    let mut motion = Motion { q: Vec::new(), qd: Vec::new(), qdd: Vec::new() };
    let (mut at, mut columns) = (0, Vec::new());
    for body in &tree.bodies {
        let range = at..at + energy::axes(body.kind).len();
        at = range.end;
        let [u, ud, udd] = [u, ud, udd].map(|values| &values[range.clone()]);
        let joint = coordinates::motion(body.kind, u, ud, udd);
        motion.q.extend(joint.q);
        motion.qd.extend(joint.qd);
        motion.qdd.extend(joint.qdd);
        columns.push(joint.columns);
    }
    (motion, columns)
}

/// Forces on the chains' coordinates of those on the library's: the transposes of ∂v/∂u̇.
fn on_chain(columns: &[Vec<Vec<f64>>], torque: &[f64]) -> Vec<f64> {
    let (mut at, mut out) = (0, Vec::new());
    for columns in columns {
        let range = at..at + columns.len();
        at = range.end;
        let own = &torque[range];
        let work = |column: &Vec<f64>| column.iter().zip(own).map(|(a, b)| a * b).sum::<f64>();
        out.extend(columns.iter().map(work));
    }
    out
}

/// The largest difference; infinite if one is not a number.
fn largest(a: &[f64], b: &[f64]) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, |most: f64, x| if x.is_nan() { f64::INFINITY } else { most.max(x) })
}

/// The decadic logarithm of the ratio of the largest pivot of M to the smallest: a bound from below
/// of that of the condition number. Infinite if M is not positive definite.
fn condition(m: &[Vec<f64>]) -> f64 {
    let mut rest: Vec<Vec<f64>> = m.to_vec();
    let (mut most, mut least) = (0.0_f64, f64::INFINITY);
    while let Some(last) = rest.pop() {
        let pivot = last[rest.len()];
        (most, least) = (most.max(pivot), least.min(pivot));
        for (row, &factor) in rest.iter_mut().zip(&last) {
            let entries = row.iter_mut().zip(&last);
            entries.for_each(|(entry, &other)| *entry -= factor / pivot * other);
        }
    }
    if least > 0.0 { (most / least).log10() } else { f64::INFINITY }
}
