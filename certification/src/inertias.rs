//! The most that a torque changes if the inertia of each link is known within some percent, over
//! all positions, speeds and accelerations.
//!
//! A link is what moves as one. Its mass, first and second moments are all off by the same factor,
//! at most 1 ± x: its mass is, and its centre of mass and radii of gyration are not, so that what
//! is assumed stays a body. Each link has a factor of its own. Torques are linear in inertias, so
//! that joint i needs at most x Σ_k |τ_i^k| more or less, where τ_i^k is what link k alone needs,
//! and some factors need it.
//!
//! For any signs s_k and any speeds and accelerations, Σ s_k τ_i^k is a trigonometric polynomial of
//! degree two in each angle, as the inertia matrix is; one in cos θ for a joint that slides to q =
//! middle + half cos θ. By the theorem of Riesz ([`crate::grid`]) the most over all angles is below
//! that of a grid of N by no more than 1 / cos(2 π / N) for each joint. Of joints with limits there
//! is a second bound: a polynomial with |T| ≤ M has |T''| ≤ 4 M (Bernstein), so that between points
//! of the range, 2 δ apart and its ends among them, it is at most 2 M δ² above them. The lesser one
//! counts.
//!
//! At a point of the grid the signs of each link and each joint's speed are tried, and
//! accelerations and squares of speeds add up.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::bodies::{Body, Moves, Position};
use crate::interval::Interval;
use crate::links::{EARTH, Frame, Size, terms};

mod probe;

pub use probe::Links;

/// What inertias can change of a joint's torque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// It is nowhere above this, N·m or N.
    pub bound: f64,
    /// The greatest that was found.
    pub found: f64,
}

/// Of each joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bands {
    /// By how many percent each link's inertia is off.
    pub percent: f64,
    /// By joint.
    pub joints: Vec<Band>,
}

/// How much is spent.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Points of each grid.
    pub points: usize,
    /// States of the search.
    pub states: usize,
}

/// The degree of a torque in the position of a joint.
const DEGREE: f64 = 2.0;
/// With more links, or joints, their signs are not tried: absolute values add up.
const SIGNS: usize = 8;
/// More than the relative errors of the last sums and products.
const UP: f64 = 1.0 + 1e-12;

/// Which points the grid has of an angle with limits.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    Circle,
    Range,
}

/// The values of a joint's position on a grid.
struct Axis {
    points: Vec<Position<f64>>,
    /// What is between them is at most by 1 / cosine, or by the rise times M, above them.
    cosine: f64,
    rise: f64,
}

impl Axis {
    fn new(body: &Body, matters: bool, range: Interval, size: usize, of: Of) -> Self {
        let (middle, half) = (
            0.5 * (range.low + range.high),
            0.5 * (range.high - range.low),
        );
        let size = if matters { size } else { 1 };
        let turn = |i: usize| TAU * i as f64 / size as f64;
        let cosine = if matters {
            (DEGREE * PI / size as f64).cos()
        } else {
            1.0
        };
        let is_turn = 2.0 * half >= TAU;
        match body.moves {
            // Both sides of the circle have the same positions.
            Moves::Slides(_) => Self {
                points: (0..=size / 2)
                    .map(|i| Position::at(middle + half * turn(i).cos()))
                    .collect(),
                cosine,
                rise: 0.0,
            },
            _ if of == Of::Range && matters && !is_turn => {
                let steps = (size - 1) as f64;
                let at = |i: usize| range.low + 2.0 * half * (i as f64 / steps);
                Self {
                    points: (0..size).map(|i| Position::at(at(i))).collect(),
                    cosine: 1.0,
                    rise: 0.5 * (DEGREE * half / steps).powi(2),
                }
            }
            _ => Self {
                points: (0..size).map(|i| Position::at(turn(i))).collect(),
                cosine,
                rise: 0.0,
            },
        }
    }
}

/// A link on the way, at a point of the grid.
#[derive(Default)]
struct Here {
    frame: Frame<f64>,
    /// Times what their terms are at most.
    coefficients: Vec<f64>,
}

/// The links from the base to one of them.
struct Chain {
    bodies: Vec<Body>,
    /// Which of them no chain before has counted.
    counts: Vec<bool>,
    /// Whether the joint's position matters.
    matters: Vec<bool>,
    most: Vec<f64>,
}

impl Chain {
    /// What the computation's terms add up to at most, and what its roundings hide, for each joint.
    fn sizes(&self, ranges: &[Interval]) -> Vec<Size> {
        let mut sizes = vec![Size::default(); self.bodies.len()];
        let mut frame = Frame::base(Size::new(EARTH, 1e-11));
        let mut to = Vec::new();
        for (k, body) in self.bodies.iter().enumerate() {
            let most = ranges[k].magnitude();
            let one = Size::new(1.0, 1e-14 * most.max(1.0));
            let before = std::mem::take(&mut frame);
            let at = Position::plain(one, one, Size::new(most, 1e-14 * most));
            frame.set(body, &before, at);
            if !self.counts[k] {
                continue;
            }
            frame.coefficients(&body.inertia, &mut to);
            for (size, row) in sizes.iter_mut().zip(to.chunks_exact(terms(k + 1))) {
                for (one, most) in row.iter().zip(&self.most) {
                    size.most += one.most * most;
                    size.error += (one.error + 1e-12 * one.most) * most;
                }
            }
        }
        sizes
    }

