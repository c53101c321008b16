//! The bodies of a robot, as the program carries them, and their kinematics.
//!
//! Frames are those of the library's `Link`: the joint's axis is z.

use crate::error::{Error, Result};
use crate::image::Image;

/// The way in which a body moves relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moves {
    /// The body does not move relative to its parent.
    Fixed,
    /// By the angle of this joint, about z.
    Turns(usize),
    /// By the position of this joint, along z.
    Slides(usize),
}

/// A rigid body of a robot, with its placement, its joint and its inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The body that carries it, or none on the base.
    pub parent: Option<usize>,
    /// The motion that its joint allows.
    pub moves: Moves,
    /// From the parent's coordinates to its own at q = 0, by rows.
    pub rot: [[f64; 3]; 3],
    /// Its origin in the parent's frame at q = 0.
    pub pos: [f64; 3],
    /// Mass, first moment, and second moments xx, xy, xz, yy, yz, zz about the origin.
    pub inertia: [f64; 10],
}

/// Three coordinates of a vector.
pub type Vector = [f64; 3];

/// The numbers that kinematics needs of a joint's position: cosine and sine, and the position.
#[derive(Clone, Copy, Debug)]
pub struct Position {
    cosine: f64,
    sine: f64,
    q: f64,
}

impl Position {
    /// The position of a joint at the coordinate `q`.
    pub fn at(q: f64) -> Self {
        let (sine, cosine) = q.sin_cos();
        Self { cosine, sine, q }
    }
}

/// The bodies that a program carries, parents first.
///
/// # Errors
/// [`Error::Missing`], [`Error::Robot`] of a joint that neither turns nor slides.
pub fn read(image: &Image) -> Result<Vec<Body>> {
    let words = image.variable("CERTIFIED_BODIES")?.1;
    let numbers: Vec<f64> = words
        .chunks_exact(2)
        .map(|pair| f64::from_bits(u64::from(pair[1]) << 32 | u64::from(pair[0])))
        .collect();
    let body = |(number, x): (usize, &[f64])| {
        let joint = x[2] as usize;
        let moves = match x[1] {
            0.0 => Moves::Fixed,
            1.0 => Moves::Turns(joint),
            2.0 => Moves::Slides(joint),
            _ => {
                return Err(Error::Robot(format!(
                    "body {}: its joint neither turns nor slides",
                    number + 1
                )));
            }
        };
        Ok(Body {
            parent: (x[0] >= 0.0).then_some(x[0] as usize),
            moves,
            rot: std::array::from_fn(|i| std::array::from_fn(|j| x[3 + 3 * i + j])),
            pos: std::array::from_fn(|i| x[12 + i]),
            inertia: std::array::from_fn(|i| x[15 + i]),
        })
    };
    numbers.chunks_exact(25).enumerate().map(body).collect()
}

pub(crate) fn plus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    let at = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [at(1, 2), at(2, 0), at(0, 1)]
}

impl Body {
    /// From the parent's coordinates to its own at q = 0.
    pub(crate) fn placed(&self, x: Vector) -> Vector {
        self.rot.map(|row| x[0] * row[0] + x[1] * row[1] + x[2] * row[2])
    }

    /// From its own coordinates at q = 0 to those of the parent: the inverse of `placed`.
    pub(crate) fn unplaced(&self, x: Vector) -> Vector {
        let rot = &self.rot;
        std::array::from_fn(|i| x[0] * rot[0][i] + x[1] * rot[1][i] + x[2] * rot[2][i])
    }

    /// From its coordinates at q = 0 to its own.
    pub(crate) fn turned(&self, x: Vector, at: &[Position]) -> Vector {
        let Moves::Turns(joint) = self.moves else {
            return x;
        };
        let (c, s) = (at[joint].cosine, at[joint].sine);
        [x[0] * c + x[1] * s, x[1] * c - x[0] * s, x[2]]
    }

    /// From its own coordinates to those at q = 0: the inverse of `turned`.
    pub(crate) fn unturned(&self, x: Vector, at: &[Position]) -> Vector {
        let Moves::Turns(joint) = self.moves else {
            return x;
        };
        let (c, s) = (at[joint].cosine, at[joint].sine);
        [x[0] * c - x[1] * s, x[0] * s + x[1] * c, x[2]]
    }

    /// Its origin in the parent's frame.
    pub(crate) fn origin(&self, at: &[Position]) -> Vector {
        match self.moves {
            Moves::Slides(joint) => plus(self.pos, self.rot[2].map(|x| at[joint].q * x)),
            _ => self.pos,
        }
    }
}
