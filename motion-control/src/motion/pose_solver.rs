//! Positions of the joints for a pose of the tip: Levenberg-Marquardt from several starts.
//!
//! With the error e = (θ, d/ℓ) of the pose, each iteration moves the joints by Jᵀ x, where
//!
//! ```text
//! (Σ c_j c_jᵀ + λ² 1) x = e      λ² = |e|²/2 + ω
//! ```
//!
//! is the sum over the joints that are not at an end of their range, or whose Jᵀ x of the iteration
//! before leads away from it. The damping by the error itself, Sugihara, "Solvability-unconcerned
//! inverse kinematics by the Levenberg-Marquardt method" (2011), makes an iteration converge from
//! far and at singular postures without a search along its direction.
//!
//! Starts are points of the sequence of Roberts, "The unreasonable effectiveness of quasirandom
//! sequences" (2018): the fractions of n/φ, n/φ², … with φ^(V+1) = φ + 1, which fill the ranges of
//! V joints evenly after any number of starts.

use super::damped_motion::{damped_motion, dot, scaled};
use crate::law::pose_error;
use crate::limits::{ConfigError, ConfigParameter};
use dynamics_core::algorithms::frame::Pose;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Motion;
use dynamics_core::state::all_finite;

#[cfg(test)]
mod tests;

/// ω of the damping.
const LEAST: f64 = 1e-5;
/// Iterations for φ, from 1 on.
const NEWTON: u32 = 8;
/// The greatest step of a joint, rad or m.
const STEP: f64 = 1.0;

/// The joints and the tolerance of a [`PoseSolver`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSolverConfig<R, const V: usize> {
    /// The least position of each joint, rad or m.
    pub lower: [R; V],
    /// The greatest position of each joint, rad or m.
    pub upper: [R; V],
    /// ℓ, the length at which a displacement counts as much as a rotation, m: a third of the reach.
    pub length: R,
    /// The greatest error √(θ² + d²/ℓ²), rad: 10⁻⁵ suits f32, whose poses of an arm of 1 m have
    /// errors of 10⁻⁶ m.
    pub tolerance: R,
    /// Iterations from one start: 15 suits arms.
    pub iterations: u32,
    /// Starts: the first is that of the caller.
    pub starts: u32,
}

impl<R: Real, const V: usize> PoseSolverConfig<R, V> {
    /// Checks every number.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names a number that is beyond its range; ranges of joints are
    /// finite.
    pub fn check(&self) -> Result<(), ConfigError> {
        ConfigParameter::TipLength.positive(self.length)?;
        ConfigParameter::PoseTolerance.positive(self.tolerance)?;
        ConfigParameter::PoseTolerance.require((self.iterations > 0) & (self.starts > 0))?;
        let ranges = (0..V).all(|j| self.lower[j] <= self.upper[j]);
        let finite = all_finite(&self.lower) & all_finite(&self.upper);
        ConfigParameter::JointRange.require(ranges & finite)
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
    /// The pose, or what the kinematics return, is not finite.
    NotFinite,
    /// No start has led to the pose within its iterations: it is out of reach, or singular.
    NotReached(
        /// The nearest positions that were found.
        PoseSolution<R, V>,
    ),
}

impl<R: Real, const V: usize> core::fmt::Display for PoseSolverError<R, V> {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(match self {
            Self::NotFinite => "the pose or the kinematics are not finite",
            Self::NotReached(_) => "no start has led to the pose",
        })
    }
}

impl<R: Real, const V: usize> core::error::Error for PoseSolverError<R, V> {}

/// A solver of inverse kinematics: the same code on host and chip.
///
/// [`Self::solve`] takes at most `starts` × (`iterations` + 1) calls of the kinematics.
/// [`Self::step`] is one of them, for a chip that has time for one in each tick.
///
/// ```
/// use motion_control::{PoseSolver, PoseSolverConfig};
/// use dynamics_core::{Engine, algorithms::frame::LocalWorldAligned, robots::Ur5e};
/// use dynamics_core::model::{OnBody, Robot};
/// const TIP: OnBody<{ Ur5e::MODEL.body("wrist_3") }> = OnBody;
/// let tip = |q: &[f64; 6]| {
///     let trig = Engine::<Ur5e>::joint_trig(q);
///     let [pose] = Engine::<Ur5e>::poses_of(&trig, TIP);
///     (pose, Engine::<Ur5e>::jacobian(&trig, TIP, LocalWorldAligned))
/// };
/// let (goal, _) = tip(&[0.4, -1.0, 1.2, 0.2, 0.8, 0.5]);
/// let mut solver = PoseSolver::try_new(PoseSolverConfig {
///     lower: [-3.2; 6], upper: [3.2; 6], length: 0.3, tolerance: 1e-9, iterations: 15, starts: 10,
/// })?;
/// let found = solver.solve(&goal, &[0.0, -1.2, 1.5, 0.3, 0.7, 0.0], tip)?;
/// assert!((tip(&found.q).0.pos - goal.pos).length() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "inverse kinematics")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSolver<R: Real, const V: usize> {
    config: PoseSolverConfig<R, V>,
    /// 1/φ, 1/φ², …
    steps: [R; V],
    goal: Pose<R>,
    q: [R; V],
    /// Which joints are not held at an end of their range.
    free: [bool; V],
    /// The nearest positions so far, and the square of their error.
    best: PoseSolution<R, V>,
    square: R,
    start: u32,
    /// Iterations from this start.
    since: u32,
}

