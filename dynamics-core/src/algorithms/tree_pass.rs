//! The two passes over a tree: outward, from the base to the tips, and inward.

use core::marker::PhantomData;
use core::ops::AddAssign;

use heapless::Vec;

use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;

/// Whether the parent of every body is known to be the one before it.
pub(crate) trait Topology {
    const CHAIN: bool;
}

/// The topology of the robot D.
pub(crate) struct Tree<D, R, const B: usize, const Q: usize, const V: usize>(PhantomData<(D, R)>);

impl<D, R: Real, const B: usize, const Q: usize, const V: usize> Topology for Tree<D, R, B, Q, V>
where
    D: RobotModel<R, B, Q, V>,
{
    const CHAIN: bool = D::CHAIN;
}

/// A quantity of the base and of each body so far, from which the next body reads that of its parent.
///
/// For a chain only the last one is stored: `T::CHAIN` is a constant, and the other form is not in the machine code.
pub(crate) struct PerBody<A, T, const B: usize> {
    base: A,
    last: A,
    all: Vec<A, B>,
    topology: PhantomData<T>,
}

/// The base's quantity, for the bodies of `robot` to follow.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn per_body<A: Copy, D, R: Real, const B: usize, const Q: usize, const V: usize>(
    _: &D,
    base: A,
) -> PerBody<A, Tree<D, R, B, Q, V>, B>
where
    D: RobotModel<R, B, Q, V>,
{
    PerBody {
        base,
        last: base,
        all: Vec::new(),
        topology: PhantomData,
    }
}

impl<A: Copy, T: Topology, const B: usize> PerBody<A, T, B> {
    /// That of the parent of `link`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn parent<R: Real>(&self, link: &LinkView<'_, R>) -> A {
        if T::CHAIN {
            self.last
        } else {
            *self.all.get(link.parent).unwrap_or(&self.base)
        }
    }

    /// Adds that of the next body.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn push(&mut self, value: A) {
        if T::CHAIN {
            self.last = value;
        } else {
            let _ = self.all.push(value);
        }
    }
}

/// The inward pass over the results of the outward one.
pub(crate) struct Inward<'a, A>(&'a mut [A]);

/// From the last body to the first.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inward<A>(bodies: &mut [A]) -> Inward<'_, A> {
    Inward(bodies)
}

impl<'a, A> Inward<'a, A> {
    /// The next body, and those before it, among which is its parent: their count is the body's number.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn next(&mut self) -> Option<(&'a mut A, &mut [A])> {
        let (body, before) = core::mem::take(&mut self.0).split_last_mut()?;
        self.0 = before;
        Some((body, self.0))
    }
}

/// The sum of a quantity over each body and its descendants, which the inward pass adds to.
///
/// For a chain only what the next body has added is stored.
pub(crate) struct InwardSums<A, T, const B: usize> {
    next: A,
    all: [A; B],
    topology: PhantomData<T>,
}

/// The sums over `robot`, of each body alone as yet: `own`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inward_sums<
    A: Copy + Default,
    D,
    R: Real,
    const B: usize,
    const Q: usize,
    const V: usize,
>(
    robot: &D,
    own: impl Fn(usize, &LinkView<'_, R>) -> A,
) -> InwardSums<A, Tree<D, R, B, Q, V>, B>
where
    D: RobotModel<R, B, Q, V>,
{
    let mut all = [A::default(); B];
    if !D::CHAIN {
        for (i, (link, sum)) in robot.links().zip(&mut all).enumerate() {
            *sum = own(i, &link);
        }
    }
    InwardSums {
        next: A::default(),
        all,
        topology: PhantomData,
    }
}

impl<A: Copy + Default + AddAssign, T: Topology, const B: usize> InwardSums<A, T, B> {
    /// The sum over body `i` and its descendants; of a chain the body itself is added by `add`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of(&self, i: usize, add: impl FnOnce(&mut A)) -> A {
        if T::CHAIN {
            let mut sum = self.next;
            add(&mut sum);
            sum
        } else {
            self.all.get(i).copied().unwrap_or_default()
        }
    }

    /// Adds to the sum of body `parent` the quantity of a child.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn add(&mut self, parent: usize, child: A) {
        if T::CHAIN {
            self.next = child;
        } else if let Some(sum) = self.all.get_mut(parent) {
            *sum += child;
        }
    }
}

/// Of what stands for the bodies before `link`, that of its parent and of those before it.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn up_to_parent<'a, A, D, R: Real, const B: usize, const Q: usize, const V: usize>(
    _: &D,
    before: &'a [A],
    link: &LinkView<'_, R>,
) -> &'a [A]
where
    D: RobotModel<R, B, Q, V>,
{
    if D::CHAIN {
        before
    } else {
        before.get(..=link.parent).unwrap_or_default()
    }
}
