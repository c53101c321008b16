//! The box of states over which a bound holds, and the interval that each input has in it.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::graph::Input;
use crate::image::Image;
use crate::interval::Interval;

/// The kind of a coordinate of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    /// A position q, rad or m.
    Position,
    /// A velocity q̇, rad/s or m/s.
    Velocity,
    /// An acceleration q̈, rad/s² or m/s².
    Acceleration,
}

/// An input as a function of the box's coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaf {
    /// sin q of a joint
    Sine(usize),
    /// cos q of a joint
    Cosine(usize),
    /// The coordinate of this number.
    Axis(usize),
}

/// The ranges of a joint's position, speed and acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Whether its position is an angle.
    pub turns: bool,
    /// The range of q, rad or m.
    pub position: Interval,
    /// The greatest |q̇|, rad/s or m/s
    pub speed: f64,
    /// The greatest |q̈|, rad/s² or m/s²
    pub acceleration: f64,
}

/// The ranges of a robot's joints, and where a function's inputs lie.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Its joints, in the order of q̇.
    pub joints: Vec<Joint>,
    /// Bytes between coordinates, and to sine, cosine and position in each.
    pub trig: [u32; 4],
}

impl Robot {
    /// The joints that a program carries, with this greatest acceleration; a speed and a range
    /// replace those of joints without.
    ///
    /// # Errors
    /// [`Error::Missing`], and [`Error::Unbounded`] of a joint.
    pub fn read(
        image: &Image,
        acceleration: f64,
        speed: Option<f64>,
        range: Option<f64>,
    ) -> Result<Self> {
        let (_, words) = image.variable("CERTIFIED_JOINTS")?;
        let rows = words.as_chunks::<4>().0.iter().enumerate();
        let joints = rows.map(|(i, row)| {
            let [turns, lower, upper, rated] = row.map(|bits| f64::from(f32::from_bits(bits)));
            let finite = |what: &'static str, value: f64, given: Option<f64>| {
                let value = if value.is_finite() { Some(value) } else { given };
                value.ok_or(Error::Unbounded { joint: i + 1, what })
            };
            // An angle without limits is within a turn.
            let range = range.or((turns != 0.0).then_some(2.0 * PI));
            Ok(Joint {
                turns: turns != 0.0,
                position: Interval::new(
                    finite("least position", lower, range.map(|x| -x))?,
                    finite("greatest position", upper, range)?,
                ),
                speed: finite("rated speed", rated, speed)?,
                acceleration,
            })
        });
        let trig = image.variable("CERTIFIED_TRIG")?.1;
        let trig = trig.try_into().map_err(|_| Error::Missing("CERTIFIED_TRIG".into()))?;
        Ok(Self { joints: joints.collect::<Result<_>>()?, trig })
    }

    /// The whole box: q, then q̇, then q̈ of each joint. One turn of an angle stands for all.
    pub fn whole(&self) -> Vec<Interval> {
        let q = self.joints.iter().map(|joint| {
            let is_turn = joint.turns && joint.position.high - joint.position.low >= 2.0 * PI;
            if is_turn { Interval::new(-PI, PI).widened(1e-15) } else { joint.position }
        });
        let symmetric = |x: f64| Interval::new(-x, x);
        let qd = self.joints.iter().map(|joint| symmetric(joint.speed));
        let qdd = self.joints.iter().map(|joint| symmetric(joint.acceleration));
        q.chain(qd).chain(qdd).collect()
    }

    /// The coordinate, sine or cosine that an input is.
    pub fn leaf(&self, input: Input) -> Option<Leaf> {
        let n = self.joints.len();
        let [stride, sine, cosine, position] = self.trig;
        match input.argument {
            1 => {
                let (joint, within) = ((input.offset / stride) as usize, input.offset % stride);
                let leaf = match within {
                    at if at == sine => Leaf::Sine(joint),
                    at if at == cosine => Leaf::Cosine(joint),
                    at if at == position => Leaf::Axis(joint),
                    _ => return None,
                };
                (joint < n).then_some(leaf)
            }
            2 => {
                let axis = input.offset as usize / 4;
                (axis < 3 * n).then_some(Leaf::Axis(axis))
            }
            _ => None,
        }
    }
}

/// More than the error of the sines of this host's libm within some turns.
const LIBM: f64 = 1e-15;

/// sin x over an interval.
pub fn sine(x: Interval) -> Interval {
    extremes(x, f64::sin, PI / 2.0)
}

/// cos x over an interval.
pub fn cosine(x: Interval) -> Interval {
    extremes(x, f64::cos, 0.0)
}

/// The range of a sine whose greatest value lies at an angle, and at each turn from there.
fn extremes(x: Interval, f: fn(f64) -> f64, top: f64) -> Interval {
    let (a, b) = (f(x.low), f(x.high));
    // An extreme that is just outside counts as inside.
    let holds = |at: f64| {
        let turns = ((x.low - at) / (2.0 * PI) - 1e-9).ceil();
        at + 2.0 * PI * turns <= x.high + 1e-8
    };
    let high = if holds(top) { 1.0 } else { (a.max(b) + LIBM).min(1.0) };
    let low = if holds(top + PI) { -1.0 } else { (a.min(b) - LIBM).max(-1.0) };
    Interval::new(low, high)
}

/// A sector of angles, and the points of the circle at its ends.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sector {
    /// Cosine and sine at the least and the greatest angle.
    ends: [(f64, f64); 2],
    /// Whether it is at least half a turn.
    is_wide: bool,
}

impl Sector {
    /// The sector of these angles.
    pub fn new(angles: Interval) -> Self {
        let at = |angle: f64| (angle.cos(), angle.sin());
        Self { ends: [at(angles.low), at(angles.high)], is_wide: angles.high - angles.low > 3.1 }
    }

    /// a cos θ + b sin θ for every θ of the sector: linear in a and b, so that its extremes are at
    /// their ends.
    #[inline]
    pub fn rotated(&self, a: Interval, b: Interval) -> Interval {
        let corners = [(a.low, b.low), (a.low, b.high), (a.high, b.low), (a.high, b.high)];
        let most = |sign: f64| {
            corners
                .map(|(a, b)| self.most(sign * a, sign * b))
                .into_iter()
                .fold(f64::NEG_INFINITY, f64::max)
        };
        // Far more than the errors of these few operations, and of the host's sines.
        Interval::new(-most(-1.0), most(1.0)).widened(4.0 * LIBM * (a.magnitude() + b.magnitude()))
    }

    /// The most of a cos θ + b sin θ: the length of (a, b) if its direction may be in the sector,
    /// else at an end.
    #[inline]
    fn most(&self, a: f64, b: f64) -> f64 {
        let [(c1, s1), (c2, s2)] = self.ends;
        let slack = 1e-14 * (a.abs() + b.abs());
        let rises_first = b * c1 - a * s1 > -slack;
        let falls_last = b * c2 - a * s2 < slack;
        if self.is_wide || rises_first && falls_last {
            return (a * a + b * b).sqrt();
        }
        (a * c1 + b * s1).max(a * c2 + b * s2)
    }
}
