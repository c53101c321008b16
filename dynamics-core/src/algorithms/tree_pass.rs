//! The two passes over a tree: outward, from the base to the tips, and inward.

use core::marker::PhantomData;

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
