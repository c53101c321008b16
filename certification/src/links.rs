//! The torque that one link's inertia needs, as a polynomial in speeds and accelerations whose
//! coefficients depend on the positions.
//!
//! Everything is in the link's own frame, where its mass m, first moment h and second moments I are
//! constants. With ω_a and v_a, what the velocity of joint a adds to the angular velocity and to
//! that of the origin,
//!
//!   α = Σ ω_a q̈_a + Σ_{a<b} ω_a × ω_b q̇_a q̇_b, a = g + Σ v_a q̈_a + Σ_{a,b} ω_{min} × v_{max}
//!   q̇_a q̇_b, f = m a + α × h + ω × (ω × h), n = I α + ω × I ω + h × a, τ_i = v_i · f + ω_i · n.

use std::ops::{Add, Mul, Neg, Sub};

use crate::bodies::{Body, Moves, Position, Vector, constant, cross, plus};
use crate::taylor::Scalar;

/// The acceleration of gravity of the certified functions, m/s².
pub(crate) const EARTH: f64 = 9.81;

/// The link's frame against the joints before it and against gravity.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame<S> {
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

    /// The acceleration of the base that stands for gravity.
    pub fn up(&self) -> Vector<S> {
        self.up
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
pub(crate) const fn terms(joints: usize) -> usize {
    1 + joints + joints * (joints + 1) / 2
}

/// What each term is at most, or is at a state: of one, of accelerations and of products of speeds.
pub(crate) fn monomials(speeds: &[f64], accelerations: &[f64]) -> Vec<f64> {
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

/// The most that a number of a computation can be, over all positions, and the most by which f64
/// computes it wrong.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size {
    pub most: f64,
    pub error: f64,
}

/// More than half a unit in the last place, and than what a subnormal result loses.
const ROUNDING: f64 = f64::EPSILON;
const LOST: f64 = f64::MIN_POSITIVE;
/// More than the relative error of the literals: of rotations against the next that are
/// orthonormal, and of inertias that were added up.
const LITERAL: f64 = 1e-14;

impl Size {
    pub fn new(most: f64, error: f64) -> Self {
        Self { most, error }
    }
}

impl Add for Size {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let most = self.most + b.most;
        Self::new(most, self.error + b.error + ROUNDING * most)
    }
}

impl Sub for Size {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "magnitudes add up")]
    fn sub(self, b: Self) -> Self {
        self + b
    }
}

impl Neg for Size {
    type Output = Self;
    fn neg(self) -> Self {
        self
    }
}

impl Mul for Size {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let carried = self.error * b.most + b.error * self.most + self.error * b.error;
        let most = self.most * b.most;
        Self::new(most, carried + ROUNDING * most + LOST)
    }
}

impl Scalar for Size {
    fn of(x: f64) -> Self {
        Self::new(x.abs(), LITERAL * x.abs())
    }
    /// The literal may be of a rotation, whose entries are at most one and off by as much where
    /// they are zero.
    fn times(self, factor: f64) -> Self {
        self * Self::new(factor.abs(), LITERAL * factor.abs().max(1.0))
    }
}
