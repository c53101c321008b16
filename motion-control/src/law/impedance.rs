//! Cartesian impedance control with null space: a spring and a damper between a body and its goal.
//!
//! Albu-Schäffer, Ott, Frese & Hirzinger, "Cartesian impedance control of redundant robots: recent
//! results with the DLR-light-weight-arms" (2003); Khatib (1987) for the null space. The inertia Λ
//! is not shaped, so that no force need be measured. The damping is that of double diagonalisation:
//! Λ = Q Qᵀ, K = Q Ω² Qᵀ, D = 2 ζ Q Ω Qᵀ. With S = √K Λ⁻¹ √K = U Ω² Uᵀ, Q is √K U Ω⁻¹, and D needs
//! no inverse of Λ⁻¹, which is singular where the arm is:
//!
//! ```text
//! D = 2 ζ √K U Ω⁻¹ Uᵀ √K,   Λ = √K U Ω⁻² Uᵀ √K
//! ```
//!
//! For a mode slower than ω_min, 1/Ω is continued by its tangent, as a function of Ω², and at most
//! 1.5/ω_min. The null space has the same modes: of a slow one Ω² (1/Ω)² goes to zero with Ω,
//! without a jump in value or slope, and the posture moves the body where the spring cannot.
//!
//! The modes follow the arm from tick to tick (`impedance/modes.rs`). Whatever they are, U is
//! orthogonal and 1/Ω positive: the damping is positive, and the arm passive, also where they are
//! not yet those of the posture.

mod modes;
#[cfg(test)]
mod tests;

use crate::entry;
use crate::limits::{ConfigError, ConfigParameter, Fault};
use dynamics_core::algorithms::{Conditioning, eigen};
use dynamics_core::scalar::{Real, positive_part};
use dynamics_core::state::all_finite;
use modes::{Modes, combine, dot};

/// The spring and the damping ratio of a Cartesian impedance: for [`CartesianImpedance::try_new`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ImpedanceConfig<R, const M: usize> {
    /// Stiffness K along each direction of the task, N/m, or N·m/rad if the direction is a couple
    /// of 1 N·m.
    pub stiffness: [R; M],
    /// Damping ratio ζ of every mode.
    pub zeta: R,
    /// ω_min, rad/s: modes down to this natural frequency have the damping ratio ζ; slower ones,
    /// near a singularity, have less, since no damping exceeds 3 ζ K/ω_min.
    pub slowest: R,
}

/// A spring and a damper between a body and its goal, along M directions of a task; it keeps the
/// modes of the last tick.
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{Pose, frame, task_jacobian};
/// use motion_control::law::{
///     CartesianImpedance, ImpedanceConfig, TaskDeviation, TaskFrame, pose_error,
/// };
/// use dynamics_core::effects::{Gravity, RIGID_BODY};
/// use dynamics_core::{Core, robots::Panda, state::State};
/// let stiffness = [30.0_f32, 30.0, 30.0, 600.0, 600.0, 600.0]; // N·m/rad about the axes, N/m along them
/// let mut impedance = CartesianImpedance::try_new(ImpedanceConfig { stiffness, zeta: 0.7, slowest: 2.0 })?;
///
/// let arm = State { qd: [0.1; 7], ..State::at([0.3, -0.4, 0.2, -2.0, 0.3, 1.9, 0.5]) };
/// let hand = Core::<Panda>::kinematics(&arm, &());
/// let mut goal: Pose<f32> = hand.poses[6];
/// goal.pos.z += 0.05;
/// let directions = TaskFrame::BASE.turn_and_place(1.0);
/// let rows = task_jacobian(&Core::<Panda>::jacobian(&arm.q, 6, frame::LocalWorldAligned), &directions);
/// let factors = Core::<Panda>::ltdl(&Core::<Panda>::crba(&arm.q, &RIGID_BODY))?;
/// let solve = |tau: &_| Core::<Panda>::solve(&factors, tau);
///
/// let (off, v) = (pose_error(&hand.poses[6], &goal), hand.velocity(6, frame::LocalWorldAligned));
/// let deviation = TaskDeviation { position: directions.map(|d| off.dot(d)), velocity: directions.map(|d| -v.dot(d)) };
/// let gravity = Core::<Panda>::rnea(&arm, &Gravity::EARTH);
/// let posture = arm.qd.map(|qd| -2.0 * qd); // K_n (q_n − q) − D_n q̇: here the elbow is only damped
/// let command = impedance.torque(&rows, solve, &deviation, &gravity, &posture)?;
/// assert!(command.tau.iter().all(|tau| tau.is_finite()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "impedance control")]
#[doc(alias = "compliance control")]
#[doc(alias = "double diagonalization")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CartesianImpedance<R, const M: usize> {
    config: ImpedanceConfig<R, M>,
    /// √K.
    roots: [R; M],
    modes: Modes<R, M>,
}

