//! Operational space of a robot known at compile time.

use super::Core;
use crate::algorithms::{self, Damping, Frame, NotPositiveDefinite, OperationalSpace};
use crate::effects::Effect;
use crate::model::{Of, Robot};
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::Posture;

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
        algorithms::operational_space(&Of::<T>::NEW, q, body, directions, effects, damping)
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
        posture: &Posture<R, Q>,
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
        algorithms::operational_space_at(&Of::<T>::NEW, posture, body, directions, effects, damping)
    }
}
