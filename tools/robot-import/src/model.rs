//! A tree as a model of the library that is built at run time, of any size.
//!
//! The library's models have their sizes in their types. A tree is therefore filled up to the next
//! of three sizes with massless bodies on joints of the base, which change no torque of the tree's
//! joints.

use dynamics_core::advice::Advice;
use dynamics_core::algorithms::{crba, poses, rnea};
use dynamics_core::effects::{Gravity, Inertia, RIGID_BODY};
use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, ModelError};
use dynamics_core::state::State;

use crate::description::{Kind, Pose, shortened};
use crate::error::{Problem, Result};
use crate::limits::MOST_COORDINATES;
use crate::loops::Closed;
use crate::number::Attitude;
use crate::rows::{Rows, rows};
use crate::tree::{self, Tree};

/// A state: q, q̇ and q̈.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The position coordinates.
    pub q: Vec<f64>,
    /// The velocity coordinates.
    pub qd: Vec<f64>,
    /// The acceleration coordinates.
    pub qdd: Vec<f64>,
}

/// A tree as a model.
#[derive(Debug)]
pub enum AnyModel {
    /// A model of up to 16 velocity coordinates.
    Small(Box<Sized<28, 32>>),
    /// A model of up to 64.
    Middle(Box<Sized<76, 80>>),
    /// A model of up to 136.
    Large(Box<Sized<MOST_BODIES, 168>>),
}

/// A model filled up to N bodies and velocity coordinates, and Q position coordinates.
#[derive(Debug)]
pub struct Sized<const N: usize, const Q: usize> {
    exact: Model<f64, N, Q, N>,
    rounded: Model<f32, N, Q, N>,
    /// The number of ball joints that fill it up.
    balls: usize,
}

impl AnyModel {
    /// The model of a tree.
    ///
    /// # Errors
    /// More coordinates than [`MOST_COORDINATES`], or numbers that the library refuses.
    pub fn of(tree: &Tree) -> Result<Self> {
        let v = tree.coordinates()[1].max(tree.bodies.len());
        Ok(match v {
            0..=16 => Self::Small(Sized::of(tree)?),
            17..=64 => Self::Middle(Sized::of(tree)?),
            65..=MOST_COORDINATES => Self::Large(Sized::of(tree)?),
            _ => {
                return Err(Problem::TooLarge {
                    what: "coordinates of a robot",
                    found: v,
                    most: MOST_COORDINATES,
                }
                .into());
            }
        })
    }

    /// The poses of its bodies in the base's frame at q, and of the fillers.
    pub fn poses(&self, q: &[f64]) -> Vec<Rows<f64>> {
        match self {
            Self::Small(model) => model.poses(q),
            Self::Middle(model) => model.poses(q),
            Self::Large(model) => model.poses(q),
        }
    }

    /// Why the library refuses a loop on the bodies, if it does.
    pub fn problem_of(&self, closed: &Closed) -> Option<String> {
        match self {
            Self::Small(model) => model.problem_of(closed),
            Self::Middle(model) => model.problem_of(closed),
            Self::Large(model) => model.problem_of(closed),
        }
    }

    /// The numbers that look like another unit, or ask more of the motors than they have.
    pub fn advice(&self) -> Vec<Advice> {
        match self {
            Self::Small(model) => model.exact.advice().collect(),
            Self::Middle(model) => model.exact.advice().collect(),
            Self::Large(model) => model.exact.advice().collect(),
        }
    }

    /// The torques that hold it at rest at q, N·m or N.
    pub fn gravity(&self, q: &[f64]) -> Vec<f64> {
        match self {
            Self::Small(model) => model.gravity(q),
            Self::Middle(model) => model.gravity(q),
            Self::Large(model) => model.gravity(q),
        }
    }

    /// Inverse dynamics at a state, N·m or N.
    pub fn torque(&self, motion: &Motion) -> Vec<f64> {
        match self {
            Self::Small(model) => model.torque(motion),
            Self::Middle(model) => model.torque(motion),
            Self::Large(model) => model.torque(motion),
        }
    }

