//! The feedback, motion and drives of a project for a robot, from its inertia and the stiffness of
//! gravity, and what no feedback holds, in words.
//!
//! The template's law takes gravity at the reference and has the stiffness ω² M, so that ω² M +
//! ∂g/∂q has to be positive definite wherever the robot comes: else gravity pulls it away from its
//! reference faster than the feedback returns it.

use crate::description::Kind;
use crate::error::Result;
use crate::model::{AnyModel, Motion};
use crate::tree::{Body, Tree};

/// The natural frequency of a joint's feedback, rad/s, where gravity needs no more.
pub const OMEGA_N: f64 = 25.0;
/// The highest that a tick of 1 ms, encoders of 14 bits and an observer of 250 rad/s allow.
const MOST_OMEGA_N: f64 = 80.0;
/// The share of the feedback's stiffness that gravity may take.
const SHARE: f64 = 0.5;
/// Configurations within the limits at which inertia and gravity are looked at, besides the start
/// of the motion.
const SAMPLES: usize = 64;
/// The range of a joint without limits, to both sides, rad or m: the way of the excitation.
const FREE: f64 = 1.6;
/// A step of an encoder of 14 bits, rad.
const RESOLUTION: f64 = std::f64::consts::TAU / 16_384.0;
/// The bandwidth of the observer, rad/s: as in the template's `control.rs`.
const OBSERVER: f64 = 250.0;
/// So many steps of its encoder a joint's range has at least, or it stands still: as in the
/// template's `scene.rs`.
const NARROW: f64 = 32.0;
/// As in the template's `scene.rs`, rad/s².
const MOST_ACCELERATION: f64 = 1e5;

/// The dry friction of a joint relative to its inertia up to which feedback by that inertia holds
/// it, rad/s²; at twice this it does not.
const MOST_STOPPING: f64 = 5e5;

/// The numbers of a project that depend on the robot's inertia, and what its user has to know of
/// them.
#[derive(Clone, Debug, PartialEq)]
pub struct Feedback {
    /// The natural frequency, rad/s.
    pub omega_n: f64,
    /// The limits of the project at a joint, where it does otherwise than the file says: a sentence
    /// each.
    pub words: Vec<String>,
}

impl Default for Feedback {
    fn default() -> Self {
        Self { omega_n: OMEGA_N, words: Vec::new() }
    }
}

impl Feedback {
    /// The feedback of a tree of joints of one degree of freedom each; 25 rad/s and no words for
    /// others.
    ///
    /// # Errors
    /// As of [`AnyModel::of`].
    pub fn of(tree: &Tree) -> Result<Self> {
        let mut found = Self::default();
        if !tree.is_single() {
            return Ok(found);
        }
        let model = AnyModel::of(tree)?;
        let home = home(tree);
        let start = Place::of(tree, &model, &home);
        let inertia = match start.inertia() {
            Ok(inertia) => inertia,
            Err(joint) => {
                found.words.push(format!(
                    "joint `{}` moves no inertia: the simulation cannot run; give its links mass, \
                     or the file a rotor inertia",
                    tree.bodies[joint].joint
                ));
                return Ok(found);
            }
        };
        found.raise(tree, &model, &start);
        found.narrow(tree);
        found.needs(tree, &model, &start, &inertia);
        Ok(found)
    }

    /// Raises the frequency until the feedback holds the robot against gravity at all samples.
    fn raise(&mut self, tree: &Tree, model: &AnyModel, start: &Place) {
        let samples = (0..SAMPLES).map(|k| Place::of(tree, model, &sample(tree, k)));
        let places: Vec<Place> = samples.chain([start.clone()]).collect();
        let mut weakest = None;
        for place in &places {
            while let Some(joint) = place.falls(self.omega_n) {
                if self.omega_n >= MOST_OMEGA_N {
                    weakest = Some(joint);
                    break;
                }
                self.omega_n = (1.05 * self.omega_n).min(MOST_OMEGA_N);
            }
        }
        if let Some(joint) = weakest {
            self.words.push(format!(
                "joint `{}` is not held against gravity everywhere, and `cargo test` may fail: \
                 with the inertia of the links alone the feedback would need more than \
                 {MOST_OMEGA_N} rad/s; the file has no rotor inertia (armature), which geared \
                 motors have: state it",
                tree.bodies[joint].joint
            ));
        }
    }

    /// Ranges that no encoder sees.
    fn narrow(&mut self, tree: &Tree) {
        for body in &tree.bodies {
            let Some([lower, upper]) = body.limits.position else {
                continue;
            };
            let (range, step) = (upper - lower, RESOLUTION * ratio(body.kind));
            if range < NARROW * step {
                self.words.push(format!(
                    "joint `{}` has a range of {range:.1e}, a step of its encoder is {step:.1e}: \
                     it stands still, and the safety gate lets it be {NARROW} steps from there; \
                     `--lock {}={}` leaves it out",
                    body.joint,
                    body.joint,
                    0.5 * (lower + upper)
                ));
            }
        }
    }

