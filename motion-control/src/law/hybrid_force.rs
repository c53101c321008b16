//! Hybrid motion and force control in the operational space.
//!
//! Khatib (1987), section VI: F = Λ (Ω ẍ* + Ω̄ a − J̇ q̇) + Ω̄ f*, τ = Jᵀ F + C q̇ + g. The
//! selection Ω is the choice of an [`TaskCommand`] for each direction of the task.

use dynamics_core::algorithms::OperationalSpace;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::Force;

#[cfg(test)]
mod tests;

/// The axes of a task, fixed in the base; their origin is the body's.
#[doc(alias = "task frame")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaskFrame<R: Real> {
    /// Its columns are the axes in base coordinates, of unit length and at right angles.
    pub axes: R::Mat3,
}

impl<R: Real> TaskFrame<R> {
    /// The base's axes.
    pub const BASE: Self = Self { axes: R::Mat3::IDENTITY };

    /// The directions of a task in three coordinates: the position of the body's origin along the
    /// axes, m.
    ///
    /// For [`dynamics_core::algorithms::task_jacobian`] of a Jacobian in the frame
    /// `LocalWorldAligned`.
    #[inline(always)]
    pub fn place(&self) -> [Force<R>; 3] {
        self.axes.cols().map(|axis| Force::new(R::Vec3::ZERO, axis))
    }

    /// The directions of a task in six coordinates: rotations about the axes, and the position
    /// along them.
    ///
    /// A rotation is expressed as the path of a point at `radius`, m, so that all coordinates are
    /// lengths; 1 m gives rad.
    #[inline(always)]
    pub fn turn_and_place(&self, radius: R) -> [Force<R>; 6] {
        let [x, y, z] = self.place();
        let turn = |axis: Force<R>| Force::new(axis.lin * radius, R::Vec3::ZERO);
        [turn(x), turn(y), turn(z), x, y, z]
    }
}

/// The command along one direction of a task, a motion or a force: Khatib's selection matrix, as a
/// type.
#[doc(alias = "selection matrix")]
#[doc(alias = "compliance selection")]
#[doc(alias = "Aim")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TaskCommand<R> {
    /// A motion (Ω has a one here).
    Motion {
        /// ẍ*, m/s².
        acceleration: R,
    },
    /// A force (Ω̄ has a one here).
    Force {
        /// f* that the body exerts on its environment, N.
        force: R,
        /// The acceleration that damps motion while in contact, m/s²: usually −k ẋ.
        acceleration: R,
    },
}

/// A motion along one direction of a task that follows x_d as a damped oscillator: for
/// [`TaskCommand::motion`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TaskMotion<R> {
    /// x_d − x, m; of a rotation a component of [`orientation_error`], times the radius that its
    /// direction has.
    pub error: R,
    /// ẋ_d − ẋ, m/s.
    pub error_rate: R,
    /// ẍ_d, m/s².
    pub acceleration: R,
    /// Natural frequency ω, rad/s.
    pub omega_n: R,
    /// Damping ratio ζ.
    pub zeta: R,
}

/// A force along one direction of a task, and the damping of the motion in contact: for
/// [`TaskCommand::force`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TaskForce<R> {
    /// Desired force f_d of the body on its environment, N.
    pub desired: R,
    /// Measured force f of the body on its environment, N.
    pub measured: R,
    /// Gain k on their difference, dimensionless.
    pub gain: R,
    /// ẋ, m/s.
    pub velocity: R,
    /// Damping d, 1/s.
    pub damping: R,
}

impl<R: Real> TaskCommand<R> {
    /// A motion that follows x_d: ẍ* = ẍ_d + 2 ζ ω (ẋ_d − ẋ) + ω² (x_d − x).
    ///
    /// # Cost
    /// 6 flops.
    ///
    /// # Source
    /// Khatib (1987), (13).
    ///
    /// ```
    /// use motion_control::law::{TaskCommand, TaskMotion};
    /// let motion = TaskMotion { error: 0.01_f64, error_rate: 0.0, acceleration: 0.5, omega_n: 40.0, zeta: 1.0 };
    /// assert_eq!(TaskCommand::motion(motion), TaskCommand::Motion { acceleration: 16.5 });
    /// ```
    #[inline(always)]
    pub fn motion(task: TaskMotion<R>) -> Self {
        let damped = R::from_f64(2.0) * task.zeta * task.error_rate;
        let stiff = task.omega_n * (task.omega_n * task.error + damped);
        Self::Motion { acceleration: task.acceleration + stiff }
    }

    /// A force that converges to f_d: f* = f_d + k (f_d − f), with motion damped by −d ẋ.
    ///
    /// # Cost
    /// 5 flops.
    ///
    /// # Source
    /// Khatib (1987), (48) to (50).
    #[inline(always)]
    pub fn force(task: TaskForce<R>) -> Self {
        Self::Force {
            force: task.desired + task.gain * (task.desired - task.measured),
            acceleration: -(task.damping * task.velocity),
        }
    }
}