    /// The torques, computed in f32.
    pub fn torque_f32(&self, motion: &Motion) -> Vec<f64> {
        match self {
            Self::Small(model) => model.torque_f32(motion),
            Self::Middle(model) => model.torque_f32(motion),
            Self::Large(model) => model.torque_f32(motion),
        }
    }

    /// M of its v velocity coordinates at q, row by row.
    pub fn inertia(&self, q: &[f64], v: usize) -> Vec<Vec<f64>> {
        match self {
            Self::Small(model) => model.inertia(q, v),
            Self::Middle(model) => model.inertia(q, v),
            Self::Large(model) => model.inertia(q, v),
        }
    }
}

/// The model of a tree of N joints of one coordinate each.
///
/// # Errors
/// Another number or other kinds of joints, or numbers that the library refuses.
pub fn arm<const N: usize>(tree: &Tree) -> Result<ArmModel<f64, N>> {
    if !tree.is_single() || tree.bodies.len() != N {
        return Err(Problem::Value(format!("not {N} joints of one coordinate each")).into());
    }
    let bodies = std::array::from_fn(|i| described(i, &tree.bodies[i]));
    Model::try_new("tree", bodies).map_err(|error: ModelError| refused(tree, error).into())
}

/// An error of the library with the body's name in place of its number.
fn refused(tree: &Tree, error: ModelError) -> Problem {
    let text = error.to_string();
    Problem::Value(match number_of(error.body).and_then(|i| tree.bodies.get(i)) {
        Some(body) => text.replacen(error.body, &shortened(&body.name), 1),
        None => text,
    })
}

/// The most bodies of a model.
const MOST_BODIES: usize = 160;

/// Three digits for each number of a body.
static DIGITS: [u8; 3 * MOST_BODIES] = {
    let (mut all, mut i) = ([b'0'; 3 * MOST_BODIES], 0);
    while i < MOST_BODIES {
        all[3 * i] += (i / 100) as u8;
        all[3 * i + 1] += (i / 10 % 10) as u8;
        all[3 * i + 2] += (i % 10) as u8;
        i += 1;
    }
    all
};

/// A body's number as its name: the library's names are known while compiling.
fn number(i: usize) -> &'static str {
    let digits = DIGITS.get(3 * i..3 * i + 3).unwrap_or_default();
    std::str::from_utf8(digits).unwrap_or_default()
}

/// The number of the body that has it as its name.
pub fn number_of(name: &str) -> Option<usize> {
    name.parse().ok()
}

impl<const N: usize, const Q: usize> Sized<N, Q> {
    fn of(tree: &Tree) -> Result<Box<Self>> {
        let [q, v] = tree.coordinates();
        // A ball joint has one position coordinate more than velocity coordinates.
        let balls = (Q - N).saturating_sub(q - v);
        let too_many = q - v > Q - N || v + 3 * balls > N;
        if too_many {
            return Err(Problem::TooLarge {
                what: "ball joints and free joints",
                found: q - v,
                most: Q - N,
            }
            .into());
        }
        let revolute = N - v - 3 * balls;
        let bodies = std::array::from_fn(|i| match tree.bodies.get(i) {
            Some(body) => described(i, body),
            None => {
                let joint = match i - tree.bodies.len() {
                    more if more < balls => Joint::spherical(),
                    more if more < balls + revolute => Joint::revolute([0.0, 0.0, 1.0]),
                    _ => Joint::fixed(),
                };
                Body::new("filler", BASE, joint)
            }
        });
        let exact = Model::try_new("tree", bodies).map_err(|error| refused(tree, error))?;
        let rounded = exact.to_f32();
        Ok(Box::new(Self { exact, rounded, balls }))
    }

    /// q with the unit quaternions (x, y, z, w) of the fillers.
    fn position(&self, q: &[f64]) -> [f64; Q] {
        let mut filled = filled::<Q>(q);
        let fillers = filled[q.len()..].chunks_mut(4).take(self.balls);
        fillers.for_each(|quaternion| quaternion[3] = 1.0);
        filled
    }

