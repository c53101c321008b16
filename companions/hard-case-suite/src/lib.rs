//! The suite as data: its files as any library reads them, and this library's errors.

use std::path::{Path, PathBuf};

use dynamics_core::algorithms::{aba, crba, forward_dynamics, rnea};
use dynamics_core::effects::{Armature, Coriolis, GravityVector, Inertia};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::state::State;
use serde::Deserialize;

/// A file of the suite.
#[derive(Clone, Debug, Deserialize)]
pub struct SuiteCase {
    pub case: u32,
    pub name: String,
    robot: Robot,
    states: Vec<GivenState>,
    pub answers: Vec<Answers>,
    bound: Bound,
}

#[derive(Clone, Debug, Deserialize)]
struct Robot {
    gravity: [f64; 3],
    links: Vec<SuiteLink>,
}

#[derive(Clone, Debug, Deserialize)]
struct SuiteLink {
    parent: i64,
    joint: String,
    axis: [f64; 3],
    /// Rows: the link's attitude in its parent.
    rotation: [[f64; 3]; 3],
    translation: [f64; 3],
    mass: f64,
    com: [f64; 3],
    inertia: [f64; 6],
    armature: f64,
}

#[derive(Clone, Debug, Deserialize)]
struct GivenState {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    tau: Vec<f64>,
}

/// The answers, as numbers of 50 digits.
#[derive(Clone, Debug, Deserialize)]
pub struct Answers {
    pub tau: Vec<String>,
    /// None if M is singular: forward dynamics is to be refused.
    pub qdd: Option<Vec<String>>,
    /// The matrix, for robots with few joints.
    #[serde(rename = "M")]
    pub matrix: Option<Vec<Vec<String>>>,
}

#[derive(Clone, Debug, Deserialize)]
struct Bound {
    /// None if f32 does not have the numbers of the case.
    f32: Option<f64>,
    f64: f64,
    underflow: Underflows,
    /// The scalars in which forward dynamics may be refused.
    refusal: Vec<String>,
    scales: Vec<Scales>,
}

#[derive(Clone, Debug, Deserialize)]
struct Underflows {
    f32: Underflow,
    f64: Underflow,
}

#[derive(Clone, Copy, Debug, Deserialize)]
struct Underflow {
    tau: f64,
    #[serde(rename = "M")]
    matrix: f64,
    qdd: f64,
}

#[derive(Clone, Debug, Deserialize)]
struct Scales {
    tau: Vec<f64>,
    qdd: Option<Vec<f64>>,
    #[serde(rename = "M")]
    matrix: Option<Vec<Vec<f64>>>,
}

/// The largest errors of a case as shares of their bounds; infinite where an answer is missing, or
/// is given although there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    pub rnea: f64,
    pub crba: f64,
    pub forward: f64,
    pub aba: f64,
}

impl Shares {
    const NONE: Self = Self { rnea: 0.0, crba: 0.0, forward: 0.0, aba: 0.0 };

    /// The largest share of all quantities.
    pub fn worst(&self) -> f64 {
        larger(larger(self.rnea, self.crba), larger(self.forward, self.aba))
    }
}

/// The larger one, or the one that is not a number.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

/// All cases, by the names of their files.
pub fn all() -> Vec<SuiteCase> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{folder:?}: {e}"));
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("readable").path()).collect();
    paths.sort();
    paths.iter().map(|path| read(path)).collect()
}

fn read(path: &Path) -> SuiteCase {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path:?}: {e}"))
}

impl SuiteCase {
    /// Errors of f32, if it has the numbers, and of f64.
    pub fn shares(&self) -> (Option<Shares>, Shares) {
        match self.robot.links.len() {
            6 => self.of::<6>(),
            7 => self.of::<7>(),
            8 => self.of::<8>(),
            11 => self.of::<11>(),
            16 => self.of::<16>(),
            32 => self.of::<32>(),
            64 => self.of::<64>(),
            n => panic!("case {}: add robots of {n} links to this match", self.case),
        }
    }

    fn of<const N: usize>(&self) -> (Option<Shares>, Shares) {
        let (model, bound) = (self.robot.model::<N>(), &self.bound);
        let allowed = |name: &str, relative, underflow| Allowed {
            relative,
            underflow,
            refusal: bound.refusal.iter().any(|scalar| scalar == name),
        };
        let single = bound.f32.map(|relative| {
            let allowed = allowed("f32", relative, bound.underflow.f32);
            self.measured(&model.to_f32(), &allowed)
        });
        let allowed = allowed("f64", bound.f64, bound.underflow.f64);
        (single, self.measured(&model, &allowed))
    }

