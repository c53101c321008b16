//! Energy and momentum of a robot known at compile time.

use super::Core;
use crate::algorithms::{self, MassCentre, NotPositiveDefinite};
use crate::effects::Effect;
use crate::model::{Of, Robot};
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::{Posture, State};

impl<T> Core<T> {
    /// T, see [`algorithms::kinetic_energy`].
    #[inline(never)]
    pub fn kinetic_energy<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::kinetic_energy(&Of::<T>::NEW, state, effects)
    }

    /// As [`Core::kinetic_energy`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn kinetic_energy_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::kinetic_energy_at(&Of::<T>::NEW, posture, state, effects)
    }

    /// U, see [`algorithms::potential_energy`].
    #[inline(never)]
    pub fn potential_energy<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::potential_energy(&Of::<T>::NEW, q, effects)
    }

    /// As [`Core::potential_energy`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn potential_energy_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::potential_energy_at(&Of::<T>::NEW, posture, effects)
    }

    /// Mass, its centre and that one's velocity, see [`algorithms::mass_centre`].
    #[inline(never)]
    pub fn mass_centre<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> MassCentre<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::mass_centre(&Of::<T>::NEW, state, effects)
    }

    /// As [`Core::mass_centre`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn mass_centre_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> MassCentre<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::mass_centre_at(&Of::<T>::NEW, posture, state, effects)
    }

    /// The momentum of all bodies, see [`algorithms::momentum`].
    #[inline(never)]
    pub fn momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::momentum(&Of::<T>::NEW, state, effects)
    }

    /// As [`Core::momentum`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn momentum_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::momentum_at(&Of::<T>::NEW, posture, state, effects)
    }

    /// q̇ with the first joint's rates of this momentum, see [`algorithms::with_momentum`].
    ///
    /// # Errors
    /// As [`algorithms::with_momentum`].
    #[inline(never)]
    pub fn with_momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        h: Force<R>,
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::with_momentum(&Of::<T>::NEW, state, h, effects)
    }

    /// As [`Core::with_momentum`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::with_momentum`].
    #[inline(never)]
    pub fn with_momentum_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        h: Force<R>,
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::with_momentum_at(&Of::<T>::NEW, posture, state, h, effects)
    }

    /// h_G, see [`algorithms::centroidal_momentum`].
    #[inline(never)]
    pub fn centroidal_momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::centroidal_momentum(&Of::<T>::NEW, state, effects)
    }

    /// As [`Core::centroidal_momentum`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn centroidal_momentum_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::centroidal_momentum_at(&Of::<T>::NEW, posture, state, effects)
    }

    /// A_G by columns, see [`algorithms::centroidal_matrix`].
    #[inline(never)]
    pub fn centroidal_matrix<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
        effects: &E,
    ) -> [Force<R>; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::centroidal_matrix(&Of::<T>::NEW, q, effects)
    }

    /// As [`Core::centroidal_matrix`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn centroidal_matrix_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &Posture<R, Q>,
        effects: &E,
    ) -> [Force<R>; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::centroidal_matrix_at(&Of::<T>::NEW, posture, effects)
    }
}
