//! The greatest speeds of a robot's links over all positions and speeds of its joints.
//!
//! A link's velocity is linear in the joints' speeds, so that its length is greatest where each
//! joint moves at its greatest speed, one way or the other. For each of these corners the positions
//! are split where the bound is largest, until it is hardly above a speed that a position has.

use std::collections::BinaryHeap;

use serde::{Deserialize, Serialize};

use crate::bodies::{Body, Moves, Position, Vector, constant, cross, plus};
use crate::interval::Interval;
use crate::parts::{Part, WIDE, somewhere, wide};
use crate::taylor::{SLOPES, Scalar, Taylor};

/// A speed: what is proven, and the greatest that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Speed {
    /// It is nowhere above this.
    pub bound: f64,
    /// The greatest that was found.
    pub found: f64,
}

/// The speeds of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Speeds {
    /// Of the body, from 1.
    pub body: usize,
    /// Angular velocity, rad/s.
    pub turning: Speed,
    /// Of the origin of its frame, which is on its joint, m/s.
    pub joint: Speed,
    /// Of its centre of mass, m/s; that of the origin if it has no mass.
    pub mass: Speed,
}

/// A bound so little above what was found is not lowered.
const CLOSE: f64 = 1.002;

/// The speed of a body that is bounded: its turning, or that of its joint or its centre of mass.
#[derive(Clone, Copy)]
enum Of {
    Turning,
    Joint,
    Mass,
}

/// The speeds of each body, with at most so many parts for each of them. `most` are the joints'
/// greatest speeds.
pub fn prove(bodies: &[Body], positions: &[Interval], most: &[f64], parts: usize) -> Vec<Speeds> {
    let of = |body: usize, what: Of| {
        let path = Path::to(bodies, body, what);
        path.prove(positions, most, parts)
    };
    let mut all: Vec<Speeds> = Vec::new();
    for (number, body) in bodies.iter().enumerate() {
        let mut own = Speeds {
            body: number + 1,
            turning: of(number, Of::Turning),
            joint: of(number, Of::Joint),
            mass: of(number, Of::Mass),
        };
        // What a body adds to its parent's speeds at most.
        let parent = body.parent.and_then(|parent| all.get(parent));
        let before = |of: fn(&Speeds) -> f64| parent.map_or(0.0, of);
        let (turning, moving) = (
            before(|one| one.turning.bound),
            before(|one| one.joint.bound),
        );
        let (turns, slides, reach) = match body.moves {
            Moves::Fixed => (0.0, 0.0, 0.0),
            Moves::Turns(joint) => (most[joint], 0.0, 0.0),
            Moves::Slides(joint) => (0.0, most[joint], positions[joint].magnitude()),
        };
        let origin = moving + turning * (length(body.pos) + reach) + slides;
        own.turning.lower(turning + turns);
        own.joint.lower(origin);
        own.mass
            .lower(own.joint.bound + own.turning.bound * length(body.centre()));
        all.push(own);
    }
    all
}

fn length(x: [f64; 3]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Speed {
    /// Takes another bound if it is lower; its few roundings are made up for.
    fn lower(&mut self, other: f64) {
        self.bound = self.bound.min(other * (1.0 + 1e-12));
    }
}

/// The bodies from the base to one of them.
struct Path<'a> {
    bodies: Vec<&'a Body>,
    what: Of,
}

impl<'a> Path<'a> {
    fn to(bodies: &'a [Body], body: usize, what: Of) -> Self {
        let mut path = Vec::new();
        let mut next = Some(body);
        while let Some(k) = next {
            path.push(&bodies[k]);
            next = bodies[k].parent;
        }
        path.reverse();
        Self { bodies: path, what }
    }

