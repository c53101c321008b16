//! The algorithms of a robot known at compile time, in their textbook form.

mod kinematics;
mod momentum;
mod operational;

use core::marker::PhantomData;

use crate::algorithms::{self, NotPositiveDefinite};
use crate::effects::Effect;
use crate::model::{Of, Robot};
use crate::scalar::Real;
use crate::state::{Posture, State};

/// The textbook loops over the model of the robot `T`.
///
/// ```
/// use dynamics_core::{Core, effects::RIGID_BODY, robots::Ur5e, state::State};
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let tau = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
/// let qdd = Core::<Ur5e>::aba(&state, &tau, &RIGID_BODY)?;
/// assert!(qdd.iter().all(|a| (a - 1.0).abs() < 1e-3));
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Core<T>(PhantomData<T>);

impl<T> Core<T> {
    /// The sines and cosines of the configuration q, for every algorithm of a tick.
    pub fn posture<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
    ) -> Posture<R, Q>
    where
        T: Robot<B, Q, V>,
    {
        Posture::of(&Of::<T>::NEW, q)
    }

    /// τ = ID(q, q̇, q̈), see [`algorithms::rnea`].
    #[inline(never)]
    pub fn rnea<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea(&Of::<T>::NEW, state, effects)
    }

    /// As [`Core::rnea`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn rnea_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::rnea_at(&Of::<T>::NEW, posture, state, effects)
    }

    /// q̈ = FD(q, q̇, τ), see [`algorithms::aba`].
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names a joint that moves no inertia.
    #[inline(never)]
    pub fn aba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::aba(&Of::<T>::NEW, state, tau, effects)
    }

    /// As [`Core::aba`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::aba`].
    #[inline(never)]
    pub fn aba_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::aba_at(&Of::<T>::NEW, posture, state, tau, effects)
    }
}
