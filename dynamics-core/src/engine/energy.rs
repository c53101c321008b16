//! Kinetic and potential energy.
//!
//! Featherstone, RBDA (2008), (2.67): T = Σ ½ v·I v; U = −Σ m g·c in a uniform field g.

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::Engine;
use crate::effects::{Declared, Effect};
use crate::model::Robot;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The kinetic energy T, J, as [`crate::algorithms::kinetic_energy`] computes it.
    ///
    /// # Cost
    /// Some 40 flops for each revolute joint; the same instructions for all data.
    ///
    /// # Source
    /// RBDA (2008), (2.67), over base parameters.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5; 6], ..State::at([0.3_f64; 6]) };
    /// let (a, b) = (Core::<Ur5e>::kinetic_energy(&state, &()), Engine::<Ur5e>::kinetic_energy(&state, &()));
    /// assert!((a - b).abs() < 1e-14);
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn kinetic_energy<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const {
            assert!(
                E::BASE_PARAMETERS == 0 || !E::BASE_MOTION,
                "base parameters in memory do not have all that the energy on a moving base needs; use `Core`"
            )
        };
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let (trig, qd) = (trig.borrow(), &state.state().qd);
        let all = Self::call(trig, effects).totals::<false>(Some(qd));
        all.twice.get() * R::from_f64(0.5)
    }

    /// The potential energy U in the field of the effects, J, zero at the height of the base's
    /// origin, as [`crate::algorithms::potential_energy`] computes it.
    ///
    /// # Cost
    /// Some 10 flops for each revolute joint; the same instructions for all data.
    ///
    /// # Source
    /// RBDA (2008), section 5.3, for a uniform field.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, effects::Gravity, robots::Ur5e};
    /// let energy = |lift| Engine::<Ur5e>::potential_energy(&[0.0, lift, 0.0, 0.0, 0.0, 0.0], &Gravity::EARTH);
    /// assert!(energy(-1.57_f64) > energy(0.0) + 50.0); // upright
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn potential_energy<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        effects: &E,
    ) -> R
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { WithMasses::<R, E, B, V>::KNOWN };
        let trig = q.trig_or(Self::trig_source());
        let call = Self::call(trig.borrow(), effects);
        let all = call.totals::<false>(None);
        // The base at rest accelerates by −g.
        let up = call.unaccelerated().a;
        up.dot(all.moment).get()
    }
}

/// A scene whose bodies have their masses.
pub(super) struct WithMasses<R, E, const B: usize, const V: usize>(PhantomData<(R, E)>);

impl<R: Real, E: Effect<R, B, V>, const B: usize, const V: usize> WithMasses<R, E, B, V> {
    pub(super) const KNOWN: () =
        assert!(E::BASE_PARAMETERS == 0, "base parameters in memory have no masses; use `Core`");
}
