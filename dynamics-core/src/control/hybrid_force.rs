//! Hybrid motion and force control in the operational space.
//!
//! Khatib (1987), section VI: F = Λ (Ω ẍ* + Ω̄ a − J̇ q̇) + Ω̄ f*, τ = Jᵀ F + C q̇ + g. The selection Ω is
//! the choice of an [`TaskCommand`] for each direction of the task.

use crate::algorithms::OperationalSpace;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Force;

/// The axes along which a task is told, fixed in the base; their origin is the body's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaskFrame<R: Real> {
    /// Its columns are the axes in base coordinates, of unit length and at right angles.
    pub axes: R::Mat3,
}

impl<R: Real> TaskFrame<R> {
    /// The base's axes.
    pub const BASE: Self = Self {
        axes: R::Mat3::IDENTITY,
    };

    /// The directions of a task in three coordinates: the place of the body's origin along the axes, m.
    ///
    /// For [`crate::algorithms::task_jacobian`] of a Jacobian in the frame `LocalWorldAligned`.
    #[inline(always)]
    pub fn place(&self) -> [Force<R>; 3] {
        self.axes.cols().map(|axis| Force::new(R::Vec3::ZERO, axis))
    }

    /// The directions of a task in six coordinates: turns about the axes, and the place along them.
    ///
    /// A turn counts as the way of a point at `radius`, m, so that all are lengths; 1 m gives rad.
    #[inline(always)]
    pub fn turn_and_place(&self, radius: R) -> [Force<R>; 6] {
        let [x, y, z] = self.place();
        let turn = |axis: Force<R>| Force::new(axis.lin * radius, R::Vec3::ZERO);
        [turn(x), turn(y), turn(z), x, y, z]
    }
}

/// What is asked along one direction of a task: Khatib's selection, as a type.
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

impl<R: Real> TaskCommand<R> {
    /// A motion that follows x_d: ẍ* = ẍ_d + 2 ζ ω (ẋ_d − ẋ) + ω² (x_d − x).
    ///
    /// `aim`, `seen`: place (m) and velocity (m/s); `feed` = ẍ_d, m/s². A turn has only an error: pass it as the
    /// place of the aim. 8 flops. Khatib (1987), (13).
    #[inline(always)]
    pub fn motion(aim: [R; 2], seen: [R; 2], feed: R, omega_n: R, zeta: R) -> Self {
        let [error, rate] = [aim[0] - seen[0], aim[1] - seen[1]];
        let stiff = omega_n * (omega_n * error + R::from_f64(2.0) * zeta * rate);
        Self::Motion {
            acceleration: feed + stiff,
        }
    }

    /// A force that comes to `aim` N: f* = f_d + k (f_d − f), and motion damped by −d ẋ.
    ///
    /// `seen`: what a sensor says the body exerts, N; `gain` k without unit; `damping` d in 1/s. 6 flops. Khatib
    /// (1987), (48) to (50).
    #[inline(always)]
    pub fn force(aim: R, seen: R, gain: R, rate: R, damping: R) -> Self {
        Self::Force {
            force: aim + gain * (aim - seen),
            acceleration: -(damping * rate),
        }
    }
}

/// The torques of a task of motions and forces, N·m or N.
///
/// `drift`: J̇ q̇ along the task's directions; `bias`: torques at q̈ = 0 of all that acts on the joints
/// (velocity products, gravity, friction): Khatib's μ and p, and their like outside the task. Torques that
/// the task shall not feel may be added through [`OperationalSpace::unseen`]. Cost: 2 M (M + V) + 2 M + V flops,
/// the same whatever the data. Errors: none; near a singularity finite, see [`OperationalSpace::conditioning`].
///
/// ```
/// use dynamics_core::algorithms::{Damping, OperationalSpace, frame, task_jacobian};
/// use dynamics_core::control::{TaskCommand, TaskFrame, hybrid_motion_force};
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
/// let aims = [still, still, TaskCommand::Force { force: -20.0, acceleration: 0.0 }];
/// let drift = Core::<Ur5e>::bias_acceleration(&arm, 5, frame::LocalWorldAligned);
/// let bias = Engine::<Ur5e>::rnea(&arm, &(Gravity::EARTH, Coriolis));
/// let mut tau = hybrid_motion_force(&task, &aims, &directions.map(|d| drift.dot(d)), &bias);
/// for (tau, rest) in tau.iter_mut().zip(task.null_space_torque(&arm.qd.map(|qd| -2.0 * qd))) {
///     *tau += rest;
/// }
/// # assert!(tau.iter().all(|tau| tau.is_finite()));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// An aim for each direction, neither more nor less:
///
/// ```compile_fail,E0308
/// use dynamics_core::{algorithms::OperationalSpace, control::{TaskCommand, hybrid_motion_force}};
/// fn two_of_three(task: &OperationalSpace<f32, 3, 6>) -> [f32; 6] {
///     let still = TaskCommand::Motion { acceleration: 0.0 };
///     hybrid_motion_force(task, &[still, still], &[0.0; 3], &[0.0; 6])
/// }
/// ```
#[inline(always)]
pub fn hybrid_motion_force<R: Real, const M: usize, const V: usize>(
    task: &OperationalSpace<R, M, V>,
    aims: &[TaskCommand<R>; M],
    drift: &[R; M],
    bias: &[R; V],
) -> [R; V] {
    let (mut acceleration, mut exerted) = ([R::ZERO; M], [R::ZERO; M]);
    let both = acceleration.iter_mut().zip(&mut exerted);
    for ((acceleration, exerted), (aim, &drift)) in both.zip(aims.iter().zip(drift)) {
        let (wanted, force) = match *aim {
            TaskCommand::Motion { acceleration } => (acceleration, R::ZERO),
            TaskCommand::Force {
                force,
                acceleration,
            } => (acceleration, force),
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

/// The turn from an attitude to the wanted one as a vector: its sine along its axis, in base coordinates.
///
/// Zero only there and at half a turn from it. 27 flops. Luh, Walker & Paul, "Resolved-acceleration control of
/// mechanical manipulators" (1980), (20).
///
/// ```
/// use dynamics_core::control::orientation_error;
/// use glam::DMat3;
/// let error = orientation_error::<f64>(&DMat3::from_rotation_x(0.1), &DMat3::from_rotation_x(0.3));
/// assert!((error.x - 0.2_f64.sin()).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn orientation_error<R: Real>(attitude: &R::Mat3, wanted: &R::Mat3) -> R::Vec3 {
    let ([x, y, z], [wx, wy, wz]) = (attitude.cols(), wanted.cols());
    (x.cross(wx) + y.cross(wy) + z.cross(wz)) * R::from_f64(0.5)
}
