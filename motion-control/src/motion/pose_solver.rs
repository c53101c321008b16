//! Positions of the joints for a pose of the tip: Levenberg-Marquardt from several starts.
//!
//! With the error e = (θ, d/ℓ) of the pose, each iteration moves the joints by Jᵀ x, where
//!
//! ```text
//! (Σ c_j c_jᵀ + λ² 1) x = e      λ² = |e|²/10 + ω
//! ```
//!
//! is the sum over the joints that are not at an end of their range, or whose Jᵀ x of the iteration
//! before leads away from it. The damping by the error itself, Sugihara, "Solvability-unconcerned
//! inverse kinematics by the Levenberg-Marquardt method" (2011), makes an iteration converge from
//! far and at singular postures without a search along its direction. A start is given up after
//! three iterations that leave more than 7/10 of |e|².
//!
//! Start n has the fractions n g, n g m, n g m², … of the ranges, a sequence of Korobov (1959) with
//! the golden ratio g and the multiplier m of a congruential generator, in integers.

use super::damped_motion::{Damping, damped_motion, square};
use crate::law::pose_error;
use dynamics_core::algorithms::frame::Pose;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Motion;

#[cfg(test)]
mod tests;

/// The share of |e|² in λ², and ω; the share of |e|² that a good iteration leaves at most; the
/// greatest step of a joint, rad or m; more than |e|² of any pose in reach.
const NUMBERS: [f64; 5] = [0.1, 1e-5, 0.7, 1.0, 1e9];
/// The bad iterations that end a start.
const STALLS: u32 = 3;
/// One half, 1/φ and the multiplier of the starts, in units of 2⁻³², of which 24 bits are read.
const HALF: u32 = 0x8000_0000;
const GOLDEN: u32 = 0x9e37_79b9;
const KOROBOV: u32 = 1_664_525;
const BITS: f64 = 16_777_216.0;

/// A solver of inverse kinematics: the same code on host and chip.
///
/// ```
/// use motion_control::motion::{PoseSolver, PoseSolverError};
/// use dynamics_core::{Engine, algorithms::frame::LocalWorldAligned, robots::Ur5e};
/// use dynamics_core::model::{OnBody, Robot};
/// const TIP: OnBody<{ Ur5e::MODEL.body("wrist_3") }> = OnBody;
/// let tip = |q: &[f64; 6]| {
///     let trig = Engine::<Ur5e>::joint_trig(q);
///     let [pose] = Engine::<Ur5e>::poses_of(&trig, TIP);
///     (pose, Engine::<Ur5e>::jacobian(&trig, TIP, LocalWorldAligned))
/// };
/// let solver = PoseSolver {
///     lower: [-3.2; 6], upper: [3.2; 6], length: 0.3, tolerance: 1e-9, iterations: 130,
/// };
/// let (mut goal, _) = tip(&[0.4, -1.0, 1.2, 0.2, 0.8, 0.5]);
/// let found = solver.solve(&goal, &[0.0, -1.2, 1.5, 0.3, 0.7, 0.0], tip)?;
/// assert!((tip(&found.q).0.pos - goal.pos).length() < 1e-9);
///
/// // The nearest pose to one that is out of reach:
/// goal.pos.x = 2.0;
/// let Err(PoseSolverError::NotReached(nearest)) = solver.solve(&goal, &found.q, tip) else { panic!() };
/// assert!(nearest.error.lin.length() > 1.0);
/// # Ok::<(), PoseSolverError<f64, 6>>(())
/// ```
#[doc(alias = "inverse kinematics")]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSolver<R, const V: usize> {
    /// The least position of each joint, rad or m; −∞ for none.
    pub lower: [R; V],
    /// The greatest position of each joint, rad or m; ∞ for none.
    pub upper: [R; V],
    /// ℓ, the length at which a displacement counts as much as a rotation, m: a third of the reach.
    pub length: R,
    /// The greatest |e|, rad: 10⁻⁵ suits f32, whose poses of an arm of 1 m have errors of 10⁻⁶ m.
    pub tolerance: R,
    /// The most iterations, of all starts together: from one start that leads to the pose it takes
    /// some nine, and of random poses of a Panda 99.6 % are reached within 130.
    pub iterations: u32,
}

