//! The places of a clustered robot's coordinates, as constants with names.

use core::marker::PhantomData;

use super::description::sealed::Set;
use super::layout::{Layout, NONE, at, independent};
use super::{Cluster, ClusteredRobot};

/// The layout of a robot's coordinates, with its checks: constants with names, which the compiler
/// evaluates once, and not in each instance of a function.
pub(super) struct TreeLayout<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
>(PhantomData<T>);

impl<T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    TreeLayout<T, B, Q, V, P, Y>
where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    pub(super) const LAYOUT: &'static Layout<Q, V> =
        &Layout::of(&T::MODEL, T::COORDINATES, <T::Clusters as Set>::SIZES, [P, Y]);
}

/// The J-th velocity coordinate of the tree, and its J-th position.
pub(super) struct TreeCoordinate<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
    const J: usize,
>(PhantomData<T>);

impl<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
    const J: usize,
> TreeCoordinate<T, B, Q, V, P, Y, J>
where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    /// The place in ẏ of a velocity in no cluster; beyond the last one and of others, [`NONE`].
    pub(super) const FREE_VELOCITY: usize = at(&TreeLayout::<T, B, Q, V, P, Y>::LAYOUT.free, J);
    /// The place in y of a position in no cluster; beyond the last one and of others, [`NONE`].
    pub(super) const FREE_POSITION: usize = at(&TreeLayout::<T, B, Q, V, P, Y>::LAYOUT.free_q, J);
    /// Whether there is such a velocity coordinate, in no cluster.
    pub(super) const IS_FREE: bool =
        J < V && TreeLayout::<T, B, Q, V, P, Y>::LAYOUT.cluster[J] == NONE;
}

/// Row J of the I-th cluster.
pub(super) struct ClusterRow<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
    const I: usize,
    const J: usize,
>(PhantomData<T>);

impl<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
    const I: usize,
    const J: usize,
> ClusterRow<T, B, Q, V, P, Y, I, J>
where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    /// The velocity coordinate of the tree; beyond the last row, [`NONE`].
    pub(super) const VELOCITY: usize = at(T::COORDINATES[I], J);
    /// The position that belongs to it; beyond the last row, [`NONE`].
    pub(super) const POSITION: usize =
        at(&TreeLayout::<T, B, Q, V, P, Y>::LAYOUT.position, Self::VELOCITY);
}

/// Row J of a cluster.
pub(super) struct IndependentRow<C, const M: usize, const N: usize, const J: usize>(PhantomData<C>);

impl<C: Cluster<M, N>, const M: usize, const N: usize, const J: usize> IndependentRow<C, M, N, J> {
    /// Which of the independent coordinates it is, if it is one.
    pub(super) const COLUMN: Option<usize> = independent::<N>(&C::INDEPENDENT, J);
}