    /// The velocity, in coordinates that stand still against the last body's parent.
    fn velocity<S: Scalar>(&self, at: &[Position<S>], speeds: &[f64]) -> Vector<S> {
        let zero = [S::default(); 3];
        let (mut turning, mut moving) = (zero, zero);
        for (number, body) in self.bodies.iter().enumerate() {
            moving = body.placed(plus(moving, cross(turning, body.origin(at))));
            turning = body.placed(turning);
            match body.moves {
                Moves::Turns(joint) => turning[2] = turning[2] + S::of(speeds[joint]),
                Moves::Slides(joint) => moving[2] = moving[2] + S::of(speeds[joint]),
                Moves::Fixed => {}
            }
            if number + 1 < self.bodies.len() {
                (turning, moving) = (body.turned(turning, at), body.turned(moving, at));
            }
        }
        let Some(last) = self.bodies.last() else {
            return zero;
        };
        match self.what {
            Of::Turning => turning,
            Of::Joint => moving,
            Of::Mass => {
                let arm = last.unturned(constant(last.centre()), at);
                plus(moving, cross(turning, arm))
            }
        }
    }

    /// The joints on the way, and their speeds at a corner, the first one's positive.
    fn corner(&self, most: &[f64], signs: usize) -> Vec<f64> {
        let mut speeds = vec![0.0; most.len()];
        let joints = self.bodies.iter().filter_map(|body| body.joint());
        for (number, joint) in joints.enumerate() {
            let is_back = number > 0 && signs >> (number - 1) & 1 != 0;
            speeds[joint] = if is_back { -most[joint] } else { most[joint] };
        }
        speeds
    }

    fn prove(&self, positions: &[Interval], most: &[f64], parts: usize) -> Speed {
        let joints = self.bodies.iter().filter(|body| body.joint().is_some());
        let corners = 1_usize << joints.count().saturating_sub(1).min(24);
        let mut found = 0.0_f64;
        let mut open = BinaryHeap::new();
        let small = over(&somewhere(positions));
        let slopes = self.velocity(&small, &self.corner(most, 0));
        let depends = |k: &usize| slopes.iter().any(|x| x.slopes[*k] != 0.0);
        let axes: Vec<usize> = (0..SLOPES.min(positions.len())).filter(depends).collect();
        for corner in 0..corners {
            let whole = positions.to_vec();
            open.push(self.part(whole, corner, most, &axes, &mut found));
        }
        let mut left = parts;
        while let Some(part) = open.pop() {
            let is_done = left == 0 || part.bound <= CLOSE * found;
            let Some(halves) = part.halves().filter(|_| !is_done) else {
                return Speed {
                    bound: part.bound,
                    found,
                };
            };
            left -= 1;
            for half in halves {
                open.push(self.part(half, part.corner, most, &axes, &mut found));
            }
        }
        Speed::default()
    }

    fn part(
        &self,
        positions: Vec<Interval>,
        corner: usize,
        most: &[f64],
        axes: &[usize],
        found: &mut f64,
    ) -> Part {
        let speeds = self.corner(most, corner);
        let middle: Vec<Position<f64>> = positions
            .iter()
            .map(|x| Position::at(0.5 * (x.low + x.high)))
            .collect();
        let here = self.velocity(&middle, &speeds);
        *found = found.max(here.iter().map(|x| x * x).sum::<f64>().sqrt());
        let velocity = self.velocity(&over(&positions), &speeds);
        let square = velocity
            .map(Taylor::square)
            .into_iter()
            .fold(Taylor::default(), |sum, x| sum + x);
        // Each of them holds; the sum of squares keeps what the coordinates exchange.
        let apart: f64 = velocity.iter().map(|x| x.magnitude().powi(2)).sum();
        let bound = square.range().high.max(0.0).min(apart).sqrt() * (1.0 + 1e-12);
        let gain = |k: usize| velocity.iter().map(|x| x.slopes[k].abs()).sum::<f64>();
        let slope = axes
            .iter()
            .copied()
            .max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
        Part {
            bound,
            corner,
            axis: wide(axes, &positions, WIDE).or(slope),
            positions,
        }
    }
}

fn over(positions: &[Interval]) -> Vec<Position<Taylor>> {
    let of = |(joint, range): (usize, &Interval)| Position::over(joint, *range);
    positions.iter().enumerate().map(of).collect()
}