    fn poses(&self, q: &[f64]) -> Vec<Rows<f64>> {
        let poses = poses(&self.exact, &self.position(q));
        let rows = poses.map(|pose| rows(&Pose { position: pose.pos, rotation: pose.rot }));
        rows.to_vec()
    }

    fn problem_of(&self, closed: &Closed) -> Option<String> {
        let joint = match closed.kind {
            Kind::Fixed => Joint::fixed(),
            _ => Joint::spherical(),
        };
        let ends = closed.ends.map(|(body, xyz, attitude)| {
            let frame = BodyFrame::new(body.unwrap_or(BASE)).xyz(xyz);
            match attitude {
                Attitude::QuarterTurns(turns) => frame.quarter_turns(turns),
                Attitude::Rpy(rpy) => frame.rpy(rpy),
            }
        });
        let joint = [LoopJoint::new("loop", joint, ends)];
        // All coordinates are actuated here: their number is looked at elsewhere.
        let all = std::array::from_fn(|i| i);
        let refused = match closed.kind {
            Kind::Fixed => Loops::<1, 6, N>::try_new(&self.exact, joint, all).err(),
            _ => Loops::<1, 3, N>::try_new(&self.exact, joint, all).err(),
        };
        refused.map(|error| {
            let text = error.to_string();
            let problem = text.strip_prefix("loop `loop`: ").map(str::to_owned);
            problem.unwrap_or(text)
        })
    }

    fn gravity(&self, q: &[f64]) -> Vec<f64> {
        let torque = rnea(&self.exact, &State::at(self.position(q)), &Gravity::EARTH);
        torque[..q.len()].to_vec()
    }

    fn torque(&self, motion: &Motion) -> Vec<f64> {
        let state =
            State { q: self.position(&motion.q), qd: filled(&motion.qd), qdd: filled(&motion.qdd) };
        rnea(&self.exact, &state, &RIGID_BODY)[..motion.qd.len()].to_vec()
    }

    fn torque_f32(&self, motion: &Motion) -> Vec<f64> {
        let (qd, qdd) = (filled::<N>(&motion.qd), filled::<N>(&motion.qdd));
        let state = State {
            q: self.position(&motion.q).map(|x| x as f32),
            qd: qd.map(|x| x as f32),
            qdd: qdd.map(|x| x as f32),
        };
        let torque = rnea(&self.rounded, &state, &RIGID_BODY);
        let own = torque[..motion.qd.len()].iter();
        own.map(|&x| f64::from(x)).collect()
    }

    fn inertia(&self, q: &[f64], v: usize) -> Vec<Vec<f64>> {
        let m = crba(&self.exact, &self.position(q), &(Inertia,));
        let row = |i| (0..v).map(|j| m.get(i, j)).collect();
        (0..v).map(row).collect()
    }
}

/// Coordinates with zeros for the fillers.
fn filled<const N: usize>(values: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or_default())
}

/// A body as the library takes it, with the numbers that the written file has.
fn described(i: usize, body: &tree::Body) -> Body {
    let joint = match body.kind {
        Kind::Fixed => Joint::fixed(),
        Kind::Revolute => Joint::revolute(body.axis),
        Kind::Continuous => Joint::continuous(body.axis),
        Kind::Prismatic => Joint::prismatic(body.axis),
        Kind::Spherical => Joint::spherical(),
        Kind::Planar => Joint::planar(),
        Kind::Free => Joint::free(),
    };
    let placed = Body::new(number(i), body.parent.unwrap_or(BASE), joint).xyz(body.xyz);
    let placed = match body.attitude {
        Attitude::QuarterTurns(turns) => placed.quarter_turns(turns),
        Attitude::Rpy(rpy) => placed.rpy(rpy),
    };
    let [lower, upper] = body.limits.position.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    placed
        .mass(body.inertia.mass)
        .com(body.inertia.com)
        // The importer has words of its own on an inertia that is impossible.
        .inertia_as_published(body.inertia.inertia)
        .limits(JointLimits {
            lower,
            upper,
            velocity: body.limits.velocity.unwrap_or(f64::INFINITY),
            torque: body.limits.effort.unwrap_or(f64::INFINITY),
        })
}
