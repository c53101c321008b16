//! One recursion over the bodies, on which most algorithms are built: on entering a joint it hands
//! values outward to the children, on leaving it adds what they return.

use core::marker::PhantomData;
use core::ops::Add;

use super::acceleration_field::AccelerationField;
use super::compile::{Compiled, CompiledJoint, JointPair};
use super::displacement::Displacement;
use super::folding::Folded;
use super::joint_rates::{JointRates, SeveralRates, Twist};
use crate::model::{BASE, JointCoordinate};
use crate::scalar::Real;

/// The work of an algorithm at each joint of a robot.
pub(super) trait Pass {
    /// The robot.
    type Tree: Compiled;
    /// The values that a body hands to its children.
    type Outward: Copy;
    /// The values that a body returns to its parent.
    type Inward: Copy + Add<Output = Self::Inward>;
    /// The sum over no children.
    const NOTHING: Self::Inward;
    /// The joints that it visits, as bits: with a joint, those that support it.
    const JOINTS: u64 = u64::MAX;

    /// The body behind joint I, the first of its coordinates, from what its parent hands outward.
    fn enter<const I: usize>(&mut self, parent: &Self::Outward) -> Self::Outward;

    /// The same body, with the sum over its children; returns its own share in the parent's frame.
    fn leave<const I: usize>(&mut self, body: &Self::Outward, inner: Self::Inward) -> Self::Inward;
}

/// The value that a pass returns if it computes nothing on its way inward.
#[derive(Clone, Copy)]
pub(super) struct Nothing;

impl Add for Nothing {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, _: Self) -> Self {
        self
    }
}

/// Visits all joints; returns the sum over those on the base.
#[cfg_attr(optimised, inline(always))]
pub(super) fn sweep<P: Pass>(pass: &mut P, base: &P::Outward) -> P::Inward {
    children::<P, BASE>(pass, base)
}

/// Visits the children of joint I, or the joints on the base.
#[cfg_attr(optimised, inline(always))]
fn children<P: Pass, const I: usize>(pass: &mut P, body: &P::Outward) -> P::Inward {
    let mut sum = P::NOTHING;
    for_each_joint!(
        J,
        Step::<P, I, J>::IS_TAKEN,
        visit = visit::<P, J> as fn(&mut P, &P::Outward) -> P::Inward,
        {
            sum = sum + visit(pass, body);
        }
    );
    sum
}

/// Visits joint I and its descendants.
#[cfg_attr(optimised, inline(always))]
fn visit<P: Pass, const I: usize>(pass: &mut P, parent: &P::Outward) -> P::Inward {
    let body = pass.enter::<I>(parent);
    let inner = children::<P, I>(pass, &body);
    pass.leave::<I>(&body, inner)
}

/// The way from joint I, or the base, to joint J.
struct Step<P, const I: usize, const J: usize>(PhantomData<P>);

impl<P: Pass, const I: usize, const J: usize> Step<P, I, J> {
    const IS_TAKEN: bool = JointPair::<P::Tree, I, J>::IS_CHILD && P::JOINTS & (1 << J) != 0;
}

/// The positions and rates of all joints, and which rates a pass needs; what it does not need is a
/// known zero.
#[derive(Clone, Copy)]
pub(super) struct Motions<'a, R, const Q: usize, const V: usize> {
    pub(super) turns: &'a [JointCoordinate<R>; Q],
    pub(super) qd: &'a [R; V],
    pub(super) qdd: &'a [R; V],
    pub(super) velocity: bool,
    /// Whether the products of velocities are needed.
    pub(super) products: bool,
    pub(super) accel: bool,
}

impl<R: Real, const Q: usize, const V: usize> Motions<'_, R, Q, V> {
    /// The field of the body behind joint I, from that of its parent, with its pose if the parent's
    /// is known.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn field<T: Compiled, const I: usize>(
        &self,
        parent: &AccelerationField<R>,
    ) -> AccelerationField<R> {
        let at = Displacement::<R, T, I>::of(self.turns);
        let (qd, qdd) = (self.qd, self.qdd);
        let mut field = if CompiledJoint::<T, I>::COUNT > 1 {
            let several = SeveralRates {
                velocity: Twist::of::<T, V, I>(qd, self.velocity),
                products: Twist::of::<T, V, I>(qd, self.products),
                accel: Twist::of::<T, V, I>(qdd, self.accel),
            };
            parent.across_several(&at, &several)
        } else {
            let unit = if CompiledJoint::<T, I>::PRISMATIC {
                Folded::constant(T::LENGTH_INV)
            } else {
                Folded::ONE
            };
            let one = JointRates {
                velocity: Folded::runtime_if(self.velocity, qd[I]) * unit,
                omega_products: Folded::runtime_if(self.products, qd[I]) * unit,
                accel: Folded::runtime_if(self.accel, qdd[I]) * unit,
            };
            parent.across(&at, one)
        };
        field.pose = parent.pose.transformed_by(&at);
        field
    }
}
