//! The state of a robot, and the sines and cosines of one configuration.

mod configuration;
mod incremental;
pub mod manifold;

pub(crate) use crate::math::entry;
pub use configuration::{Configuration, RobotState, StateWithTrig, TrigSource};
pub use incremental::IncrementalTrig;

use crate::model::{JointCoordinate, RobotModel};
use crate::scalar::Real;
use crate::trig::{Kernel, VECTORS};

/// Positions q (rad, m), velocities q̇ and accelerations q̈ of all joints.
///
/// ```
/// use dynamics_core::state::State;
/// let at_rest = State::<f32, 6, 6>::at([0.1; 6]);
/// assert_eq!(at_rest.qd, [0.0; 6]);
/// ```
///
/// # Shape
/// The three arrays one after the other, as in a C struct of them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct State<R, const Q: usize, const V: usize> {
    /// Positions q, rad or m.
    pub q: [R; Q],
    /// Velocities q̇, rad/s or m/s.
    pub qd: [R; V],
    /// Accelerations q̈, rad/s² or m/s².
    pub qdd: [R; V],
}

/// The state of an arm of N joints of one degree of freedom each.
pub type ArmState<R, const N: usize> = State<R, N, N>;

impl<R: Real, const Q: usize, const V: usize> State<R, Q, V> {
    /// The state of rest at q.
    pub fn at(q: [R; Q]) -> Self {
        Self { q, qd: [R::ZERO; V], qdd: [R::ZERO; V] }
    }

    /// Whether every number is finite.
    #[cfg_attr(optimised, inline(always))]
    pub fn is_finite(&self) -> bool {
        all_finite(&self.q) & all_finite(&self.qd) & all_finite(&self.qdd)
    }
}

/// Whether every number is finite; the same instructions for all data.
#[cfg_attr(optimised, inline(always))]
pub fn all_finite<R: Real>(values: &[R]) -> bool {
    // x·0 is 0 for finite x and NaN otherwise; sums of zeros are zero.
    let sum = values.iter().fold(R::ZERO, |sum, &x| sum + x * R::ZERO);
    sum == R::ZERO
}

/// The coordinates of all joints with their sines and cosines: computed once a tick, for all
/// algorithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointTrig<R, const Q: usize> {
    /// One entry per position coordinate.
    pub coordinates: [JointCoordinate<R>; Q],
}

impl<R: Real, const Q: usize> JointTrig<R, Q> {
    /// The sines and cosines of `robot` at q, by the robot's kernel; quaternions at unit length.
    ///
    /// With the default kernel, in f32: absolute error below 1.2·10⁻⁷ while |q| ≤ 10⁴ rad. A
    /// quaternion whose square is 1 + ε, |ε| < 1/8, comes to unit length within 3ε²/8, any other
    /// within rounding; those whose direction matters first go through
    /// [`crate::state::manifold::normalise`]. The quaternion zero, which has no direction, is
    /// replaced by no rotation, so that [`State::at`] of zeros is a valid state.
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn new<D, const B: usize, const V: usize>(robot: &D, q: &[R; Q]) -> Self
    where
        D: RobotModel<R, B, Q, V>,
    {
        Self::with_kernel::<D::Kernel, D, B, V>(robot, q)
    }

    /// As [`Self::new`], with the kernel K in place of the robot's own: for models loaded at run
    /// time.
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::Ur5e, state::JointTrig, trig::Table};
    /// let coarse = JointTrig::with_kernel::<Table<256, 1>, _, _, _>(&Ur5e::MODEL_F32, &[0.5; 6]);
    /// assert!((coarse.coordinates[3].sin - 0.5_f32.sin()).abs() < 1e-4);
    /// ```
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn with_kernel<K, D, const B: usize, const V: usize>(robot: &D, q: &[R; Q]) -> Self
    where
        K: Kernel<R>,
        D: RobotModel<R, B, Q, V>,
    {
        if const { VECTORS } && robot.model().kinds().are_revolute_or_fixed() {
            return Self { coordinates: q.map(JointCoordinate::with_kernel::<K>) };
        }
        let mut turns = [JointCoordinate::default(); Q];
        robot.links().for_each(|link| link.pose::<K>(q, &mut turns));
        Self { coordinates: turns }
    }
}
