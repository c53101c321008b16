//! The torque that one link's inertia needs, as a polynomial in speeds and accelerations whose
//! coefficients depend on the positions.
//!
//! Everything is in the link's own frame, where its mass m, first moment h and second moments I are
//! constants. With ω_a and v_a, what the velocity of joint a adds to the angular velocity and to
//! that of the origin,
//!
//!   α = Σ ω_a q̈_a + Σ_{a<b} ω_a × ω_b q̇_a q̇_b, a = g + Σ v_a q̈_a + Σ_{a,b} ω_{min} × v_{max}
//!   q̇_a q̇_b, f = m a + α × h + ω × (ω × h), n = I α + ω × I ω + h × a, τ_i = v_i · f + ω_i · n.

use crate::bodies::{Body, Moves, Position, Vector, constant, cross, plus};
use crate::error::{Error, Result};
use crate::peel::welded;
use crate::taylor::Scalar;

/// The acceleration of gravity of the certified functions, m/s².
const EARTH: f64 = 9.81;

/// The link's frame against the joints before it and against gravity.
#[derive(Clone, Debug, Default)]
struct Frame<S> {
    turning: Vec<Vector<S>>,
    moving: Vec<Vector<S>>,
    up: Vector<S>,
}

impl<S: Scalar> Frame<S> {
    /// Of the base, which gravity accelerates upwards.
    pub fn base(gravity: S) -> Self {
        Self {
            turning: Vec::new(),
            moving: Vec::new(),
            up: [S::default(), S::default(), gravity],
        }
    }

    /// Becomes that of a body on the body of another frame, where its joint is at a position.
    pub fn set(&mut self, body: &Body, before: &Self, at: Position<S>) {
        // The body knows its joint by number.
        let local = Body {
            moves: match body.moves {
                Moves::Turns(_) => Moves::Turns(0),
                Moves::Slides(_) => Moves::Slides(0),
                Moves::Fixed => Moves::Fixed,
            },
            ..*body
        };
        let at = [at];
        let origin = local.origin(&at);
        let into = |x: Vector<S>| local.turned(local.placed(x), &at);
        self.turning.clear();
        self.moving.clear();
        for (turning, moving) in before.turning.iter().zip(&before.moving) {
            self.moving
                .push(into(plus(*moving, cross(*turning, origin))));
            self.turning.push(into(*turning));
        }
        self.up = into(before.up);
        let (none, axis) = ([S::default(); 3], constant([0.0, 0.0, 1.0]));
        let (turning, moving) = match body.moves {
            Moves::Turns(_) => (axis, none),
            Moves::Slides(_) => (none, axis),
            Moves::Fixed => return,
        };
        self.turning.push(turning);
        self.moving.push(moving);
    }

    /// The coefficients of the torque of each joint before the link: of one; then, for each joint
    /// a, of q̈_a and of q̇_b q̇_a for b up to a.
    pub fn coefficients(&self, inertia: &[f64; 10], to: &mut Vec<S>) {
        let [mass, x, y, z, xx, xy, xz, yy, yz, zz] = *inertia;
        let first: Vector<S> = constant([x, y, z]);
        let second = |w: Vector<S>| -> Vector<S> {
            [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
                .map(|row| w[0].times(row[0]) + w[1].times(row[1]) + w[2].times(row[2]))
        };
        let n = self.turning.len();
        let length = terms(n);
        to.clear();
        to.resize(n * length, S::default());
        let mut term = 0;
        let mut put = |force: Vector<S>, moment: Vector<S>| {
            let along = self.moving.iter().zip(&self.turning).enumerate();
            for (i, (moving, turning)) in along {
                to[i * length + term] = dot(*moving, force) + dot(*turning, moment);
            }
            term += 1;
        };
        let heavy = |a: Vector<S>| a.map(|a| a.times(mass));
        put(heavy(self.up), cross(first, self.up));
        for a in 0..n {
            let (turning, moving) = (self.turning[a], self.moving[a]);
            let (swung, spun) = (cross(turning, first), second(turning));
            put(plus(heavy(moving), swung), plus(spun, cross(first, moving)));
            for b in 0..a {
                let before = self.turning[b];
                let linear = cross(before, moving).map(|x| x.times(2.0));
                let angular = cross(before, turning);
                let both = plus(cross(before, swung), cross(turning, cross(before, first)));
                let gyroscopic = plus(cross(before, spun), cross(turning, second(before)));
                put(
                    plus(plus(heavy(linear), cross(angular, first)), both),
                    plus(plus(second(angular), gyroscopic), cross(first, linear)),
                );
            }
            let linear = cross(turning, moving);
            put(
                plus(heavy(linear), cross(turning, swung)),
                plus(cross(turning, spun), cross(first, linear)),
            );
        }
    }
}

/// The number of coefficients for so many joints.
const fn terms(joints: usize) -> usize {
    1 + joints + joints * (joints + 1) / 2
}

/// What each term is at most, or is at a state: of one, of accelerations and of products of speeds.
fn monomials(speeds: &[f64], accelerations: &[f64]) -> Vec<f64> {
    let mut all = vec![1.0];
    for (a, acceleration) in accelerations.iter().enumerate() {
        all.push(*acceleration);
        all.extend(speeds[..=a].iter().map(|speed| speed * speeds[a]));
    }
    all
}

fn dot<S: Scalar>(a: Vector<S>, b: Vector<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A robot's links, each with what is welded on it.
#[derive(Clone, Debug)]
pub struct Links {
    bodies: Vec<Body>,
    /// The links from the base to each.
    paths: Vec<Vec<usize>>,
    joints: Vec<usize>,
}

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
                    "joint {}: two bodies move by it, which is not taken",
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
