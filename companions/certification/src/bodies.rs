//! The bodies of a robot, as the program carries them, and their kinematics in numbers or in
//! [`Taylor`] models of them.
//!
//! Frames are those of the library's `Link`: the joint's axis is z. The inertia matrix is that of
//! composite bodies, RBDA (2008), table 6.2.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::image::Image;
use crate::interval::Interval;
use crate::taylor::{SLOPES, Scalar, Taylor};

/// The way in which a body moves relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Moves {
    /// The body does not move relative to its parent.
    Fixed,
    /// By the angle of this joint, about z.
    Turns(usize),
    /// By the position of this joint, along z.
    Slides(usize),
}

/// A rigid body of a robot, with its placement, its joint and its inertia.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
pub type Vector<S> = [S; 3];

/// The numbers that kinematics needs of a joint's position: cosine and sine, those of twice the
/// angle, and the position.
#[derive(Clone, Copy, Debug, Default)]
pub struct Position<S> {
    cosine: S,
    sine: S,
    cosine_of_two: S,
    sine_of_two: S,
    q: S,
}

impl Position<f64> {
    /// The position of a joint at the coordinate `q`.
    pub fn at(q: f64) -> Self {
        let ((s, c), (s2, c2)) = (q.sin_cos(), (2.0 * q).sin_cos());
        Self { cosine: c, sine: s, cosine_of_two: c2, sine_of_two: s2, q }
    }
}

impl Position<Taylor> {
    /// The position of the given joint over a range of its coordinate.
    pub fn over(joint: usize, range: Interval) -> Self {
        let slope = (joint < SLOPES).then_some(joint);
        let [cosine, sine] = Taylor::cosine_and_sine(range, 1.0, slope);
        let [cosine_of_two, sine_of_two] = Taylor::cosine_and_sine(range, 2.0, slope);
        Self { cosine, sine, cosine_of_two, sine_of_two, q: Taylor::coordinate(range, slope) }
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

pub(crate) fn plus<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    std::array::from_fn(|i| a[i] + b[i])
}

pub(crate) fn cross<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    let at = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [at(1, 2), at(2, 0), at(0, 1)]
}

pub(crate) fn constant<S: Scalar>(x: [f64; 3]) -> Vector<S> {
    x.map(S::of)
}

impl Body {
    /// The number of its joint.
    pub fn joint(&self) -> Option<usize> {
        match self.moves {
            Moves::Fixed => None,
            Moves::Turns(joint) | Moves::Slides(joint) => Some(joint),
        }
    }

    /// From the parent's coordinates to its own at q = 0.
    pub(crate) fn placed<S: Scalar>(&self, x: Vector<S>) -> Vector<S> {
        self.rot.map(|row| x[0].times(row[0]) + x[1].times(row[1]) + x[2].times(row[2]))
    }

    /// From its own coordinates at q = 0 to those of the parent: the inverse of `placed`.
    pub(crate) fn unplaced<S: Scalar>(&self, x: Vector<S>) -> Vector<S> {
        std::array::from_fn(|i| {
            x[0].times(self.rot[0][i]) + x[1].times(self.rot[1][i]) + x[2].times(self.rot[2][i])
        })
    }

    /// From its coordinates at q = 0 to its own.
    pub(crate) fn turned<S: Scalar>(&self, x: Vector<S>, at: &[Position<S>]) -> Vector<S> {
        let Moves::Turns(joint) = self.moves else {
            return x;
        };
        let (c, s) = (at[joint].cosine, at[joint].sine);
        [x[0] * c + x[1] * s, x[1] * c - x[0] * s, x[2]]
    }

    /// From its own coordinates to those at q = 0: the inverse of `turned`.
    pub(crate) fn unturned<S: Scalar>(&self, x: Vector<S>, at: &[Position<S>]) -> Vector<S> {
        let Moves::Turns(joint) = self.moves else {
            return x;
        };
        let (c, s) = (at[joint].cosine, at[joint].sine);
        [x[0] * c - x[1] * s, x[0] * s + x[1] * c, x[2]]
    }

    /// Its origin in the parent's frame.
    pub(crate) fn origin<S: Scalar>(&self, at: &[Position<S>]) -> Vector<S> {
        let pos = constant(self.pos);
        match self.moves {
            Moves::Slides(joint) => plus(pos, self.rot[2].map(|x| at[joint].q.times(x))),
            _ => pos,
        }
    }
}

/// Mass, first moment, and second moments of bodies that move as one.
#[derive(Clone, Copy)]
struct Inertia<S> {
    mass: f64,
    first: Vector<S>,
    second: [S; 6],
}

impl<S: Scalar> Inertia<S> {
    fn of(body: &Body) -> Self {
        Self {
            mass: body.inertia[0],
            first: std::array::from_fn(|i| S::of(body.inertia[1 + i])),
            second: std::array::from_fn(|i| S::of(body.inertia[4 + i])),
        }
    }