/// The distance of a body from its goal, along the directions of a task.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TaskDeviation<R, const M: usize> {
    /// x̃ = x_d − x, m or rad: the components of [`pose_error`](crate::law::pose_error()).
    pub position: [R; M],
    /// ẋ_d − ẋ, m/s or rad/s.
    pub velocity: [R; M],
}

/// The torques of a Cartesian impedance, and whether its damping is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ImpedanceTorque<R, const V: usize> {
    /// τ, N·m or N: finite.
    pub tau: [R; V],
    /// Regular if all modes are faster than ω_min; else the square of the slowest one's frequency
    /// over ω_min².
    pub conditioning: Conditioning<R>,
    /// The way in which the modes were found.
    pub modes: ModeSearch,
}

/// The way in which the modes of a tick were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ModeSearch {
    /// By one pass, from those of the last tick.
    Followed,
    /// By more passes, at most eight: at the start, after a jump of the posture, after numbers that
    /// were not finite.
    Searched {
        /// Their number.
        passes: usize,
    },
    /// Eight passes left some of them coupled: the damping is positive, but its ratio is not ζ to
    /// the last digits.
    Coupled,
}

impl<R: Real, const M: usize> ImpedanceConfig<R, M> {
    /// Whether this is a spring with a damper.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names a number that is not finite and positive.
    ///
    /// ```
    /// use motion_control::law::ImpedanceConfig;
    /// use motion_control::limits::{ConfigError, ConfigParameter};
    /// let config = ImpedanceConfig { stiffness: [600.0_f32, 0.0], zeta: 0.7, slowest: 2.0 };
    /// let error = ConfigError::OutOfRange { parameter: ConfigParameter::Stiffness };
    /// assert_eq!(config.check(), Err(error));
    /// ```
    pub fn check(&self) -> Result<(), ConfigError> {
        for k in self.stiffness {
            ConfigParameter::Stiffness.positive(k)?;
        }
        ConfigParameter::DampingRatio.positive(self.zeta)?;
        ConfigParameter::SlowestMode.positive(self.slowest)
    }
}

impl<R: Real, const M: usize> CartesianImpedance<R, M> {
    /// The law of this spring and damping ratio.
    ///
    /// # Errors
    /// [`ConfigError`], as [`ImpedanceConfig::check`].
    pub fn try_new(config: ImpedanceConfig<R, M>) -> Result<Self, ConfigError> {
        config.check()?;
        let roots = config.stiffness.map(R::sqrt);
        let modes = Modes::start();
        Ok(Self { config, roots, modes })
    }

