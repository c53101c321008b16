//! One recursion over the bodies, on which most algorithms are built: on entering a joint it hands values outward to the
//! children, on leaving it adds what they return.

use core::marker::PhantomData;
use core::ops::Add;

use super::acceleration_field::{AccelerationField, JointRates};
use super::compile::{Compiled, CompiledJoint, JointPair};
use super::folding::Folded;
use super::only_if;
use super::pose::Pose;
use crate::model::{BASE, JointCoordinate};
use crate::scalar::Real;

/// What an algorithm does at each joint of the robot C.
pub(super) trait Pass<R: Real, C: Compiled> {
    /// What a body hands to its children.
    type Outward: Copy;
    /// What a body returns to its parent.
    type Inward: Copy + Add<Output = Self::Inward>;
    /// The sum over no children.
    const NOTHING: Self::Inward;
    /// The joints that it visits, as bits: with a joint, those that support it.
    const JOINTS: u32 = u32::MAX;

    /// Joint I, from what its parent hands outward.
    fn enter<const I: usize>(&mut self, parent: &Self::Outward) -> Self::Outward;

    /// Joint I, with the sum over its children; returns its own share in the parent's frame.
    fn leave<const I: usize>(&mut self, body: &Self::Outward, inner: Self::Inward) -> Self::Inward;
}

/// What a pass without a way inward returns.
#[derive(Clone, Copy)]
pub(super) struct Nothing;

impl Add for Nothing {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, _: Self) -> Self {
        self
    }
}

/// Visits all joints; returns the sum over those on the base.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn sweep<R: Real, C: Compiled, P: Pass<R, C>>(
    pass: &mut P,
    base: &P::Outward,
) -> P::Inward {
    children::<R, C, P, BASE>(pass, base)
}

/// A function that visits a joint.
type Visit<R, C, P> = fn(&mut P, &<P as Pass<R, C>>::Outward) -> <P as Pass<R, C>>::Inward;

/// Visits the children of joint I, or the joints on the base.
#[cfg_attr(not(debug_assertions), inline(always))]
fn children<R: Real, C: Compiled, P: Pass<R, C>, const I: usize>(
    pass: &mut P,
    body: &P::Outward,
) -> P::Inward {
    let mut sum = P::NOTHING;
    for_each_joint!(J, {
        if Step::<R, C, P, I, J>::IS_TAKEN
            && let Some(visit) = const {
                only_if(
                    Step::<R, C, P, I, J>::IS_TAKEN,
                    visit::<R, C, P, J> as Visit<R, C, P>,
                )
            }
        {
            sum = sum + visit(pass, body);
        }
    });
    sum
}

/// Visits joint I and its descendants.
#[cfg_attr(not(debug_assertions), inline(always))]
fn visit<R: Real, C: Compiled, P: Pass<R, C>, const I: usize>(
    pass: &mut P,
    parent: &P::Outward,
) -> P::Inward {
    let body = pass.enter::<I>(parent);
    let inner = children::<R, C, P, I>(pass, &body);
    pass.leave::<I>(&body, inner)
}

/// The way from joint I, or the base, to joint J.
struct Step<R, C, P, const I: usize, const J: usize>(PhantomData<(R, C, P)>);

impl<R: Real, C: Compiled, P: Pass<R, C>, const I: usize, const J: usize> Step<R, C, P, I, J> {
    const IS_TAKEN: bool = JointPair::<C, I, J>::IS_PARENT && P::JOINTS & (1 << J) != 0;
}

/// The pose of the body behind joint I.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn posed<R: Real, C: Compiled, const Q: usize, const I: usize>(
    parent: &Pose<R>,
    turns: &[JointCoordinate<R>; Q],
) -> Pose<R> {
    let turn = turns[I];
    let slide = Folded::runtime(turn.q) * Folded::constant(C::LENGTH_INV);
    parent.transformed_by(CompiledJoint::<C, I>::JOINT, turn, slide)
}

/// The field of the body behind joint I at these rates of the joint, with its pose if the parent's is known.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn moved<R: Real, C: Compiled, const Q: usize, const I: usize>(
    parent: &AccelerationField<R>,
    turns: &[JointCoordinate<R>; Q],
    rates: JointRates<R>,
) -> AccelerationField<R> {
    let joint = CompiledJoint::<C, I>::JOINT;
    let (turn, length_inv) = (turns[I], Folded::constant(C::LENGTH_INV));
    let slide = Folded::runtime(turn.q) * length_inv;
    let mut field = if joint.prismatic {
        let rates = JointRates {
            velocity: rates.velocity * length_inv,
            omega_products: rates.omega_products * length_inv,
            accel: rates.accel * length_inv,
        };
        parent.across_prismatic(joint, slide, rates)
    } else {
        parent.across_revolute(joint, turn, rates)
    };
    field.pose = parent.pose.transformed_by(joint, turn, slide);
    field
}
