//! Kinematics and mobility of a robot known at compile time.

use super::Core;
use crate::algorithms::{self, Frame, Kinematics, NotPositiveDefinite, OsimInverse, Pose};
use crate::effects::Effect;
use crate::model::{Robot, Static};
use crate::scalar::Real;
use crate::spatial::Motion;
use crate::state::{JointTrig, State};

impl<T> Core<T> {
    /// The pose of every body's own frame, see [`algorithms::poses`].
    #[inline(never)]
    pub fn poses<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
    ) -> [Pose<R>; B]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::poses(&Static::<T>::NEW, q)
    }

    /// As [`Core::poses`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn poses_at<R: Real, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
    ) -> [Pose<R>; B]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::poses_at(&Static::<T>::NEW, posture)
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
        algorithms::kinematics(&Static::<T>::NEW, state, effects)
    }

    /// As [`Core::kinematics`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn kinematics_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Kinematics<R, B>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::kinematics_at(&Static::<T>::NEW, posture, state, effects)
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
        algorithms::jacobian(&Static::<T>::NEW, q, body, frame)
    }

    /// As [`Core::jacobian`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn jacobian_at<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        body: usize,
        frame: F,
    ) -> [Motion<R>; V]
    where
        T: Robot<B, Q, V>,
    {
        algorithms::jacobian_at(&Static::<T>::NEW, posture, body, frame)
    }

    /// J̇ q̇ of a body, see [`algorithms::bias_acceleration`].
    #[inline(never)]
    pub fn bias_acceleration<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        body: usize,
        frame: F,
    ) -> Motion<R>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::bias_acceleration(&Static::<T>::NEW, state, body, frame)
    }

    /// As [`Core::bias_acceleration`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn bias_acceleration_at<R: Real, F: Frame, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        body: usize,
        frame: F,
    ) -> Motion<R>
    where
        T: Robot<B, Q, V>,
    {
        algorithms::bias_acceleration_at(&Static::<T>::NEW, posture, state, body, frame)
    }

    /// Λ⁻¹ of a body, see [`algorithms::osim_inverse`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn osim_inverse<R: Real, E, F: Frame, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        body: usize,
        frame: F,
        effects: &E,
    ) -> Result<OsimInverse<R>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::osim_inverse(&Static::<T>::NEW, q, body, frame, effects)
    }

    /// As [`Core::osim_inverse`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::osim_inverse`].
    #[inline(never)]
    pub fn osim_inverse_at<R: Real, E, F: Frame, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        body: usize,
        frame: F,
        effects: &E,
    ) -> Result<OsimInverse<R>, NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::osim_inverse_at(&Static::<T>::NEW, posture, body, frame, effects)
    }
}
