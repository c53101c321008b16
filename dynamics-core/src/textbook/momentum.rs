//! Energy and momentum of a robot known at compile time.

use super::Core;
use crate::algorithms::{self, CenterOfMass, NotPositiveDefinite};
use crate::effects::Effect;
use crate::model::{Robot, Static};
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::{JointTrig, State};

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
        algorithms::kinetic_energy(&Static::<T>::NEW, state, effects)
    }

    /// As [`Core::kinetic_energy`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn kinetic_energy_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::kinetic_energy_at(&Static::<T>::NEW, posture, state, effects)
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
        algorithms::potential_energy(&Static::<T>::NEW, q, effects)
    }

    /// As [`Core::potential_energy`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn potential_energy_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::potential_energy_at(&Static::<T>::NEW, posture, effects)
    }

    /// Mass, its centre and that one's velocity, see [`algorithms::center_of_mass`].
    #[inline(never)]
    pub fn center_of_mass<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        effects: &E,
    ) -> CenterOfMass<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::center_of_mass(&Static::<T>::NEW, state, effects)
    }

    /// As [`Core::center_of_mass`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn center_of_mass_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> CenterOfMass<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::center_of_mass_at(&Static::<T>::NEW, posture, state, effects)
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
        algorithms::momentum(&Static::<T>::NEW, state, effects)
    }

    /// As [`Core::momentum`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn momentum_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::momentum_at(&Static::<T>::NEW, posture, state, effects)
    }

    /// q̇ with the first joint's rates of this momentum, see [`algorithms::base_velocity_from_momentum`].
    ///
    /// # Errors
    /// As [`algorithms::base_velocity_from_momentum`].
    #[inline(never)]
    pub fn base_velocity_from_momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        h: Force<R>,
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::base_velocity_from_momentum(&Static::<T>::NEW, state, h, effects)
    }

    /// As [`Core::base_velocity_from_momentum`], at a posture whose sines and cosines are at hand.
    ///
    /// # Errors
    /// As [`Core::base_velocity_from_momentum`].
    #[inline(never)]
    pub fn base_velocity_from_momentum_at<
        R: Real,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        h: Force<R>,
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::base_velocity_from_momentum_at(&Static::<T>::NEW, posture, state, h, effects)
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
        algorithms::centroidal_momentum(&Static::<T>::NEW, state, effects)
    }

    /// As [`Core::centroidal_momentum`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn centroidal_momentum_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::centroidal_momentum_at(&Static::<T>::NEW, posture, state, effects)
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
        algorithms::centroidal_matrix(&Static::<T>::NEW, q, effects)
    }

    /// As [`Core::centroidal_matrix`], at a posture whose sines and cosines are at hand.
    #[inline(never)]
    pub fn centroidal_matrix_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        posture: &JointTrig<R, Q>,
        effects: &E,
    ) -> [Force<R>; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        algorithms::centroidal_matrix_at(&Static::<T>::NEW, posture, effects)
    }
}
