//! Kinematics and mobility of a robot known at compile time.

use super::Core;
use crate::algorithms::{self, Frame, Kinematics, Mobility, NotPositiveDefinite, Pose};
use crate::effects::Effect;
use crate::model::{Of, Robot};
use crate::scalar::Real;
use crate::spatial::Motion;
use crate::state::{Posture, State};

impl<T> Core<T> {
    /// The pose of every body's own frame, see [`algorithms::poses`].
    #[inline(never)]
    pub fn poses<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
    ) -> [Pose<R>; B]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::poses(&Of::<T>::NEW, q)
    }

    /// As [`Core::poses`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn poses_at<R: Real, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
    ) -> [Pose<R>; B]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::poses_at(&Of::<T>::NEW, posture)
    }

    /// Pose, velocity and acceleration of every body, see [`algorithms::kinematics`].
    #[inline(never)]
    pub fn kinematics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Kinematics<R, B>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::kinematics(&Of::<T>::NEW, state, effects)
    }

    /// As [`Core::kinematics`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn kinematics_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Kinematics<R, B>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::kinematics_at(&Of::<T>::NEW, posture, state, effects)
    }

    /// J of a body by columns, see [`algorithms::jacobian`].
    #[inline(never)]
    pub fn jacobian<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        body: usize,
        frame: F,
    ) -> [Motion<R>; V]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::jacobian(&Of::<T>::NEW, q, body, frame)
    }

    /// As [`Core::jacobian`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn jacobian_at<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        body: usize,
        frame: F,
    ) -> [Motion<R>; V]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::jacobian_at(&Of::<T>::NEW, posture, body, frame)
    }

    /// J̇ q̇ of a body, see [`algorithms::drift`].
    #[inline(never)]
    pub fn drift<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        body: usize,
        frame: F,
    ) -> Motion<R>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::drift(&Of::<T>::NEW, state, body, frame)
    }

    /// As [`Core::drift`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn drift_at<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        body: usize,
        frame: F,
    ) -> Motion<R>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::drift_at(&Of::<T>::NEW, posture, state, body, frame)
    }

    /// Λ⁻¹ of a body, see [`algorithms::mobility`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn mobility<R: Real, E, F: Frame, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        body: usize,
        frame: F,
        effects: &E,
    ) -> Result<Mobility<R>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::mobility(&Of::<T>::NEW, q, body, frame, effects)
    }

    /// As [`Core::mobility`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::mobility`].
    #[inline(never)]
    pub fn mobility_at<R: Real, E, F: Frame, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        body: usize,
        frame: F,
        effects: &E,
    ) -> Result<Mobility<R>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::mobility_at(&Of::<T>::NEW, posture, body, frame, effects)
    }
}
