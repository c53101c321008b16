//! Operational space of a robot known at compile time.

use super::Core;
use crate::algorithms::{self, Damping, Frame, NotPositiveDefinite, OperationalSpace};
use crate::effects::Effect;
use crate::model::{Robot, Static};
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::JointTrig;

impl<T> Core<T> {
    /// A task on a body along some directions, see [`algorithms::operational_space`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn operational_space<
        R: Real,
        E,
        F,
        const M: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        q: &[R; Q],
        body: (usize, F),
        directions: &[Force<R>; M],
        effects: &E,
        damping: Damping<R>,
    ) -> Result<OperationalSpace<R, M, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
        F: Frame,
    {
        algorithms::operational_space(&Static::<T>::NEW, q, body, directions, effects, damping)
    }

    /// As [`Core::operational_space`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::operational_space`].
    #[inline(never)]
    pub fn operational_space_at<
        R: Real,
        E,
        F,
        const M: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        posture: &JointTrig<R, Q>,
        body: (usize, F),
        directions: &[Force<R>; M],
        effects: &E,
        damping: Damping<R>,
    ) -> Result<OperationalSpace<R, M, V>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
        F: Frame,
    {
        algorithms::operational_space_at(
            &Static::<T>::NEW,
            posture,
            body,
            directions,
            effects,
            damping,
        )
    }
}