    /// Limits of torque that are too small for the motion, or too large for the joint.
    fn needs(&mut self, tree: &Tree, model: &AnyModel, start: &Place, inertia: &[f64]) {
        let needed = needed(tree, model, &start.q);
        for (joint, body) in tree.bodies.iter().enumerate() {
            let (name, needed) = (&body.joint, needed[joint]);
            let Some(effort) = body.limits.effort else {
                continue;
            };
            let light = MOST_ACCELERATION * ratio(body.kind) * inertia[joint];
            if body.friction > MOST_STOPPING * ratio(body.kind) * inertia[joint] {
                self.words.push(format!(
                    "joint `{name}` has a dry friction of {} on an inertia of {:.1e} alone: no \
                     feedback holds it, and `cargo test` may fail; the file has no rotor inertia \
                     (armature), which a joint with such friction has: state it",
                    body.friction, inertia[joint]
                ));
            }
            let taken = effort.min((3.0 * needed).max(light));
            let rounding = self.of_rounding(tree, &start.mass[joint]);
            if needed > effort {
                self.words.push(format!(
                    "joint `{name}` needs {needed:.3} for the motion of the project, its limit of \
                     torque is {effort}: `cargo test` fails until `home`, `away` or `limits` in \
                     src/scene.rs are changed"
                ));
            } else if needed + rounding > taken {
                self.words.push(format!(
                    "joint `{name}` has a limit of torque of {taken:.3}; the motion of the project \
                     needs {needed:.3}, and the feedback asks for up to {rounding:.3} more at half \
                     a step of the encoders: `cargo test` may fail; see `limits` in src/scene.rs"
                ));
            } else if effort > taken {
                self.words.push(format!(
                    "joint `{name}` is light for its limit of torque, {effort}: it would be \
                     accelerated by {:.0e} rad/s² or m/s²; the project takes a limit of {:.3e}, \
                     see `limits` in src/scene.rs",
                    effort / inertia[joint],
                    taken
                ));
            }
        }
    }

    /// The greatest torque that the feedback asks for when all encoders are half a step off, from a
    /// row of M.
    fn of_rounding(&self, tree: &Tree, mass: &[f64]) -> f64 {
        let of = |(mass, body): (&f64, &Body)| mass.abs() * 0.5 * RESOLUTION * ratio(body.kind);
        let moved: f64 = mass.iter().zip(&tree.bodies).map(of).sum();
        (self.omega_n * self.omega_n + 2.0 * self.omega_n * OBSERVER) * moved
    }
}

/// A configuration, M and ∂g/∂q there.
#[derive(Clone, Debug)]
struct Place {
    q: Vec<f64>,
    mass: Vec<Vec<f64>>,
    gravity: Vec<Vec<f64>>,
}

impl Place {
    fn of(tree: &Tree, model: &AnyModel, q: &[f64]) -> Self {
        let mut mass = model.inertia(q, q.len());
        for (joint, body) in tree.bodies.iter().enumerate() {
            mass[joint][joint] += body.armature;
        }
        // Central differences, whose error is far below the share of it that is compared.
        let step = 1e-4;
        let torque = |joint: usize, step: f64| {
            let mut there = q.to_vec();
            there[joint] += step;
            model.gravity(&there)
        };
        let columns: Vec<Vec<f64>> = (0..q.len())
            .map(|joint| {
                let (above, below) = (torque(joint, step), torque(joint, -step));
                let pairs = above.iter().zip(&below);
                pairs.map(|(a, b)| (a - b) / (2.0 * step)).collect()
            })
            .collect();
        let gravity = (0..q.len())
            .map(|i| (0..q.len()).map(|j| 0.5 * (columns[i][j] + columns[j][i])).collect())
            .collect();
        Self { q: q.to_vec(), mass, gravity }
    }

    /// The first joint with which the feedback's share of stiffness does not hold the robot.
    fn falls(&self, omega_n: f64) -> Option<usize> {
        let sum = |(mass, gravity): (&Vec<f64>, &Vec<f64>)| {
            let entries = mass.iter().zip(gravity);
            entries.map(|(m, g)| SHARE * omega_n * omega_n * m + g).collect()
        };
        let stiffness: Vec<Vec<f64>> = self.mass.iter().zip(&self.gravity).map(sum).collect();
        factor(&stiffness).err()
    }

    /// The inertia of each joint with all others free to give way, 1/(M⁻¹)ⱼⱼ, or the joint that
    /// moves none.
    fn inertia(&self) -> std::result::Result<Vec<f64>, usize> {
        let n = self.mass.len();
        let factor = factor(&self.mass)?;
        // (M⁻¹)ⱼⱼ = Σ (L⁻¹)ₖⱼ² / dₖ
        let of = |joint: usize| {
            let (mut x, mut sum) = (vec![0.0; n], 0.0);
            for k in joint..n {
                let unit = if k == joint { 1.0 } else { 0.0 };
                let before: f64 = (joint..k).map(|i| factor[k][i] * x[i]).sum();
                x[k] = unit - before;
                sum += x[k] * x[k] / factor[k][k];
            }
            1.0 / sum
        };
        Ok((0..n).map(of).collect())
    }
}