    /// The damping D by double diagonalisation, N·s/m or N·m·s/rad, and whether all modes have the
    /// damping ratio ζ.
    ///
    /// It is that of [`CartesianImpedance::torque`], from eigenvectors that are computed anew,
    /// without memory. If no mode is slower than ω_min, D Λ⁻¹ D = 4 ζ² K. `mobility` is Λ⁻¹ of the
    /// task, which may be singular.
    ///
    /// # Shape
    /// M × M, symmetric.
    ///
    /// # Cost
    /// 3 M (M − 1) (18 M + 50) + 3 M³ flops, with 3 M (M − 1) divisions, in f64 a sixth more: the
    /// same for all data.
    ///
    /// # Errors
    /// None; from numbers that are not finite it is not finite and not regular.
    ///
    /// # Source
    /// Albu-Schäffer, Ott, Frese & Hirzinger (2003).
    ///
    /// ```
    /// use dynamics_core::algorithms::Conditioning;
    /// use motion_control::law::{CartesianImpedance, ImpedanceConfig};
    /// let config = ImpedanceConfig { stiffness: [400.0_f64], zeta: 1.0, slowest: 2.0 };
    /// let ([[d]], how) = CartesianImpedance::try_new(config)?.damping(&[[0.25]]); // 4 kg
    /// assert!((d - 2.0 * (400.0_f64 * 4.0).sqrt()).abs() < 1e-12 && how == Conditioning::Regular);
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn damping(&self, mobility: &[[R; M]; M]) -> ([[R; M]; M], Conditioning<R>) {
        let threshold = self.config.slowest * self.config.slowest;
        let mut s = *mobility;
        for (row, root) in s.iter_mut().zip(self.roots) {
            for (entry, other) in row.iter_mut().zip(self.roots) {
                *entry *= root * other;
            }
        }
        let (squares, vectors) = eigen(s);
        let (mut d, mut smallest) = ([[R::ZERO; M]; M], threshold);
        for (square, vector) in squares.into_iter().zip(vectors) {
            // Rounding may make a zero negative.
            let square = if square > R::ZERO { square } else { R::ZERO };
            smallest = if square < smallest { square } else { smallest };
            let weight = (self.config.zeta + self.config.zeta)
                * period(square, inverse_root(square, threshold));
            for (i, row) in d.iter_mut().enumerate() {
                let of = |k| entry(&self.roots, k) * entry(&vector, k);
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry += weight * (of(i) * of(j));
                }
            }
        }
        if smallest >= threshold && all_finite(&squares) {
            return (d, Conditioning::Regular);
        }
        let smallest = smallest / threshold;
        (d, Conditioning::Damped { smallest })
    }

    /// The torque of each motor, N·m or N, that makes the body behave as a mass on a spring with a
    /// damper.
    ///
    /// ```text
    /// τ = τ_b + Jᵀ (K x̃ + D x̃̇) + (1 − Jᵀ J̄ᵀ) τ_n
    /// ```
    ///
    /// `rows` is J along the directions of the task, by
    /// [`task_jacobian`](dynamics_core::algorithms::task_jacobian()) or
    /// [`jacobian_rows`](dynamics_core::algorithms::jacobian_rows()); `solve` solves M x = τ with
    /// the factors of core or engine.
    ///
    /// A constant force F on the body displaces it by K⁻¹ F. `bias` is τ_b: gravity and friction,
    /// with which the arm is passive at a goal at rest, the posture apart, if rotational
    /// stiffnesses are equal; for a goal that moves,
    /// [`rnea_two_velocities`](dynamics_core::algorithms::rnea_two_velocities()) of the joint
    /// velocities that follow it. `posture` is τ_n = K_n (q_n − q) − D_n q̇, for example by
    /// [`feedback`](crate::law::feedback()); it does not act on the task where all modes are faster
    /// than ω_min. Some damping in it is needed near singularities also for arms without
    /// redundancy: there the task damps not all joints.
    ///
    /// Every number is finite in singular postures too, and nothing jumps there: the spring and the
    /// damper are bounded, and Jᵀ goes to zero along the lost direction. Velocities are damped by
    /// at most 3 ζ K/ω_min.
    ///
    /// # Cost
    /// A pass and 6 M (M + V) flops; a pass is M solutions and M (M − 1) (5 M + 14) + 3 M (M + 1) V
    /// flops: the same for all data, singular postures among them. One pass is the rule for an arm
    /// that moves; in f32 some ticks take two if every joint turns by 3 mrad in a tick.
    /// [`ImpedanceTorque::modes`] names those with more, eight at most. The first call takes some
    /// four: make it before the loop runs. A pass leaves a relative error of the damping of 10⁻⁵ at
    /// most; in f64, of 10⁻¹² at most, two passes are the rule.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint whose torque is not finite, by numbers that are
    /// not finite or beyond the scalar's range. The next tick searches its modes anew.
    ///
    /// # Source
    /// Albu-Schäffer, Ott, Frese & Hirzinger (2003); Khatib (1987), (53).
    #[inline]
    pub fn torque<const V: usize>(
        &mut self,
        rows: &[[R; V]; M],
        solve: impl Fn(&[R; V]) -> [R; V],
        deviation: &TaskDeviation<R, M>,
        bias: &[R; V],
        posture: &[R; V],
    ) -> Result<ImpedanceTorque<R, V>, Fault> {
        let slowest = self.config.slowest * self.config.slowest;
        let (mut scaled, mut rates) = (*rows, deviation.velocity);
        for ((row, rate), &root) in scaled.iter_mut().zip(&mut rates).zip(&self.roots) {
            *rate *= root;
            for entry in row {
                *entry *= root;
            }
        }
        let found = self.modes.follow(&scaled, &solve, posture, slowest);
        let (twice, mut smallest) = (self.config.zeta + self.config.zeta, slowest);
        let mut along = [R::ZERO; M];
        for (k, along) in along.iter_mut().enumerate() {
            let square = positive_part(found.squares[k]); // rounding may make a zero negative
            smallest = if square < smallest { square } else { smallest };
            let period = period(square, found.inverses[k]);
            let rate = dot(&self.modes.vectors[k], &rates);
            *along = period * (twice * rate - period * found.response[k]);
        }
        let mut force = combine(&self.modes.vectors, &along);
        for (i, force) in force.iter_mut().enumerate() {
            *force = *force * self.roots[i] + self.config.stiffness[i] * deviation.position[i];
        }
        let mut tau = combine(rows, &force);
        for ((tau, &bias), &free) in tau.iter_mut().zip(bias).zip(posture) {
            *tau += bias + free;
        }
        if let Some(joint) = tau.iter().position(|tau| !tau.is_finite()) {
            self.modes.restart();
            return Err(Fault::NotFinite { joint });
        }
        let conditioning = if smallest >= slowest {
            Conditioning::Regular
        } else {
            Conditioning::Damped { smallest: smallest / slowest }
        };
        Ok(ImpedanceTorque { tau, conditioning, modes: found.search() })
    }
}

/// 1/Ω, at most 1/ω_min.
#[cfg_attr(optimised, inline(always))]
fn inverse_root<R: Real>(square: R, slowest: R) -> R {
    (if square > slowest { square } else { slowest }).rsqrt()
}

/// 1/Ω by the one that is at most 1/ω_min; below ω_min the tangent to it as a function of Ω², a
/// Newton step towards it.
#[cfg_attr(optimised, inline(always))]
fn period<R: Real>(square: R, r: R) -> R {
    let half = R::from_f64(0.5);
    r * (R::ONE + half - half * square * r * r)
}