    /// The greatest of each joint on a grid, of those above what was found, and everywhere.
    fn grid(
        &self,
        ranges: &[Interval],
        found: &[f64],
        points: usize,
        of: Of,
        circle: &[f64],
    ) -> Vec<f64> {
        let dimensions = self.matters.iter().filter(|matters| **matters).count();
        let fits = |size: &usize| {
            size.checked_pow(dimensions as u32)
                .is_some_and(|all| all <= points)
        };
        let sizes = self.sizes(ranges);
        // Without angles five points are one.
        let Some(size) = (5..=100_000).take_while(fits).last() else {
            return sizes
                .iter()
                .map(|size| (size.most + size.error) * UP)
                .collect();
        };
        let axes: Vec<Axis> = (0..self.bodies.len())
            .map(|k| Axis::new(&self.bodies[k], self.matters[k], ranges[k], size, of))
            .collect();
        let mut here: Vec<Here> = self.bodies.iter().map(|_| Here::default()).collect();
        let mut best = found.to_vec();
        self.visit(&axes, 0, &Frame::base(EARTH), &mut here, &mut best);
        let cosine: f64 = axes.iter().map(|axis| axis.cosine).product();
        let rise: f64 = axes.iter().map(|axis| axis.rise).sum();
        let above = best.iter().zip(&sizes).zip(circle);
        above
            .map(|((best, size), circle)| {
                let on_grid = best + size.error;
                let rise = if rise > 0.0 { rise * circle } else { 0.0 };
                ((on_grid + rise) / cosine * UP).min((size.most + size.error) * UP)
            })
            .collect()
    }

    fn visit(
        &self,
        axes: &[Axis],
        k: usize,
        before: &Frame<f64>,
        here: &mut [Here],
        best: &mut [f64],
    ) {
        let Some(body) = self.bodies.get(k) else {
            return;
        };
        for at in &axes[k].points {
            let own = &mut here[k];
            own.frame.set(body, before, *at);
            own.frame.coefficients(&body.inertia, &mut own.coefficients);
            for row in own.coefficients.chunks_exact_mut(terms(k + 1)) {
                row.iter_mut()
                    .zip(&self.most)
                    .for_each(|(x, most)| *x *= most);
            }
            if k + 1 < self.bodies.len() {
                let frame = std::mem::take(&mut own.frame);
                self.visit(axes, k + 1, &frame, here, best);
                here[k].frame = frame;
                continue;
            }
            for (i, best) in best.iter_mut().enumerate() {
                let rows: Vec<&[f64]> = (i..=k)
                    .filter(|k| self.counts[*k])
                    .map(|k| row(&here[k], i, k))
                    .collect();
                *best = greatest(&rows, k + 1, *best);
            }
        }
    }
}

fn row(here: &Here, i: usize, k: usize) -> &[f64] {
    let length = terms(k + 1);
    &here.coefficients[i * length..(i + 1) * length]
}

/// The most of Σ |τ^k| over speeds and accelerations if it is above what is known already: an upper
/// bound of it.
fn greatest(rows: &[&[f64]], joints: usize, known: f64) -> f64 {
    let apart: f64 = rows
        .iter()
        .map(|row| row.iter().map(|x| x.abs()).sum::<f64>())
        .sum();
    if apart <= known || rows.len() > SIGNS || joints > SIGNS || rows.is_empty() {
        return apart.max(known);
    }
    let mut best = known;
    for signs in 0..1_usize << (rows.len() - 1) {
        let mut sum = [0.0; terms(SIGNS)];
        for (number, row) in rows.iter().enumerate() {
            let sign = if signs >> number & 1 != 0 { -1.0 } else { 1.0 };
            sum.iter_mut()
                .zip(*row)
                .for_each(|(sum, x)| *sum += sign * x);
        }
        if sum.iter().map(|x| x.abs()).sum::<f64>() > best {
            best = best.max(with_speeds(&sum, joints));
        }
    }
    best
}

/// The most of |τ| over speeds and accelerations: it is linear in each product of two different
/// joints' speeds, so that these are at their greatest, one way or the other; squares count where
/// they add.
fn with_speeds(x: &[f64; terms(SIGNS)], joints: usize) -> f64 {
    let (mut accelerations, mut squares) = (0.0, [0.0; 2]);
    for a in 0..joints {
        let (first, square) = (terms(a), x[terms(a + 1) - 1]);
        accelerations += x[first].abs();
        squares[0] += square.max(0.0);
        squares[1] += (-square).max(0.0);
    }
    let mut products = [0.0_f64; 2];
    for signs in 0..1_usize << (joints - 1) {
        let sign = |a: usize| if signs >> a & 1 != 0 { -1.0 } else { 1.0 };
        let mut sum = 0.0;
        for a in 1..joints {
            let row = &x[terms(a) + 1..terms(a + 1) - 1];
            let own: f64 = row.iter().enumerate().map(|(b, x)| sign(b) * x).sum();
            sum += sign(a) * own;
        }
        products = [products[0].max(sum), products[1].max(-sum)];
    }
    (x[0] + squares[0] + products[0]).max(-x[0] + squares[1] + products[1]) + accelerations
}
