//! Torques and accelerations of coordinates, of which one is given and the other computed.

use crate::model::LinkView;
use crate::scalar::{Real, Vector};
use crate::spatial::Motion;
use crate::state::entry;

/// The given quantity of a coordinate; hybrid dynamics computes the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prescribed<R> {
    /// The motor's torque or force, N·m or N.
    Torque(R),
    /// The acceleration, rad/s² or m/s²: a motor follows a prescribed motion.
    Acceleration(R),
}

impl<R: Real> Default for Prescribed<R> {
    fn default() -> Self {
        Self::Torque(R::ZERO)
    }
}

/// Torques and accelerations of all coordinates, given and computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointResult<R, const V: usize> {
    /// Torque of each motor, N·m or N.
    pub tau: [R; V],
    /// Acceleration of each joint, rad/s² or m/s².
    pub qdd: [R; V],
}

impl<R: Real, const V: usize> JointResult<R, V> {
    pub(super) const ZERO: Self = Self { tau: [R::ZERO; V], qdd: [R::ZERO; V] };

    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set(&mut self, joint: usize, tau: R, qdd: R) {
        if let (Some(t), Some(a)) = (self.tau.get_mut(joint), self.qdd.get_mut(joint)) {
            (*t, *a) = (tau, qdd);
        }
    }

    /// Sets the accelerations of a free joint: those of the body relative to its parent's.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set_relative(&mut self, link: &LinkView<'_, R>, a: Motion<R>, parent: Motion<R>) {
        let [ang, lin] = [a.ang - parent.ang, a.lin - parent.lin].map(R::Vec3::array);
        for (joint, &qdd) in link.coordinates().zip(ang.iter().chain(&lin)) {
            self.set(joint, entry(&self.tau, joint), qdd);
        }
    }
}
