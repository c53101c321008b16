//! Operational space: the inertia of a task, and the torques that do not accelerate it.
//!
//! Khatib, "A unified approach for motion and force control of robot manipulators: the operational
//! space formulation" (1987):
//!
//! ```text
//! Λ = (J M⁻¹ Jᵀ)⁻¹      J̄ = M⁻¹ Jᵀ Λ      τ = Jᵀ F + (1 − Jᵀ J̄ᵀ) τ₀
//! ```

mod damped_inverse;
mod eigen;
mod osim_inverse;

pub(crate) use damped_inverse::shifted_inverse;
pub use damped_inverse::shifted_solution;
pub use damped_inverse::{Conditioning, Damping, damped_inverse};
pub use eigen::eigen;
pub use osim_inverse::{OsimInverse, osim_inverse};

use core::borrow::Borrow;

use crate::algorithms::{Frame, NotPositiveDefinite, crba, jacobian, ltdl, solve};
use crate::effects::Effect;
use crate::model::RobotModel;
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion};
use crate::state::Configuration;

/// The rows of a task's Jacobian: the rates of M directions of a body, given as forces, by its
/// [`super::jacobian`] in the same frame.
///
/// A direction is the force that corresponds to a unit of the task's coordinate; the rate of that
/// coordinate is the power v·f. Unit forces along the axes give velocities in m/s, unit couples
/// rates in rad/s; a couple of 1/l gives the velocity at the radius l, which makes rotations
/// comparable to lengths.
///
/// # Shape
/// M × V.
///
/// # Cost
/// 11 M flops for each coordinate.
///
/// # Example
/// ```
/// use dynamics_core::{Core, algorithms::{frame, task_jacobian}, robots::Ur5e, spatial::Force};
/// use glam::Vec3;
/// let j = Core::<Ur5e>::jacobian(&[0.1_f32; 6], 5, frame::LocalWorldAligned);
/// let [height] = task_jacobian(&j, &[Force::new(Vec3::ZERO, Vec3::Z)]);
/// assert!(height[0].abs() < 1e-7); // a turn about the vertical lifts nothing
/// ```
#[doc(alias = "task_rows")]
#[doc(alias = "selection matrix")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn task_jacobian<R: Real, const M: usize, const V: usize>(
    jacobian: &[Motion<R>; V],
    directions: &[Force<R>; M],
) -> [[R; V]; M] {
    directions.map(|direction| jacobian.map(|column| column.dot(direction)))
}

/// A body's Jacobian by rows: of its angular velocity about the axes of the frame, then of its
/// velocity along them.
///
/// It is the [`task_jacobian`] of unit couples and unit forces along the axes, without a flop.
///
/// # Shape
/// 6 × V.
///
/// # Cost
/// No flops.
///
/// # Example
/// ```
/// use dynamics_core::{Core, algorithms::{frame, jacobian_rows, task_jacobian}, robots::Ur5e, spatial::Force};
/// use glam::Vec3;
/// let j = Core::<Ur5e>::jacobian(&[0.1_f32; 6], 5, frame::LocalWorldAligned);
/// let [.., height] = jacobian_rows(&j);
/// assert_eq!([height], task_jacobian(&j, &[Force::new(Vec3::ZERO, Vec3::Z)]));
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn jacobian_rows<R: Real, const V: usize>(jacobian: &[Motion<R>; V]) -> [[R; V]; 6] {
    let columns = jacobian.map(|column| (column.ang.array(), column.lin.array()));
    let angular = |i: usize| columns.map(|(ang, _)| ang[i]);
    let linear = |i: usize| columns.map(|(_, lin)| lin[i]);
    [angular(0), angular(1), angular(2), linear(0), linear(1), linear(2)]
}

/// The operational-space inertia of a task on `body` along some directions, expressed in a
/// [`Frame`], by J, M and its factors.
///
/// Armatures and payloads are the effects that are part of M.
///
/// ```text
/// Λ = (J M⁻¹ Jᵀ)⁻¹      J̄ = M⁻¹ Jᵀ Λ      τ = Jᵀ F + (1 − Jᵀ J̄ᵀ) τ₀
/// ```
///
/// # Cost
/// The cost of [`super::crba()`], [`super::ltdl()`] and [`super::jacobian`], M solutions of 2 V²
/// flops, 2 M² V flops and [`damped_inverse()`].
///
/// # Source
/// Khatib (1987).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{Damping, frame, operational_space};
/// use dynamics_core::{effects::RIGID_BODY, glam::DVec3, model::Robot, robots::Ur5e, spatial::Force};
/// let q = [0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0];
/// let place = DVec3::AXES.map(|axis| Force::new(DVec3::ZERO, axis)); // the hand's position
/// let damping = Damping::relative(1e-3);
/// let task = operational_space(&Ur5e::MODEL, &q, (5, frame::LocalWorldAligned), &place, &RIGID_BODY, damping)?;
/// assert!(task.inertia[2][2] > 1.0); // kg, vertically
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names a joint that moves no inertia. A singular configuration is not an
/// error: the results are finite, and [`OperationalSpace::conditioning`] reports it.
#[doc(alias = "end effector")]
#[doc(alias = "OSIM")]
#[cfg_attr(optimised, inline(always))]
pub fn operational_space<
    R: Real,
    D,
    E,
    F,
    const M: usize,
    const B: usize,
    const Q: usize,
    const V: usize,
