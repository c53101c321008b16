//! The mean velocity and acceleration of a time step, on joints of any kind.

use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::manifold::integrate;

/// Mean rates of a step: q ⊕ h q̇ and q̇ + h q̈ are its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepIncrement<R, const V: usize> {
    /// Mean velocity q̇, rad/s or m/s.
    pub qd: [R; V],
    /// Mean acceleration q̈, rad/s² or m/s².
    pub qdd: [R; V],
    /// Half the difference δ of the two halves' mean velocities, for rotations that do not commute:
    /// the first half of the step is at q̇ + δ, the second at q̇ − δ.
    pub half_difference: Option<[R; V]>,
}

impl<R: Real, const V: usize> StepIncrement<R, V> {
    /// A velocity and an acceleration that are constant over the step.
    #[cfg_attr(optimised, inline(always))]
    pub fn constant(qd: [R; V], qdd: [R; V]) -> Self {
        let half_difference = None;
        Self { qd, qdd, half_difference }
    }

    /// Configuration after h seconds from q, on this robot's joints.
    ///
    /// # Cost
    /// [`integrate`], twice if the halves of the step differ; V sums if all joints are known to
    /// have one axis.
    ///
    /// ```
    /// use dynamics_core::{state::manifold::neutral, model::{BASE, Body, Joint, Model}, sim::StepIncrement};
    /// let ball = Model::<f64, 1, 4, 3>::new("ball", [Body::new("b", BASE, Joint::spherical()).mass(1.0)]);
    /// let (about_x, about_y) = ([0.5, 0.5, 0.0], Some([0.5, -0.5, 0.0]));
    /// // A quarter about x, then a quarter about the new y.
    /// let quarters = StepIncrement { qd: about_x, qdd: [0.0; 3], half_difference: about_y };
    /// let [x, y, z, w] = quarters.configuration_after(&ball, &neutral(&ball), core::f64::consts::PI);
    /// assert!([x, y, z, w].iter().all(|part| (part - 0.5).abs() < 1e-15));
    /// ```
    #[cfg_attr(optimised, inline(always))]
    pub fn configuration_after<D, const B: usize, const Q: usize>(
        &self,
        robot: &D,
        q: &[R; Q],
        h: R,
    ) -> [R; Q]
    where
        D: RobotModel<R, B, Q, V>,
    {
        match self.half_difference {
            Some(half_difference) if !D::SINGLE => {
                let half = |sign| {
                    add_scaled(self.qd, sign, &half_difference).map(|qd| R::from_f64(0.5) * h * qd)
                };
                integrate(robot, &integrate(robot, q, &half(R::ONE)), &half(-R::ONE))
            }
            _ => integrate(robot, q, &self.qd.map(|qd| h * qd)),
        }
    }
}

/// x + h ẋ.
#[cfg_attr(optimised, inline(always))]
pub(super) fn add_scaled<R: Real, const V: usize>(mut x: [R; V], h: R, rates: &[R; V]) -> [R; V] {
    for (x, &rate) in x.iter_mut().zip(rates) {
        *x += h * rate;
    }
    x
}
