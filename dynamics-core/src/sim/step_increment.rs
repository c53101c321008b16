//! The increment of a time step, on joints of any kind.

use super::Dynamics;
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::State;
use crate::state::manifold::integrate;

/// Mean rates of a step: q ⊕ h q̇ and q̇ + h q̈ are its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepIncrement<R, const V: usize> {
    /// Mean velocity q̇, rad/s or m/s.
    pub qd: [R; V],
    /// Mean acceleration q̈, rad/s² or m/s².
    pub qdd: [R; V],
    /// For rotations that do not commute: the first half of the step is at q̇ + bend, the second at q̇ − bend.
    pub bend: Option<[R; V]>,
}

impl<R: Real, const V: usize> StepIncrement<R, V> {
    /// Constant rates throughout the step.
    #[inline(always)]
    pub fn straight(qd: [R; V], qdd: [R; V]) -> Self {
        let bend = None;
        Self { qd, qdd, bend }
    }

    /// The configuration after h seconds at these rates from q, on this robot's joints. Cost: that of [`integrate`],
    /// twice if `bend` is not zero; for joints known to be of one axis, V sums.
    ///
    /// ```
    /// use dynamics_core::{state::manifold::neutral, model::{BASE, Body, Joint, Model}, sim::StepIncrement};
    /// let ball = Model::<f64, 1, 4, 3>::new("ball", [Body::new("b", BASE, Joint::spherical()).mass(1.0)]);
    /// let (about_x, about_y) = ([0.5, 0.5, 0.0], Some([0.5, -0.5, 0.0]));
    /// let quarters = StepIncrement { qd: about_x, qdd: [0.0; 3], bend: about_y }; // about x, then about the new y
    /// let [x, y, z, w] = quarters.moved(&ball, &neutral(&ball), core::f64::consts::PI);
    /// assert!([x, y, z, w].iter().all(|part| (part - 0.5).abs() < 1e-15));
    /// ```
    #[inline(always)]
    pub fn moved<D, const B: usize, const Q: usize>(&self, robot: &D, q: &[R; Q], h: R) -> [R; Q]
    where
        D: RobotModel<R, B, Q, V>,
    {
        match self.bend {
            Some(bend) if !D::SINGLE => {
                let half = |sign| ahead(self.qd, sign, &bend).map(|qd| R::from_f64(0.5) * h * qd);
                integrate(robot, &integrate(robot, q, &half(R::ONE)), &half(-R::ONE))
            }
            _ => integrate(robot, q, &self.qd.map(|qd| h * qd)),
        }
    }

    /// The state after h seconds at these rates; its q̈ is their mean.
    #[inline(always)]
    pub fn end<const Q: usize>(
        &self,
        mechanics: &impl Dynamics<R, Q, V>,
        from: &State<R, Q, V>,
        h: R,
    ) -> State<R, Q, V> {
        State {
            q: mechanics.moved(&from.q, self, h),
            qd: ahead(from.qd, h, &self.qdd),
            qdd: self.qdd,
        }
    }
}

/// x + h ẋ.
#[inline(always)]
pub(super) fn ahead<R: Real, const V: usize>(mut x: [R; V], h: R, rates: &[R; V]) -> [R; V] {
    for (x, &rate) in x.iter_mut().zip(rates) {
        *x += h * rate;
    }
    x
}