/// L below the diagonal and D on it, of a symmetric matrix L D Lᵀ; the row of the first pivot that
/// is not positive.
fn factor(matrix: &[Vec<f64>]) -> std::result::Result<Vec<Vec<f64>>, usize> {
    let mut rows = matrix.to_vec();
    for k in 0..rows.len() {
        for j in 0..k {
            let before: f64 = (0..j).map(|i| rows[k][i] * rows[j][i] * rows[i][i]).sum();
            rows[k][j] = (rows[k][j] - before) / rows[j][j];
        }
        let before: f64 = (0..k).map(|i| rows[k][i] * rows[k][i] * rows[i][i]).sum();
        rows[k][k] -= before;
        let rounding = 1e-13 * matrix[k][k].abs();
        // False for a NaN, too.
        let is_positive = rows[k][k] > rounding;
        if !is_positive {
            return Err(k);
        }
    }
    Ok(rows)
}

/// The way of an encoder's radian, as in the template's `scene.rs`.
fn ratio(kind: Kind) -> f64 {
    match kind {
        Kind::Prismatic => 0.01,
        _ => 1.0,
    }
}

/// The start of the motion, as in the template's `scene.rs`.
fn home(tree: &Tree) -> Vec<f64> {
    let of = |limits: &Option<[f64; 2]>| match *limits {
        Some([lower, upper]) => {
            let margin = (upper - lower) / 6.0;
            0.0_f64.max(lower + margin).min(upper - margin)
        }
        None => 0.0,
    };
    tree.bodies.iter().map(|body| of(&body.limits.position)).collect()
}

/// The place where the motion turns back, as in the template's `scene.rs`.
fn away(tree: &Tree, home: &[f64]) -> Vec<f64> {
    let of = |(body, home): (&Body, &f64)| {
        let [lower, upper] = body.limits.position.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        if upper - lower < NARROW * RESOLUTION * ratio(body.kind) {
            return *home;
        }
        let (below, above) = (home - lower, upper - home);
        let slow = 4.0 * body.limits.velocity.unwrap_or(f64::INFINITY) / 3.75;
        let way = 0.3_f64.min(0.5 * below.max(above)).min(slow);
        home + if above >= below { way } else { -way }
    };
    tree.bodies.iter().zip(home).map(of).collect()
}

/// The greatest torque of each joint along the motion.
fn needed(tree: &Tree, model: &AnyModel, home: &[f64]) -> Vec<f64> {
    let away = away(tree, home);
    let way: Vec<f64> = away.iter().zip(home).map(|(away, home)| away - home).collect();
    let seconds = tree
        .bodies
        .iter()
        .zip(&way)
        .map(|(body, way)| 3.75 * way.abs() / body.limits.velocity.unwrap_or(f64::INFINITY));
    let seconds = seconds.fold(0.75, f64::max);
    let mut needed = vec![0.0_f64; home.len()];
    for k in 0..=24 {
        let s = f64::from(k) / 24.0;
        // A quintic from rest to rest, and its derivatives.
        let [place, speed, acceleration] = [
            s * s * s * (10.0 - 15.0 * s + 6.0 * s * s),
            30.0 * s * s * (1.0 - s) * (1.0 - s) / seconds,
            60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (seconds * seconds),
        ];
        for sign in [1.0, -1.0] {
            let scaled = |factor: f64| way.iter().map(|way| factor * way).collect::<Vec<f64>>();
            let motion = Motion {
                q: scaled(place).iter().zip(home).map(|(way, home)| way + home).collect(),
                qd: scaled(sign * speed),
                // The way back is the same in the opposite direction of time.
                qdd: scaled(acceleration),
            };
            let torque = model.torque(&motion);
            for (joint, body) in tree.bodies.iter().enumerate() {
                let direction = match motion.qd[joint] {
                    0.0 => 0.0,
                    moving => moving.signum(),
                };
                let torque = torque[joint]
                    + body.armature * motion.qdd[joint]
                    + body.damping * motion.qd[joint]
                    + body.friction * direction;
                needed[joint] = needed[joint].max(torque.abs());
            }
        }
    }
    needed
}

/// A configuration within the limits: a sequence that fills the box evenly, Roberts (2018), by the
/// roots of x^(n+1) = x + 1.
fn sample(tree: &Tree, k: usize) -> Vec<f64> {
    let n = tree.bodies.len();
    let mut root = 2.0_f64;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (n as f64 + 1.0));
    }
    let of = |(joint, body): (usize, &Body)| {
        let share = (0.5 + (k + 1) as f64 * root.powi(-(joint as i32 + 1))).fract();
        let [lower, upper] = body.limits.position.unwrap_or([-FREE, FREE]);
        lower + share * (upper - lower)
    };
    tree.bodies.iter().enumerate().map(of).collect()
}
