//! Bodies that are named while compiling: which of them move with a joint, and which joints move
//! them.

use core::marker::PhantomData;

use super::compile::{BodyPlacement, Compiled, CompiledJoint, place};
use crate::model::{BASE, Bodies};

/// All bodies of a robot.
#[derive(Clone, Copy)]
pub(super) struct AllBodies;

impl<const N: usize> Bodies<N> for AllBodies {
    const NUMBERS: [usize; N] = {
        let (mut numbers, mut i) = ([0; N], 0);
        while i < N {
            numbers[i] = i;
            i += 1;
        }
        numbers
    };
}

/// The K-th of the bodies of the list that move with joint I, or stand on the base.
pub(super) struct ListedBody<T, List, const N: usize, const I: usize, const K: usize>(
    PhantomData<(T, List)>,
);

impl<T: Compiled, List: Bodies<N>, const N: usize, const I: usize, const K: usize>
    ListedBody<T, List, N, I, K>
{
    /// Fails to compile if these are more bodies than one function can visit.
    pub(super) const ARE_FEW: () = assert!(
        count_on::<T>(&List::NUMBERS, CompiledJoint::<T, I>::LAST) <= 32,
        "the engine takes up to 32 named bodies that move with one joint; use `Core`"
    );
    /// Whether there is one.
    pub(super) const IS_SOME: bool = K < count_on::<T>(&List::NUMBERS, CompiledJoint::<T, I>::LAST);
    /// Its place in the list, and on the joint.
    pub(super) const BODY: &'static (usize, BodyPlacement) =
        &nth_on::<T>(&List::NUMBERS, CompiledJoint::<T, I>::LAST, K);
}

/// The joints that move some of these bodies, as bits.
pub(super) const fn joints<T: Compiled>(bodies: &[usize]) -> u64 {
    let (mut joints, mut k) = (0, 0);
    while k < bodies.len() {
        assert!(
            bodies[k] < T::PLACES.len(),
            "a named body is one that the robot does not have: bodies are numbered from 0"
        );
        let joint = T::PLACES[bodies[k]].joint;
        if joint != BASE {
            joints |= T::SUPPORT[joint];
        }
        k += 1;
    }
    joints
}

/// The number of these bodies that move with joint `i`.
const fn count_on<T: Compiled>(bodies: &[usize], i: usize) -> usize {
    let (mut count, mut k) = (0, 0);
    while k < bodies.len() {
        if place::<T>(bodies[k]).joint == i {
            count += 1;
        }
        k += 1;
    }
    count
}

/// The `n`-th of them: its place in the list, and on the joint. Without one, the first of the list.
const fn nth_on<T: Compiled>(bodies: &[usize], i: usize, mut n: usize) -> (usize, BodyPlacement) {
    let mut k = 0;
    while k < bodies.len() {
        let place = place::<T>(bodies[k]);
        if place.joint == i {
            if n == 0 {
                return (k, place);
            }
            n -= 1;
        }
        k += 1;
    }
    (0, place::<T>(BASE))
}