impl<R: Real, const V: usize> PoseSolver<R, V> {
    /// A solver that has no goal yet: that of [`Pose::IDENTITY`] from the middle of the ranges.
    ///
    /// # Errors
    /// [`PoseSolverConfig::check`] has the ranges.
    pub fn try_new(config: PoseSolverConfig<R, V>) -> Result<Self, ConfigError> {
        config.check()?;
        let mut phi = R::ONE;
        for _ in 0..NEWTON {
            let power = (0..V).fold(R::ONE, |power, _| power * phi);
            let slope = crate::real::<R>(V as u32 + 1) * power - R::ONE;
            phi = phi - (power * phi - phi - R::ONE) / slope;
        }
        let mut step = R::ONE;
        let steps = [(); V].map(|()| {
            step = step / phi;
            step
        });
        let (q, error) = ([R::ZERO; V], Motion::ZERO);
        let best = PoseSolution { q, error, iterations: 0 };
        let (goal, square, free) = (Pose::IDENTITY, R::ZERO, [true; V]);
        let mut solver = Self { config, steps, goal, q, free, best, square, start: 0, since: 0 };
        solver.begin(&Pose::IDENTITY, &solver.seed(0));
        Ok(solver)
    }

    /// Start n: positions within the ranges, in the middle for n = 0.
    #[must_use]
    pub fn seed(&self, n: u32) -> [R; V] {
        let PoseSolverConfig { lower, upper, .. } = &self.config;
        core::array::from_fn(|j| {
            let turns = R::from_f64(0.5) + crate::real::<R>(n) * self.steps[j];
            lower[j] + (turns - turns.trunc_saturating()) * (upper[j] - lower[j])
        })
    }

    /// Begins to look for a goal in the base's frame from `start`, of which what is beyond a range
    /// is moved to its end.
    pub fn begin(&mut self, goal: &Pose<R>, start: &[R; V]) {
        (self.goal, self.start, self.best.iterations) = (*goal, 0, 0);
        self.restart(start);
    }

    fn restart(&mut self, q: &[R; V]) {
        let PoseSolverConfig { lower, upper, .. } = &self.config;
        self.q = core::array::from_fn(|j| q[j].clamped(lower[j], upper[j]));
        (self.free, self.since) = ([true; V], 0);
    }

    /// The positions at which [`Self::step`] needs the pose and the Jacobian.
    #[inline(always)]
    pub fn q(&self) -> &[R; V] {
        &self.q
    }

    /// One iteration, from the tip's pose and its Jacobian in the base's axes
    /// ([`LocalWorldAligned`](dynamics_core::algorithms::frame::LocalWorldAligned)) at [`Self::q`];
    /// `None` before it is done.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository, the kinematics included; the same for all data.
    ///
    /// # Errors
    /// [`PoseSolverError`].
    #[inline]
    pub fn step(
        &mut self,
        pose: &Pose<R>,
        jacobian: &[Motion<R>; V],
    ) -> Option<Result<PoseSolution<R, V>, PoseSolverError<R, V>>> {
        let config = &self.config;
        let (error, per_length) = (pose_error(pose, &self.goal), R::ONE / config.length);
        let e = scaled(error, per_length);
        let square = dot(&e, &e);
        let first = self.best.iterations == 0;
        self.best.iterations = self.best.iterations.saturating_add(1);
        if first | (square < self.square) {
            (self.best.q, self.best.error, self.square) = (self.q, error, square);
        }
        if square <= config.tolerance * config.tolerance {
            return Some(Ok(self.best));
        }
        let columns = jacobian.map(|column| scaled(column, per_length));
        let damping = R::from_f64(0.5) * square + R::from_f64(LEAST);
        let x = damped_motion::<R, V, 1>(&columns, &self.free, damping, &e);
        if !(all_finite(&x) & square.is_finite()) {
            return Some(Err(PoseSolverError::NotFinite));
        }
        if self.since == config.iterations {
            self.start += 1;
            if self.start == config.starts {
                return Some(Err(PoseSolverError::NotReached(self.best)));
            }
            self.restart(&self.seed(self.start));
            return None;
        }
        self.since += 1;
        for (j, column) in columns.iter().enumerate() {
            let step = dot(column, &x).clamped(-R::from_f64(STEP), R::from_f64(STEP));
            let wanted = self.q[j] + step;
            let q = wanted.clamped(config.lower[j], config.upper[j]);
            // A joint that leaves an end does so in the next iteration: its step is none.
            if self.free[j] {
                self.q[j] = q;
            }
            self.free[j] = q == wanted;
        }
        None
    }

    /// Positions within the ranges at which the tip has the pose `goal`, from `start` and then from
    /// other starts. `kinematics` returns pose and Jacobian as [`Self::step`] takes them.
    ///
    /// # Errors
    /// [`PoseSolverError`].
    pub fn solve(
        &mut self,
        goal: &Pose<R>,
        start: &[R; V],
        mut kinematics: impl FnMut(&[R; V]) -> (Pose<R>, [Motion<R>; V]),
    ) -> Result<PoseSolution<R, V>, PoseSolverError<R, V>> {
        self.begin(goal, start);
        loop {
            let (pose, jacobian) = kinematics(&self.q);
            if let Some(end) = self.step(&pose, &jacobian) {
                return end;
            }
        }
    }
}