impl<R: Real, const V: usize> PoseSolver<R, V> {
    /// Positions within the ranges at which the tip has the pose `goal`, from `start` and then from
    /// [`Self::seed`]s of 1, 2, … `kinematics` returns the tip's pose, and its Jacobian in the
    /// base's axes ([`LocalWorldAligned`](dynamics_core::algorithms::frame::LocalWorldAligned)).
    ///
    /// Further solutions are found from other starts, with some 20 iterations for each: a UR5e has
    /// up to eight. A chip that has time for some iterations in a tick goes on from the nearest
    /// positions, or from another start, in the next.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository has an iteration with its kinematics.
    ///
    /// # Errors
    /// [`PoseSolverError`].
    pub fn solve(
        &self,
        goal: &Pose<R>,
        start: &[R; V],
        mut kinematics: impl FnMut(&[R; V]) -> (Pose<R>, [Motion<R>; V]),
    ) -> Result<PoseSolution<R, V>, PoseSolverError<R, V>> {
        let positive = |x: R| (x > R::ZERO) & x.is_finite();
        let mut ranges = self.lower.iter().zip(&self.upper);
        let usable =
            positive(self.length) & (positive(self.tolerance) | (self.tolerance == R::ZERO));
        if !(usable & ranges.all(|(lower, upper)| lower <= upper)) {
            return Err(PoseSolverError::Solver);
        }
        let [share, omega, stall, most, far] = NUMBERS.map(R::from_f64);
        let (per_length, tolerance) = (R::ONE / self.length, self.tolerance * self.tolerance);
        let (mut q, mut free, mut starts) = (self.within(start), [true; V], 0);
        let (mut last, mut least, mut stalls) = (far, far, 0);
        let mut best = PoseSolution { q, error: Motion::ZERO, iterations: 0 };
        loop {
            let (pose, jacobian) = kinematics(&q);
            let error = pose_error(&pose, goal);
            let now = square(error, per_length);
            let damping = Damping { square: share * now + omega, length: self.length };
            let x = damped_motion(&jacobian, &free, damping, &error);
            let steps = jacobian.map(|column| column.dot(x).clamped(-most, most));
            if !(now + x.ang.dot(x.ang) + x.lin.dot(x.lin)).is_finite() {
                return Err(PoseSolverError::NotFinite);
            }
            best.iterations += 1;
            if now < least {
                (best.q, best.error, least) = (q, error, now);
            }
            if now <= tolerance {
                return Ok(best);
            }
            if best.iterations >= self.iterations {
                return Err(PoseSolverError::NotReached(best));
            }
            stalls += u32::from(now > stall * last);
            last = now;
            if stalls == STALLS {
                starts += 1;
                (q, free, last, stalls) = (self.seed(starts), [true; V], far, 0);
                continue;
            }
            for j in 0..V {
                let wanted = q[j] + steps[j];
                let limited = wanted.clamped(self.lower[j], self.upper[j]);
                // A joint that leaves an end does so in the next iteration.
                q[j] = if free[j] { limited } else { q[j] };
                free[j] = limited == wanted;
            }
        }
    }

    /// Start n: positions within the ranges and half a turn of zero, in the middle for n = 0.
    #[must_use]
    pub fn seed(&self, n: u32) -> [R; V] {
        let (half_a_turn, unit) = (R::from_f64(core::f64::consts::PI), R::from_f64(1.0 / BITS));
        let mut x = HALF.wrapping_add(n.wrapping_mul(GOLDEN));
        self.within(&core::array::from_fn(|j| {
            let [lower, upper] =
                [self.lower[j], self.upper[j]].map(|end| end.clamped(-half_a_turn, half_a_turn));
            let share = crate::real::<R>(x >> 8) * unit;
            x = x.wrapping_mul(KOROBOV);
            lower + share * (upper - lower)
        }))
    }

    fn within(&self, q: &[R; V]) -> [R; V] {
        core::array::from_fn(|j| q[j].clamped(self.lower[j], self.upper[j]))
    }
}

/// The positions that a [`PoseSolver`] has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSolution<R: Real, const V: usize> {
    /// The positions of the joints, rad or m, within their ranges.
    pub q: [R; V],
    /// The error of the pose that is left, rad and m.
    pub error: Motion<R>,
    /// The iterations that it took, of all starts.
    pub iterations: u32,
}

/// The reason why a [`PoseSolver`] has no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PoseSolverError<R: Real, const V: usize> {
    /// A range of the solver is empty, its length is not positive or its tolerance negative, or one
    /// of them is not a number.
    Solver,
    /// A number of the goal, the start or the kinematics is not finite.
    NotFinite,
    /// No start has led to the pose within the iterations: it is out of reach, or nearly so. These
    /// positions are the nearest that were found.
    NotReached(PoseSolution<R, V>),
}

impl<R: Real, const V: usize> core::fmt::Display for PoseSolverError<R, V> {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(match self {
            Self::Solver => "a range, the length or the tolerance of the solver is none",
            Self::NotFinite => "a pose or a position is not finite",
            Self::NotReached(_) => "no start has led to the pose",
        })
    }
}

impl<R: Real, const V: usize> core::error::Error for PoseSolverError<R, V> {}