    fn row(&self, i: usize) -> Vector<S> {
        ROWS[i].map(|place| self.second[place])
    }

    /// The same in the parent's frame about the parent's origin.
    fn before(&self, body: &Body, at: &[Position<S>]) -> Self {
        let turned = self.unturned(body, at);
        let first = body.unplaced(turned.first);
        let columns = [0, 1, 2].map(|i| body.unplaced(turned.row(i)));
        // Rᵀ (I R), whose inner product has the columns as its rows.
        let rows = [0, 1, 2].map(|j| {
            let column = [0, 1, 2].map(|i| columns[i][j]);
            body.unplaced(column)
        });
        let r = body.origin(at);
        let moved: Vector<S> = std::array::from_fn(|i| first[i] + r[i].times(self.mass));
        // I − r× h× − (h + m r)× r×, whose entry i, j is δ (r·h + (h + m r)·r) − h_i r_j − r_i (h +
        // m r)_j.
        let dot = |a: &Vector<S>, b: &Vector<S>| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let trace = dot(&r, &first) + dot(&r, &moved);
        let second = PLACES.map(|(i, j)| {
            let entry = rows[i][j] - first[i] * r[j] - r[i] * moved[j];
            if i == j { entry + trace } else { entry }
        });
        Self { mass: self.mass, first: moved, second }
    }

    /// In coordinates at q = 0: by twice the angle, so that cos² and sin² stay one together.
    fn unturned(&self, body: &Body, at: &[Position<S>]) -> Self {
        let Moves::Turns(joint) = body.moves else {
            return *self;
        };
        let (c2, s2) = (at[joint].cosine_of_two, at[joint].sine_of_two);
        let [xx, xy, xz, yy, yz, zz] = self.second;
        let (mean, half) = ((xx + yy).times(0.5), (xx - yy).times(0.5));
        let swing = half * c2 - xy * s2;
        let [xz, yz, _] = body.unturned([xz, yz, zz], at);
        Self {
            mass: self.mass,
            first: body.unturned(self.first, at),
            second: [mean + swing, half * s2 + xy * c2, xz, mean - swing, yz, zz],
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first: plus(self.first, other.first),
            second: std::array::from_fn(|i| self.second[i] + other.second[i]),
        }
    }
}

/// The inertia of a body that stands still on its parent, in the parent's frame.
pub(crate) fn at_parent(body: &Body) -> [f64; 10] {
    let Inertia { mass, first, second } = Inertia::of(body).before(body, &[]);
    let [a, b, c, d, e, f] = second;
    let [x, y, z] = first;
    [mass, x, y, z, a, b, c, d, e, f]
}

/// The entries of a symmetric matrix in its six numbers, and its three rows as indices of these.
const PLACES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
const ROWS: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// The inertia matrix: its lower triangle, by rows.
pub fn inertia_matrix<S: Scalar>(
    bodies: &[Body],
    joints: usize,
    at: &[Position<S>],
) -> Vec<Vec<S>> {
    let mut matrix: Vec<Vec<S>> = (0..joints).map(|i| vec![S::default(); i + 1]).collect();
    let mut composite: Vec<Inertia<S>> = bodies.iter().map(Inertia::of).collect();
    for i in (0..bodies.len()).rev() {
        let inertia = composite[i];
        let one = S::of(1.0);
        let (mut moment, mut force) = match bodies[i].moves {
            // z × h, and the column of z.
            Moves::Turns(_) => {
                (inertia.row(2), [-inertia.first[1], inertia.first[0], S::default()])
            }
            Moves::Slides(_) => (
                [inertia.first[1], -inertia.first[0], S::default()],
                [S::default(), S::default(), one.times(inertia.mass)],
            ),
            Moves::Fixed => Default::default(),
        };
        if let Some(own) = bodies[i].joint() {
            let mut k = i;
            loop {
                let entry = match bodies[k].moves {
                    Moves::Turns(joint) => Some((joint, moment[2])),
                    Moves::Slides(joint) => Some((joint, force[2])),
                    Moves::Fixed => None,
                };
                if let Some((joint, entry)) = entry {
                    matrix[own.max(joint)][own.min(joint)] = entry;
                }
                let Some(parent) = bodies[k].parent else {
                    break;
                };
                force = bodies[k].unplaced(bodies[k].unturned(force, at));
                let turned = bodies[k].unplaced(bodies[k].unturned(moment, at));
                moment = plus(turned, cross(bodies[k].origin(at), force));
                k = parent;
            }
        }
        if let Some(parent) = bodies[i].parent {
            composite[parent] = composite[parent].plus(&inertia.before(&bodies[i], at));
        }
    }
    matrix
}
