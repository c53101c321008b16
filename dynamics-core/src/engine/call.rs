//! The arguments that all functions of one call of an algorithm share, in place of a list of
//! parameters.

use core::marker::PhantomData;

use super::compile::{Compiled, CompiledJoint, CompiledRobot};
use super::displacement::Displacement;
use super::{Engine, Specialised};
use crate::effects::JointState;
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::{JointTrig, State};

/// A compiled robot in one configuration, under the effects of a scene.
///
/// Forward dynamics writes its calls as literals. A call that a function returns is an aggregate,
/// and LLVM splits the sines and cosines that it refers to into values only after it has ordered
/// the operands of their products; articulated bodies then cost up to 2 % more cycles.
pub(crate) struct Call<'a, R, T, E, const B: usize, const Q: usize, const V: usize> {
    pub(super) turns: &'a [JointCoordinate<R>; Q],
    pub(super) effects: &'a E,
    pub(super) robot: PhantomData<T>,
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Clone for Call<'_, R, T, E, B, Q, V> {
    #[cfg_attr(optimised, inline(always))]
    fn clone(&self) -> Self {
        *self
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Copy for Call<'_, R, T, E, B, Q, V> {}

impl<T, K> Engine<T, K> {
    /// The source of sines and cosines for a robot of B bodies and V velocity coordinates.
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

impl<'a, R: Real, T: Compiled, E, const B: usize, const Q: usize, const V: usize>
    Call<'a, R, T, E, B, Q, V>
{
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(turns: &'a [JointCoordinate<R>; Q], effects: &'a E) -> Self {
        Self { turns, effects, robot: PhantomData }
    }

    /// The same under other effects.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn under<'b, F>(self, effects: &'b F) -> Call<'b, R, T, F, B, Q, V>
    where
        'a: 'b,
    {
        Call::new(self.turns, effects)
    }

    /// The displacement of joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn displacement<const I: usize>(self) -> Displacement<R, T, I> {
        Displacement::of(self.turns)
    }

    /// The position and velocity of coordinate I, which effects at joints read.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn joint_state<const I: usize>(self, state: &State<R, Q, V>) -> JointState<R> {
        joint_state::<R, T, Q, V, I>(state)
    }
}

/// The position and velocity of coordinate I, which effects at joints read.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_state<R: Real, T: Compiled, const Q: usize, const V: usize, const I: usize>(
    state: &State<R, Q, V>,
) -> JointState<R> {
    let q = match CompiledJoint::<T, I>::POSITION {
        Some(position) => state.q[position],
        None => R::ZERO,
    };
    JointState::new(q, state.qd[I])
}