    fn measured<R: Real, const N: usize>(
        &self,
        model: &ArmModel<R, N>,
        allowed: &Allowed,
    ) -> Shares {
        let rotors = std::array::from_fn(|i| R::from_f64(self.robot.links[i].armature));
        let [x, y, z] = self.robot.gravity.map(R::from_f64);
        let gravity = GravityVector(R::Vec3::new(x, y, z));
        let without_rotors = (gravity, Inertia, Coriolis);
        let scene = (gravity, Inertia, Coriolis, Armature(rotors));
        let mut worst = Shares::NONE;
        let states = std::iter::zip(&self.states, &self.answers);
        for ((given, truth), scales) in states.zip(&self.bound.scales) {
            let state = State { q: row(&given.q), qd: row(&given.qd), qdd: row(&given.qdd) };
            let (tau, underflow) = (row(&given.tau), allowed.underflow);
            let found = rnea(model, &state, &scene);
            let torques = allowed.share(&found, &truth.tau, &scales.tau, underflow.tau);
            worst.rnea = larger(worst.rnea, torques);
            if let (Some(rows), Some(scales)) = (&truth.matrix, &scales.matrix) {
                let matrix = crba(model, &state.q, &scene);
                for (i, (truth, scale)) in rows.iter().zip(scales).enumerate() {
                    let found: [R; N] = std::array::from_fn(|j| matrix.get(i, j));
                    let entries = allowed.share(&found, truth, scale, underflow.matrix);
                    worst.crba = larger(worst.crba, entries);
                }
            }
            let by_matrix = forward_dynamics(model, &state, &tau, &scene).ok();
            let by_bodies = aba(model, &state, &tau, &scene).ok();
            let known = truth.qdd.as_deref().zip(scales.qdd.as_deref());
            worst.forward = larger(worst.forward, allowed.of_accelerations(by_matrix, known));
            worst.aba = larger(worst.aba, allowed.of_accelerations(by_bodies, known));
            // Joints that turn without an inertia of their own have a shorter form.
            if rotors == [R::ZERO; N] {
                let by_bodies = aba(model, &state, &tau, &without_rotors).ok();
                worst.aba = larger(worst.aba, allowed.of_accelerations(by_bodies, known));
            }
        }
        worst
    }
}

/// The error that a scalar is allowed.
struct Allowed {
    relative: f64,
    underflow: Underflow,
    refusal: bool,
}

impl Allowed {
    /// The largest error over its bound.
    fn share<R: Real>(&self, found: &[R], truth: &[String], scale: &[f64], underflow: f64) -> f64 {
        let mut worst = 0.0;
        for ((found, truth), scale) in found.iter().zip(truth).zip(scale) {
            let error = (found.to_f64() - number(truth)).abs();
            worst = larger(worst, over(error, self.relative * scale + underflow));
        }
        worst
    }

    /// The error of accelerations, against those that are known and their scales. A refusal is
    /// right where there is no answer or the bound leaves it no digit.
    fn of_accelerations<R: Real, const N: usize>(
        &self,
        found: Option<[R; N]>,
        known: Option<(&[String], &[f64])>,
    ) -> f64 {
        let lost = |(truth, scale): (&String, &f64)| self.relative * scale > number(truth).abs();
        match (found, known) {
            (Some(found), Some((truth, scale))) => {
                self.share(&found, truth, scale, self.underflow.qdd)
            }
            (Some(_), None) => f64::INFINITY,
            (None, None) => 0.0,
            (None, Some(_)) if self.refusal => 0.0,
            (None, Some((truth, scale))) if truth.iter().zip(scale).any(lost) => 0.0,
            (None, Some(_)) => f64::INFINITY,
        }
    }
}

/// An error over its bound, where a bound of 0 stands for exactly 0.
fn over(error: f64, bound: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / bound }
}

fn row<R: Real, const N: usize>(values: &[f64]) -> [R; N] {
    std::array::from_fn(|i| R::from_f64(values[i]))
}

fn number(digits: &str) -> f64 {
    digits.parse().expect("the suite has numbers")
}

impl Robot {
    fn model<const N: usize>(&self) -> ArmModel<f64, N> {
        Model::try_new("suite", std::array::from_fn(|i| self.links[i].body()))
            .expect("the suite has robots")
    }
}

impl SuiteLink {
    fn body(&self) -> Body {
        let joint = match self.joint.as_str() {
            "prismatic" => Joint::prismatic(self.axis),
            _ => Joint::revolute(self.axis),
        };
        let parent = usize::try_from(self.parent).unwrap_or(BASE);
        let body = Body::new("link", parent, joint)
            .xyz(self.translation)
            .mass(self.mass)
            .com(self.com)
            .inertia(self.inertia);
        let [roll, pitch, yaw] = angles(&self.rotation);
        match self.rotation.as_flattened().iter().all(|x| x.abs() == x.trunc().abs()) {
            true => body.quarter_turns([roll, pitch, yaw].map(quarters)),
            false => body.rpy([roll, pitch, yaw]),
        }
    }
}

/// Roll, pitch and yaw of a rotation.
fn angles(m: &[[f64; 3]; 3]) -> [f64; 3] {
    let across = m[2][1].hypot(m[2][2]);
    let pitch = (-m[2][0]).atan2(across);
    match across > 1e-6 {
        true => [m[2][1].atan2(m[2][2]), pitch, m[1][0].atan2(m[0][0])],
        false => [0.0, pitch, (-m[0][1]).atan2(m[1][1])],
    }
}

fn quarters(angle: f64) -> i32 {
    (angle / std::f64::consts::FRAC_PI_2).round() as i32
}
