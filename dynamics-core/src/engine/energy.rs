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

impl<Arm, Sines> Engine<Arm, Sines> {
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
    pub fn kinetic_energy<Scalar: Real, Effects, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<Scalar, Q, V>,
        effects: &Effects,
    ) -> Scalar
    where
        Arm: Robot<B, Q, V>,
        Sines: Kernel<Scalar>,
        Effects: Effect<Scalar, B, V>,
    {
        scene_is_taken!();
        const {
            assert!(
                Effects::BASE_PARAMETERS == 0 || !Effects::BASE_MOTION,
                "base parameters in memory do not have all that the energy on a moving base needs; use `Core`"
            )
        };
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let (trig, qd) = (trig.borrow(), &state.state().qd);
        let all = Self::call(trig, effects).totals::<false>(Some(qd));
        all.twice.get() * Scalar::from_f64(0.5)
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
    pub fn potential_energy<Scalar: Real, Effects, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<Scalar, Q>,
        effects: &Effects,
    ) -> Scalar
    where
        Arm: Robot<B, Q, V>,
        Sines: Kernel<Scalar>,
        Effects: Effect<Scalar, B, V>,
    {
        scene_is_taken!();
        const { WithMasses::<Scalar, Effects, B, V>::KNOWN };
        let trig = q.trig_or(Self::trig_source());
        let call = Self::call(trig.borrow(), effects);
        let all = call.totals::<false>(None);
        // The base at rest accelerates by −g.
        let up = call.unaccelerated().a;
        up.dot(all.moment).get()
    }
}

/// A scene whose bodies have their masses.
pub(super) struct WithMasses<Scalar, Effects, const B: usize, const V: usize>(
    PhantomData<(Scalar, Effects)>,
);

impl<Scalar: Real, Effects: Effect<Scalar, B, V>, const B: usize, const V: usize>
    WithMasses<Scalar, Effects, B, V>
{
    pub(super) const KNOWN: () = assert!(
        Effects::BASE_PARAMETERS == 0,
        "base parameters in memory have no masses; use `Core`"
    );
}
