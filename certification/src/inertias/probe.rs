//! The links of a robot at states, the search for the worst of them, and the bound over all.

use super::{Band, Bands, Chain, Effort, Of};
use crate::bodies::{Body, Moves, Position};
use crate::digits::short;
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::links::{EARTH, Frame, monomials, terms};
use crate::peel::welded;
use crate::state_box::Robot;

/// A robot's links, each with what is welded on it.
#[derive(Clone, Debug)]
pub struct Links {
    bodies: Vec<Body>,
    /// The links from the base to each.
    paths: Vec<Vec<usize>>,
    joints: Vec<usize>,
}

/// At most so far from zero, gravity has no part in a direction: what [`crate::links::Size`] gives
/// a literal.
const NO_GRAVITY: f64 = 1e-14;

impl Links {
    /// Of a robot's bodies.
    ///
    /// # Errors
    /// [`Error::Robot`] if two bodies move by the same joint.
    pub fn of(bodies: &[Body]) -> Result<Self> {
        let mut bodies = welded(bodies);
        let joints: Vec<usize> = bodies.iter().filter_map(Body::joint).collect();
        for (k, joint) in joints.iter().enumerate() {
            if joints[..k].contains(joint) {
                let both = format!(
                    "joint {}: two bodies move by it, which torque bands do not take",
                    joint + 1
                );
                return Err(Error::Robot(both));
            }
        }
        let mut paths: Vec<Vec<usize>> = Vec::new();
        for (k, body) in bodies.iter_mut().enumerate() {
            body.rot = orthonormal(body.rot);
            let mut path = body
                .parent
                .and_then(|parent| paths.get(parent))
                .cloned()
                .unwrap_or_default();
            path.push(k);
            paths.push(path);
        }
        Ok(Self {
            bodies,
            paths,
            joints,
        })
    }

