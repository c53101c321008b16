//! A tree as a model of the library that is built at run time, of any size.
//!
//! The library's models have their sizes in their types. A tree is therefore filled up to the next
//! of three sizes with massless bodies on joints of the base, which change no torque of the tree's
//! joints.

#[cfg(feature = "program")]
mod compute;

use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, ModelError};

use crate::description::{Kind, shortened};
use crate::error::{Problem, Result};
use crate::limits::MOST_COORDINATES;
use crate::number::Attitude;
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
#[cfg_attr(not(feature = "program"), allow(dead_code, reason = "the program computes with them"))]
pub struct Sized<const N: usize, const Q: usize> {
    pub(crate) exact: Model<f64, N, Q, N>,
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