/// Computes the torques of a task of motions and forces, N·m or N.
///
/// `drift`: J̇ q̇ along the task's directions; `bias`: torques at q̈ = 0 of all effects on the
/// joints (velocity products, gravity, friction): Khatib's μ and p, in joint space. Torques that do
/// not act on the task may be added through [`OperationalSpace::null_space_torque`].
///
/// # Cost
/// 2 M (M + V) + 2 M + V flops for all data.
///
/// # Errors
/// None; near a singularity finite, see [`OperationalSpace::conditioning`].
///
/// ```
/// use dynamics_core::algorithms::{Damping, OperationalSpace, frame, task_jacobian};
/// use motion_control::law::{TaskCommand, TaskFrame, hybrid_motion_force};
/// use dynamics_core::effects::{Coriolis, Gravity, RIGID_BODY};
/// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
///
/// let arm = State { qd: [0.1_f32; 6], ..State::at([0.0, -1.2, 1.5, 0.3, 0.7, 0.0]) };
/// let factor = Engine::<Ur5e>::ltdl(&Engine::<Ur5e>::crba(&arm.q, &RIGID_BODY))?;
/// let directions = TaskFrame::BASE.place();
/// let rows = task_jacobian(&Core::<Ur5e>::jacobian(&arm.q, 5, frame::LocalWorldAligned), &directions);
/// let solve = |tau: &_| Engine::<Ur5e>::solve(&factor, tau);
/// let task = OperationalSpace::new(rows, solve, Damping::relative(1e-3));
///
/// // Press downwards with 20 N, stand still sideways, and let the elbow come to rest.
/// let still = TaskCommand::Motion { acceleration: 0.0 };
/// let commands = [still, still, TaskCommand::Force { force: -20.0, acceleration: 0.0 }];
/// let drift = Core::<Ur5e>::bias_acceleration(&arm, 5, frame::LocalWorldAligned);
/// let bias = Engine::<Ur5e>::rnea(&arm, &(Gravity::EARTH, Coriolis));
/// let mut tau = hybrid_motion_force(&task, &commands, &directions.map(|d| drift.dot(d)), &bias);
/// for (tau, rest) in tau.iter_mut().zip(task.null_space_torque(&arm.qd.map(|qd| -2.0 * qd))) {
///     *tau += rest;
/// }
/// # assert!(tau.iter().all(|tau| tau.is_finite()));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// The number of commands is that of the directions:
///
/// ```compile_fail,E0308
/// use dynamics_core::algorithms::OperationalSpace;
/// use motion_control::law::{TaskCommand, hybrid_motion_force};
/// fn two_of_three(task: &OperationalSpace<f32, 3, 6>) -> [f32; 6] {
///     let still = TaskCommand::Motion { acceleration: 0.0 };
///     hybrid_motion_force(task, &[still, still], &[0.0; 3], &[0.0; 6])
/// }
/// ```
#[doc(alias = "end effector")]
#[doc(alias = "operational space control")]
#[inline(always)]
pub fn hybrid_motion_force<R: Real, const M: usize, const V: usize>(
    task: &OperationalSpace<R, M, V>,
    commands: &[TaskCommand<R>; M],
    drift: &[R; M],
    bias: &[R; V],
) -> [R; V] {
    let (mut acceleration, mut exerted) = ([R::ZERO; M], [R::ZERO; M]);
    let both = acceleration.iter_mut().zip(&mut exerted);
    for ((acceleration, exerted), (command, &drift)) in both.zip(commands.iter().zip(drift)) {
        let (wanted, force) = match *command {
            TaskCommand::Motion { acceleration } => (acceleration, R::ZERO),
            TaskCommand::Force { force, acceleration } => (acceleration, force),
        };
        (*acceleration, *exerted) = (wanted - drift, force);
    }
    let mut force = task.force(&acceleration);
    for (force, exerted) in force.iter_mut().zip(exerted) {
        *force += exerted;
    }
    let mut tau = task.torque(&force);
    for (tau, &bias) in tau.iter_mut().zip(bias) {
        *tau += bias;
    }
    tau
}

/// The rotation from an attitude to the desired one as a vector: its sine along its axis, in base
/// coordinates.
///
/// It is zero only at the desired attitude and at a rotation by π from it.
///
/// # Cost
/// 27 flops.
///
/// # Source
/// Luh, Walker & Paul, "Resolved-acceleration control of
/// mechanical manipulators" (1980), (20).
///
/// ```
/// use motion_control::law::orientation_error;
/// use dynamics_core::glam::DMat3;
/// let error = orientation_error::<f64>(&DMat3::from_rotation_x(0.1), &DMat3::from_rotation_x(0.3));
/// assert!((error.x - 0.2_f64.sin()).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn orientation_error<R: Real>(attitude: &R::Mat3, wanted: &R::Mat3) -> R::Vec3 {
    let ([x, y, z], [wx, wy, wz]) = (attitude.cols(), wanted.cols());
    (x.cross(wx) + y.cross(wy) + z.cross(wz)) * R::from_f64(0.5)
}