    /// What each link alone needs of each joint at a state, by joint and link.
    pub fn torques(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<Vec<f64>> {
        let n = self.bodies.len();
        let mut torques = vec![vec![0.0; n]; q.len()];
        let mut frames: Vec<Frame<f64>> = Vec::with_capacity(n);
        let (base, mut to) = (Frame::base(EARTH), Vec::new());
        for (k, body) in self.bodies.iter().enumerate() {
            let mut frame = Frame::default();
            let before = body
                .parent
                .and_then(|parent| frames.get(parent))
                .unwrap_or(&base);
            frame.set(body, before, Position::at(q[self.joints[k]]));
            frame.coefficients(&body.inertia, &mut to);
            let joints = self.along(&self.paths[k]);
            let of = |x: &[f64]| -> Vec<f64> { joints.iter().map(|joint| x[*joint]).collect() };
            let monomials = monomials(&of(qd), &of(qdd));
            for (joint, row) in joints.iter().zip(to.chunks_exact(terms(joints.len()))) {
                torques[*joint][k] = row.iter().zip(&monomials).map(|(x, y)| x * y).sum();
            }
            frames.push(frame);
        }
        torques
    }

    fn along(&self, path: &[usize]) -> Vec<usize> {
        path.iter().map(|k| self.joints[*k]).collect()
    }

    /// The greatest Σ |τ^k| of each joint that some states have: at random, corners among them, and
    /// near the worst of them.
    pub fn search(&self, robot: &Robot, states: usize) -> Vec<f64> {
        let (n, whole) = (robot.joints.len(), robot.whole());
        let mut rng = fastrand::Rng::with_seed(1);
        let mut best = vec![(0.0, vec![0.0; 3 * n]); n];
        let sums = |x: &[f64]| -> Vec<f64> {
            let torques = self.torques(&x[..n], &x[n..2 * n], &x[2 * n..]);
            torques
                .iter()
                .map(|row| row.iter().map(|x| x.abs()).sum())
                .collect()
        };
        let keep = |x: &[f64], best: &mut Vec<(f64, Vec<f64>)>| {
            for (sum, best) in sums(x).into_iter().zip(best) {
                if sum > best.0 {
                    *best = (sum, x.to_vec());
                }
            }
        };
        let drawn = |k: usize, rng: &mut fastrand::Rng| {
            let Interval { low, high } = whole[k];
            match rng.u8(..8) {
                0 if k < n => low,
                1 if k < n => high,
                0..=3 if k >= n => low,
                4..=6 if k >= n => high,
                _ => low + rng.f64() * (high - low),
            }
        };
        for _ in 0..states / 2 {
            let x: Vec<f64> = (0..3 * n).map(|k| drawn(k, &mut rng)).collect();
            keep(&x, &mut best);
        }
        let each = states / 2 / n.max(1);
        for joint in 0..n {
            for number in 0..each {
                let mut x = best[joint].1.clone();
                let near = 0.3 * 0.01_f64.powf(number as f64 / each as f64);
                for _ in 0..=rng.usize(..3) {
                    let k = rng.usize(..3 * n);
                    let Interval { low, high } = whole[k];
                    let moved = x[k] + near * (high - low) * (rng.f64() - 0.5);
                    x[k] = if k < n && rng.bool() {
                        moved.clamp(low, high)
                    } else {
                        drawn(k, &mut rng)
                    };
                }
                keep(&x, &mut best);
            }
        }
        best.into_iter().map(|one| one.0).collect()
    }

    /// The bound of each joint's Σ |τ^k|, of those above what was found.
    pub fn bounds(&self, robot: &Robot, found: &[f64], points: usize) -> Vec<f64> {
        let mut bounds = vec![0.0; robot.joints.len()];
        let is_last = |k: &usize| !self.bodies.iter().any(|body| body.parent == Some(*k));
        let ends: Vec<usize> = (0..self.bodies.len()).filter(is_last).collect();
        let mut counted = vec![false; self.bodies.len()];
        let whole = robot.whole();
        for end in &ends {
            let path = &self.paths[*end];
            let joints = self.along(path);
            let of = |x: fn(&crate::state_box::Joint) -> f64| -> Vec<f64> {
                joints
                    .iter()
                    .map(|joint| x(&robot.joints[*joint]))
                    .collect()
            };
            let chain = Chain {
                bodies: path.iter().map(|k| self.bodies[*k]).collect(),
                counts: path.iter().map(|k| !counted[*k]).collect(),
                matters: self.matters(path),
                most: monomials(&of(|one| one.speed), &of(|one| one.acceleration)),
            };
            path.iter().for_each(|k| counted[*k] = true);
            let ranges: Vec<Interval> = joints.iter().map(|joint| whole[*joint]).collect();
            // What was found is of all links.
            let known: Vec<f64> = joints
                .iter()
                .map(|joint| if ends.len() == 1 { found[*joint] } else { 0.0 })
                .collect();
            let circle = chain.grid(&ranges, &known, points, Of::Circle, &vec![0.0; known.len()]);
            let range = chain.grid(&ranges, &known, points, Of::Range, &circle);
            for (joint, (a, b)) in joints.iter().zip(circle.iter().zip(&range)) {
                bounds[*joint] += a.min(*b);
            }
        }
        bounds
    }

    /// Whether the torques depend on each joint's position: not on that of slides next to the base,
    /// nor of a first turn about the vertical.
    fn matters(&self, path: &[usize]) -> Vec<bool> {
        let mut frame = Frame::base(EARTH);
        let mut is_still = true;
        let mut all = Vec::new();
        for (number, k) in path.iter().enumerate() {
            let body = &self.bodies[*k];
            let before = std::mem::take(&mut frame);
            frame.set(body, &before, Position::at(0.0));
            let [x, y, _] = frame.up();
            let is_vertical = number == 0 && x.abs().max(y.abs()) <= NO_GRAVITY * EARTH;
            let is_slide = matches!(body.moves, Moves::Slides(_));
            all.push(!(is_still && (is_slide || is_vertical)));
            is_still &= is_slide;
        }
        all
    }
}

impl Bands {
    /// Of a robot whose links' inertias are each off by at most so many percent.
    ///
    /// # Errors
    /// [`Error::Robot`] of a percentage that is none, or of bodies that are not taken.
    pub fn prove(bodies: &[Body], robot: &Robot, percent: f64, effort: Effort) -> Result<Self> {
        if !(percent > 0.0 && percent <= 100.0) {
            return Err(Error::Robot(format!(
                "--inertias {percent}: not above 0 and up to 100 percent"
            )));
        }
        let links = Links::of(bodies)?;
        let found = links.search(robot, effort.states);
        let bounds = links.bounds(robot, &found, effort.points);
        let share = 0.01 * percent;
        let joints = bounds.iter().zip(&found);
        Ok(Self {
            percent,
            joints: joints
                .map(|(bound, found)| Band {
                    bound: share * bound * super::UP,
                    found: share * found,
                })
                .collect(),
        })
    }

    /// As a table.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "Inertial parameters of each link off by up to {} %, all of a link by one factor:\n\n| joint | torque off by at most, N·m or N | found | bound / found \
             |\n|---|---|---|---|\n",
            self.percent
        );
        let shown = |x: f64| match x {
            0.1.. => format!("{x:.3}"),
            _ => short(x),
        };
        for (number, Band { bound, found }) in self.joints.iter().enumerate() {
            let (number, at_most, most) = (number + 1, shown(*bound), shown(*found));
            text += &match *found > 0.0 {
                true => format!("| {number} | {at_most} | {most} | {:.2} |\n", bound / found),
                false => format!("| {number} | {at_most} | {most} | |\n"),
            };
        }
        text
    }
}

/// The rotation next to a matrix that is one up to roundings.
fn orthonormal(rot: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let [x, y, _] = rot;
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a: [f64; 3]| a.map(|x| x / dot(a, a).sqrt());
    let x = unit(x);
    let along = dot(x, y);
    let y = unit(std::array::from_fn(|i| y[i] - along * x[i]));
    [x, y, crate::bodies::cross(x, y)]
}
