//! A floor of the least eigenvalue of an arm's inertia matrix by taking its last body off, again
//! and again.
//!
//! Let the last joint have the velocity w and the others a, with
//!
//!   q̇ᵀ M q̇ = aᵀ S a + D (w + bᵀa / D)²
//!
//! where D and b are the last row of M: D is the second moment of the last body about its own axis,
//! or its mass, whatever the position is, and S what the other joints feel while the last one is
//! free. A symmetric J with J z = 0 for the joint's motion z, with the same rotated about the axis,
//! and below the body's inertia I, I − J ⪰ 0, is below what the free body weighs on its parent too:
//! the complement of Schur of I − J is I − I z zᵀ I / zᵀ I z − J. So S is no less than the inertia
//! matrix of the arm without the last body, with J as part of the body before it. If that one is
//! above the diagonal matrix of F_i,
//!
//!   q̇ᵀ M q̇ ≥ Σ s F_i a_i² + Σ (1 − s) F_i a_i² + D (w + bᵀa / D)²
//!
//! for any share s, and with Σ b_i² / F_i ≤ K² the last two are at least D w² / (1 + K² / ((1 − s)
//! D)) for every a.

use std::collections::BinaryHeap;

use crate::bodies::{Body, Moves, Position, inertia_matrix};
use crate::interval::Interval;
use crate::parts::{Part, WIDE, somewhere, wide};
use crate::positive::not_positive;
use crate::taylor::{SLOPES, Scalar, Taylor};

/// A robot's bodies with those that stand still on others as parts of them; bodies that stand still
/// on the base are none.
pub fn welded(bodies: &[Body]) -> Vec<Body> {
    let mut bodies = bodies.to_vec();
    while let Some(k) = bodies.iter().rposition(|body| body.moves == Moves::Fixed) {
        let body = bodies.remove(k);
        if let Some(parent) = body.parent {
            bodies[parent] = with(&bodies[parent], &body, body.inertia);
        }
        for other in &mut bodies[k..] {
            other.parent = match other.parent {
                Some(parent) if parent == k => {
                    *other = on_parent(other, &body);
                    body.parent
                }
                Some(parent) if parent > k => Some(parent - 1),
                parent => parent,
            };
        }
    }
    bodies
}

/// A body whose parent stands still on a parent of its own, as placed on that one.
fn on_parent(body: &Body, parent: &Body) -> Body {
    let placed = |row: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|j| (0..3).map(|k| row[k] * parent.rot[k][j]).sum())
    };
    let moved = parent.unplaced(body.pos);
    Body {
        rot: body.rot.map(placed),
        pos: std::array::from_fn(|i| parent.pos[i] + moved[i]),
        ..*body
    }
}

/// A body with an inertia that is given in the frame of another one on it.
fn with(body: &Body, other: &Body, inertia: [f64; 10]) -> Body {
    let given = Body { inertia, moves: Moves::Fixed, parent: None, ..*other };
    let moved = crate::bodies::at_parent(&given);
    Body { inertia: std::array::from_fn(|i| body.inertia[i] + moved[i]), ..*body }
}

/// The arm without its last body, which keeps what is sure to hang on it.
pub fn without_last(bodies: &[Body]) -> Vec<Body> {
    let mut rest = bodies.to_vec();
    if let Some(last) = rest.pop()
        && let Some(parent) = last.parent
    {
        rest[parent] = with(&rest[parent], &last, hanging(&last));
    }
    rest
}

/// J: mass and first moment along the axis, and one second moment across it.
fn hanging(body: &Body) -> [f64; 10] {
    let none = [0.0; 10];
    let Moves::Turns(_) = body.moves else {
        return none;
    };
    let [mass, _, _, hz, xx, _, _, yy, ..] = body.inertia;
    for percent in (1..=19).rev() {
        let share = 0.05 * f64::from(percent);
        let across = share * xx.min(yy);
        let given = [share * mass, 0.0, 0.0, share * hz, across, 0.0, 0.0, across, 0.0, 0.0];
        let left: [f64; 10] = std::array::from_fn(|i| body.inertia[i] - given[i]);
        if is_positive(&left) {
            return given;
        }
    }
    none
}

/// Whether the six by six matrix of mass, first and second moments is positive definite.
fn is_positive(inertia: &[f64; 10]) -> bool {
    let [m, x, y, z, xx, xy, xz, yy, yz, zz] = *inertia;
    let mut matrix = vec![
        vec![m],
        vec![0.0, m],
        vec![0.0, 0.0, m],
        vec![0.0, -z, y, xx],
        vec![z, 0.0, -x, xy, yy],
        vec![-y, x, 0.0, xz, yz, zz],
    ];
    not_positive(&mut matrix).is_none()
}

/// D of the last joint.
pub fn own(bodies: &[Body]) -> f64 {
    bodies.last().map_or(0.0, |last| match last.moves {
        Moves::Slides(_) => last.inertia[0],
        _ => last.inertia[9],
    })
}

/// The lower bound that is left for the last joint if the others keep a share, rounded down.
pub fn least(own: f64, coupling: f64, share: f64) -> f64 {
    own / (1.0 + coupling * coupling / ((1.0 - share) * own)) * (1.0 - 1e-12)
}

/// A bound so little above what a position has is not lowered.
const CLOSE: f64 = 1.03;

/// K: at least the greatest root of Σ b_i² / F_i over these positions, by so many parts.
pub fn coupling(bodies: &[Body], positions: &[Interval], floors: &[f64], parts: usize) -> f64 {
    let n = positions.len();
    let row = |part: &[Interval]| -> Vec<Taylor> {
        let at: Vec<Position<Taylor>> =
            part.iter().enumerate().map(|(joint, range)| Position::over(joint, *range)).collect();
        let mut matrix = inertia_matrix(bodies, n, &at);
        let mut last = matrix.pop().unwrap_or_default();
        last.pop();
        let weighted = last.iter().zip(floors);
        weighted.map(|(b, floor)| b.times(1.0 / floor.sqrt())).collect()
    };
    let small = row(&somewhere(positions));
    let depends = |k: &usize| small.iter().any(|x| x.slopes[*k] != 0.0);
    let axes: Vec<usize> = (0..SLOPES.min(n)).filter(depends).collect();
    let mut found = 0.0_f64;
    let bounded = |positions: Vec<Interval>| {
        let row = row(&positions);
        let here = row.iter().map(|x| (x.centre.abs() - x.rest).max(0.0).powi(2));
        let here = here.sum::<f64>().sqrt();
        let squares = row.iter().map(|x| x.square());
        let sum = squares.fold(Taylor::default(), |sum, x| sum + x);
        let apart: f64 = row.iter().map(|x| x.magnitude().powi(2)).sum();
        let gain = |k: usize| sum.slopes[k].abs();
        let axis = axes.iter().copied().max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
        let part = Part {
            bound: sum.range().high.max(0.0).min(apart).sqrt() * (1.0 + 1e-9),
            axis: wide(&axes, &positions, WIDE).or(axis),
            positions,
        };
        (part, here)
    };
    let mut open = BinaryHeap::from([bounded(positions.to_vec()).0]);
    let mut left = parts;
    while let Some(part) = open.pop() {
        let is_done = left == 0 || part.bound <= CLOSE * found;
        let Some(halves) = part.halves().filter(|_| !is_done) else {
            return part.bound;
        };
        left -= 1;
        for half in halves {
            let (part, here) = bounded(half);
            found = found.max(here);
            open.push(part);
        }
    }
    f64::INFINITY
}
