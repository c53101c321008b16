//! What all functions of one call of an algorithm share, in place of a list of parameters.

use core::marker::PhantomData;

use super::compile::{Compiled, CompiledJoint, CompiledRobot};
use super::displacement::Displacement;
use super::{Engine, Specialised};
use crate::effects::JointState;
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::{JointTrig, State};

/// The compiled robot C in one configuration, under the effects E.
pub(crate) struct Call<'a, R, C, E, const B: usize, const Q: usize, const V: usize> {
    pub(super) turns: &'a [JointCoordinate<R>; Q],
    pub(super) effects: &'a E,
    robot: PhantomData<C>,
}

impl<T, K> Engine<T, K> {
    /// What computes sines and cosines of a robot of B bodies and V velocity coordinates.
    pub(crate) const fn trig_source<const B: usize, const V: usize>() -> Specialised<T, K, B, V> {
        Specialised(PhantomData)
    }

    /// A call of an algorithm for the robot `T`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn call<'a, R: Real, E, const B: usize, const Q: usize, const V: usize>(
        trig: &'a JointTrig<R, Q>,
        effects: &'a E,
    ) -> Call<'a, R, CompiledRobot<T, B, Q, V>, E, B, Q, V>
    where
        T: Robot<B, Q, V>,
    {
        Call::new(&trig.coordinates, effects)
    }
}

impl<'a, R: Real, C: Compiled, E, const B: usize, const Q: usize, const V: usize>
    Call<'a, R, C, E, B, Q, V>
{
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(turns: &'a [JointCoordinate<R>; Q], effects: &'a E) -> Self {
        Self {
            turns,
            effects,
            robot: PhantomData,
        }
    }

    /// The same under other effects.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn under<'b, F>(&self, effects: &'b F) -> Call<'b, R, C, F, B, Q, V>
    where
        'a: 'b,
    {
        Call::new(self.turns, effects)
    }

    /// How far joint I has moved.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn displacement<const I: usize>(&self) -> Displacement<R> {
        Displacement::of::<C, Q, I>(self.turns)
    }

    /// What effects at coordinate I read.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn joint_state<const I: usize>(&self, state: &State<R, Q, V>) -> JointState<R> {
        joint_state::<R, C, Q, V, I>(state)
    }
}

/// What effects at coordinate I read.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_state<R: Real, C: Compiled, const Q: usize, const V: usize, const I: usize>(
    state: &State<R, Q, V>,
) -> JointState<R> {
    let q = match CompiledJoint::<C, I>::POSITION {
        Some(position) => state.q[position],
        None => R::ZERO,
    };
    JointState::new(q, state.qd[I])
}
