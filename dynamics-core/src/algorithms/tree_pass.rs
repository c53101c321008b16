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
    /// Whether a child has added to the sum of a body.
    begun: [bool; B],
    topology: PhantomData<T>,
}

/// The sums over `robot`, of nothing as yet.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inward_sums<
    A: Copy + Default,
    D,
    R: Real,
    const B: usize,
    const Q: usize,
    const V: usize,
>(
    _: &D,
) -> InwardSums<A, Tree<D, R, B, Q, V>, B>
where
    D: RobotModel<R, B, Q, V>,
{
    InwardSums {
        next: A::default(),
        all: [A::default(); B],
        begun: [false; B],
        topology: PhantomData,
    }
}

impl<A: Copy + Default + AddAssign, T: Topology, const B: usize> InwardSums<A, T, B> {
    /// The sum over body `i`, which is `own` or what `add` adds, and its descendants.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of(&self, i: usize, own: impl FnOnce() -> A, add: impl FnOnce(&mut A)) -> A {
        if T::CHAIN {
            let mut sum = self.next;
            add(&mut sum);
            return sum;
        }
        match (self.begun.get(i), self.all.get(i)) {
            (Some(true), Some(sum)) => *sum,
            _ => own(),
        }
    }

    /// Adds to the sum of body `parent`, which begins with its `own`, the quantity of a child.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn add(&mut self, parent: usize, child: A, own: impl FnOnce() -> A) {
        if T::CHAIN {
            self.next = child;
        } else if let (Some(begun), Some(sum)) =
            (self.begun.get_mut(parent), self.all.get_mut(parent))
        {
            if !*begun {
                (*begun, *sum) = (true, own());
            }
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
