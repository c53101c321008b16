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
pub(crate) struct Call<'a, Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize> {
    pub(super) turns: &'a [JointCoordinate<Scalar>; Q],
    pub(super) effects: &'a Effects,
    pub(super) robot: PhantomData<Tree>,
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize> Clone
    for Call<'_, Scalar, Tree, Effects, B, Q, V>
{
    #[cfg_attr(optimised, inline(always))]
    fn clone(&self) -> Self {
        *self
    }
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize> Copy
    for Call<'_, Scalar, Tree, Effects, B, Q, V>
{
}

impl<Arm, Sines> Engine<Arm, Sines> {
    /// The source of sines and cosines for a robot of B bodies and V velocity coordinates.
    pub(crate) const fn trig_source<const B: usize, const V: usize>()
    -> Specialised<Arm, Sines, B, V> {
        Specialised(PhantomData)
    }

    /// A call of an algorithm for the robot `Arm`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn call<'a, Scalar: Real, Effects, const B: usize, const Q: usize, const V: usize>(
        trig: &'a JointTrig<Scalar, Q>,
        effects: &'a Effects,
    ) -> Call<'a, Scalar, CompiledRobot<Arm, B, Q, V>, Effects, B, Q, V>
    where
        Arm: Robot<B, Q, V>,
    {
        Call::new(&trig.coordinates, effects)
    }
}

impl<'a, Scalar: Real, Tree: Compiled, Effects, const B: usize, const Q: usize, const V: usize>
    Call<'a, Scalar, Tree, Effects, B, Q, V>
{
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn new(turns: &'a [JointCoordinate<Scalar>; Q], effects: &'a Effects) -> Self {
        Self { turns, effects, robot: PhantomData }
    }

    /// The same under other effects.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn under<'b, F>(self, effects: &'b F) -> Call<'b, Scalar, Tree, F, B, Q, V>
    where
        'a: 'b,
    {
        Call::new(self.turns, effects)
    }

    /// The displacement of joint I.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn displacement<const I: usize>(self) -> Displacement<Scalar, Tree, I> {
        Displacement::of(self.turns)
    }

    /// The position and velocity of coordinate I, which effects at joints read.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn joint_state<const I: usize>(
        self,
        state: &State<Scalar, Q, V>,
    ) -> JointState<Scalar> {
        joint_state::<Scalar, Tree, Q, V, I>(state)
    }
}

/// The position and velocity of coordinate I, which effects at joints read.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn joint_state<
    Scalar: Real,
    Tree: Compiled,
    const Q: usize,
    const V: usize,
    const I: usize,
>(
    state: &State<Scalar, Q, V>,
) -> JointState<Scalar> {
    let q = match CompiledJoint::<Tree, I>::POSITION {
        Some(position) => state.q[position],
        None => Scalar::ZERO,
    };
    JointState::new(q, state.qd[I])
}