>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    (body, frame): (usize, F),
    directions: &[Force<R>; M],
    effects: &E,
    damping: Damping<R>,
) -> Result<OperationalSpace<R, M, V>, NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
    F: Frame,
{
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    let factors = ltdl(robot, &crba(robot, trig, effects))?;
    let rows = task_jacobian(&jacobian(robot, trig, body, frame), directions);
    let solve = |tau: &_| solve(robot, &factors, tau);
    Ok(OperationalSpace::new(rows, solve, damping))
}

/// A task of M coordinates on a robot of V, at one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperationalSpace<R, const M: usize, const V: usize> {
    /// J by rows: ẋ = J q̇.
    pub jacobian: [[R; V]; M],
    /// M⁻¹ Jᵀ by columns: the accelerations q̈ per unit of each task force.
    pub response: [[R; V]; M],
    /// Λ⁻¹ = J M⁻¹ Jᵀ.
    pub mobility: [[R; M]; M],
    /// Λ, damped near singularities: the task force F = Λ ẍ.
    pub inertia: [[R; M]; M],
    /// Whether Λ is damped.
    pub conditioning: Conditioning<R>,
}

impl<R: Real, const M: usize, const V: usize> OperationalSpace<R, M, V> {
    /// The operational space of a task from its Jacobian, by rows, and a solution of M x = τ with
    /// the factors of core or engine.
    ///
    /// Cost: M solutions, 2 M² V flops, and the inverse. Errors: none; in a singular configuration
    /// the results are finite, and `conditioning` reports it. Source: Khatib (1987), (18).
    ///
    /// ```
    /// use dynamics_core::{Core, Engine, effects::RIGID_BODY, robots::Ur5e, spatial::Force};
    /// use dynamics_core::algorithms::{Conditioning, Damping, OperationalSpace, frame, task_jacobian};
    /// use glam::Vec3;
    /// let q = [0.0_f32, -1.2, 1.5, 0.3, 0.7, 0.0];
    /// let factor = Engine::<Ur5e>::ltdl(&Engine::<Ur5e>::crba(&q, &RIGID_BODY))?;
    /// let place = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| Force::new(Vec3::ZERO, axis));
    /// let rows = task_jacobian(&Core::<Ur5e>::jacobian(&q, 5, frame::LocalWorldAligned), &place);
    /// let solve = |tau: &_| Engine::<Ur5e>::solve(&factor, tau);
    /// let task = OperationalSpace::new(rows, solve, Damping::relative(1e-3));
    /// assert_eq!(task.conditioning, Conditioning::Regular);
    /// assert!(task.inertia[2][2] > 1.0); // kg, vertically
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    #[cfg_attr(optimised, inline(always))]
    pub fn new(
        jacobian: [[R; V]; M],
        solve: impl Fn(&[R; V]) -> [R; V],
        damping: Damping<R>,
    ) -> Self {
        let mut response = [[R::ZERO; V]; M];
        for (response, row) in response.iter_mut().zip(&jacobian) {
            *response = solve(row);
        }
        let mut mobility = [[R::ZERO; M]; M];
        for (i, response) in response.iter().enumerate() {
            // The lower triangle, and with it the upper one: the inverse is then symmetric to the
            // last bit.
            for (j, row) in jacobian.iter().enumerate().take(i + 1) {
                let x = dot(row, response);
                mobility[i][j] = x;
                mobility[j][i] = x;
            }
        }
        let (inertia, conditioning) = damped_inverse(&mobility, damping);
        Self { jacobian, response, mobility, inertia, conditioning }
    }

    /// F = Λ ẍ: the task force of a task acceleration. 2 M² flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn force(&self, acceleration: &[R; M]) -> [R; M] {
        self.inertia.map(|row| dot(&row, acceleration))
    }

    /// τ = Jᵀ F: the torques of a task force, N·m or N. 2 M V flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn torque(&self, force: &[R; M]) -> [R; V] {
        combine(&self.jacobian, force)
    }

    /// J̄ = M⁻¹ Jᵀ Λ by columns: the dynamically consistent inverse of J, whose q̇ = J̄ ẋ has the
    /// least kinetic energy. 2 M² V flops. Khatib (1987), (37).
    #[cfg_attr(optimised, inline(always))]
    pub fn consistent_inverse(&self) -> [[R; V]; M] {
        self.inertia.map(|row| combine(&self.response, &row))
    }

    /// (1 − Jᵀ J̄ᵀ) τ₀: the part of torques τ₀ that does not accelerate the task. Khatib (1987),
    /// (53).
    ///
    /// If Λ is damped, some acceleration along the damped direction remains. 4 M V + 2 M² flops.
    #[cfg_attr(optimised, inline(always))]
    #[doc(alias = "null space")]
    #[doc(alias = "nullspace")]
    pub fn null_space_torque(&self, tau: &[R; V]) -> [R; V] {
        let task_force = self.force(&self.response.map(|response| dot(&response, tau)));
        let mut rest = self.torque(&task_force);
        for (rest, &tau) in rest.iter_mut().zip(tau) {
            *rest = tau - *rest;
        }
        rest
    }
}

#[cfg_attr(optimised, inline(always))]
fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(R::ZERO, |sum, product| sum + product)
}

/// Σ rows × weights.
#[cfg_attr(optimised, inline(always))]
fn combine<R: Real, const M: usize, const V: usize>(rows: &[[R; V]; M], by: &[R; M]) -> [R; V] {
    let mut sum = [R::ZERO; V];
    for (row, &by) in rows.iter().zip(by) {
        for (sum, &x) in sum.iter_mut().zip(row) {
            *sum += x * by;
        }
    }
    sum
}
