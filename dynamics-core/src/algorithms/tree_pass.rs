//! The two passes over a tree: outward, from the base to the tips, and inward.

use core::marker::PhantomData;
use core::ops::{AddAssign, Deref};

use heapless::Vec;

use crate::model::{LinkView, RobotModel};
use crate::scalar::Real;
use crate::trig::VECTORS;

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

/// A quantity of the base and of each body so far, from which the next body reads that of its
/// parent.
///
/// For a chain only the last one is stored: `T::CHAIN` is a constant, and the other form is not in
/// the machine code.
pub(crate) struct PerBody<A, T, const B: usize> {
    base: A,
    last: A,
    all: Vec<A, B>,
    topology: PhantomData<T>,
}

/// The base's quantity, for the bodies of `robot` to follow.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn per_body<A: Copy, D, R: Real, const B: usize, const Q: usize, const V: usize>(
    _: &D,
    base: A,
) -> PerBody<A, Tree<D, R, B, Q, V>, B>
where
    D: RobotModel<R, B, Q, V>,
{
    PerBody { base, last: base, all: Vec::new(), topology: PhantomData }
}

impl<A: Copy, T: Topology, const B: usize> PerBody<A, T, B> {
    /// The quantity of the parent of `link`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn parent<R: Real>(&self, link: &LinkView<'_, R>) -> A {
        if T::CHAIN { self.last } else { *self.all.get(link.parent).unwrap_or(&self.base) }
    }

    /// Adds the quantity of the next body.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn push(&mut self, value: A) {
        if T::CHAIN {
            self.last = value;
        } else {
            let _ = self.all.push(value);
        }
    }
}

/// A value that a body stores: on processors with vectors a copy that `complete` has changed,
/// elsewhere the value in its place, which takes less code.
#[cfg(any(target_feature = "sse2", target_feature = "neon"))]
#[cfg_attr(optimised, inline(always))]
fn read<T: Copy>(stored: &T, complete: impl FnOnce(T) -> T) -> impl Deref<Target = T> {
    struct Completed<T>(T);
    impl<T> Deref for Completed<T> {
        type Target = T;
        #[cfg_attr(optimised, inline(always))]
        fn deref(&self) -> &T {
            &self.0
        }
    }
    const { assert!(VECTORS) };
    Completed(complete(*stored))
}

#[cfg(not(any(target_feature = "sse2", target_feature = "neon")))]
#[cfg_attr(optimised, inline(always))]
fn read<T: Copy>(stored: &T, _: impl FnOnce(T) -> T) -> impl Deref<Target = T> {
    // Or a sum that was passed on would be lost.
    const { assert!(!VECTORS) };
    stored
}

/// The share of a sum over children that belongs to the next body of the inward pass.
///
/// It is not written to memory, where processors with vectors would wait for a sum that is written
/// in other pieces than it is read. The bits are the same: the last child that adds to a body is
/// the one before it in the pass. Elsewhere the code is shorter without, and this is empty.
pub(crate) struct Passed<A>(Option<A>);

impl<A: Copy + AddAssign> Passed<A> {
    /// Nothing yet.
    pub(crate) const NONE: Self = Self(None);

    /// The complete sum of the body that the pass has come to, which has stored its `own`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn onto<'a>(&mut self, own: &'a A) -> impl Deref<Target = A> + use<'a, A> {
        let passed = if VECTORS { self.0.take() } else { None };
        read(own, move |mut sum| {
            if let Some(passed) = passed {
                sum += passed;
            }
            sum
        })
    }

    /// Adds what the body `i`, `link`, has for the `sum` of its parent.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn add<R: Real>(&mut self, link: &LinkView<'_, R>, i: usize, sum: &mut A, value: A) {
        if VECTORS && link.parent.wrapping_add(1) == i {
            self.0 = Some(value);
        } else {
            *sum += value;
        }
    }
}

/// The sum over the children of the body that an inward pass has come to: [`Passed`], but of a
/// chain, in which a body has one child at most, that child's share, which is not stored.
pub(crate) struct OverChildren<A, T> {
    child: A,
    passed: Passed<A>,
    topology: PhantomData<T>,
}

/// No child of a body of `robot` yet.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn over_children<A, D, R: Real, const B: usize, const Q: usize, const V: usize>(
    _: &D,
    zero: A,
) -> OverChildren<A, Tree<D, R, B, Q, V>>
where
    A: Copy + AddAssign,
    D: RobotModel<R, B, Q, V>,
{
    OverChildren { child: zero, passed: Passed::NONE, topology: PhantomData }
}

impl<A: Copy + AddAssign, T: Topology> OverChildren<A, T> {
    /// The complete sum of the body that the pass has come to, which has stored its `own`.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn onto(&mut self, own: &A) -> A {
        if T::CHAIN {
            let mut sum = *own;
            sum += self.child;
            sum
        } else {
            *self.passed.onto(own)
        }
    }

    /// Adds what `link` has for the `sum` of its parent, one of the bodies `inner` to it.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn add<R: Real, Body>(
        &mut self,
        link: &LinkView<'_, R>,
        inner: &mut [Body],
        sum: impl FnOnce(&mut Body) -> &mut A,
        value: A,
    ) {
        if T::CHAIN {
            self.child = value;
        } else if let (i, Some(parent)) = (inner.len(), inner.get_mut(link.parent)) {
            self.passed.add(link, i, sum(parent), value);
        }
    }
}

/// The inward pass over the results of the outward one.
pub(crate) struct Inward<'a, A>(&'a mut [A]);

/// From the last body to the first.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn inward<A>(bodies: &mut [A]) -> Inward<'_, A> {
    Inward(bodies)
}

impl<'a, A> Inward<'a, A> {
    /// The next body, and those before it, among which is its parent: their count is the body's
    /// number.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn next(&mut self) -> Option<(&'a mut A, &mut [A])> {
        let (body, before) = core::mem::take(&mut self.0).split_last_mut()?;
        self.0 = before;
        Some((body, self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::Passed;
    use crate::Core;
    use crate::algorithms::{aba, crba, rnea};
    use crate::effects::RIGID_BODY;
    use crate::model::{Model, Robot, RobotModel, Static};
    use crate::robots::{A1, G1};
    use crate::scalar::Real;
    use crate::state::State;

    /// The sum of each of the G1's bodies: of its own number and of 1.1 times the sums of its
    /// children.
    fn sums(mut add: impl FnMut(usize, &mut [f64; 29])) -> [u64; 29] {
        // The last body has −0, which a sum with zero would not leave.
        let mut of = core::array::from_fn(|i| if i == 28 { -0.0 } else { (i as f64 - 9.3) * 0.7 });
        (0..29).rev().for_each(|i| add(i, &mut of));
        of.map(f64::to_bits)
    }

    #[test]
    fn sums_that_are_passed_on_have_the_bits_of_memory() {
        let robot = Static::<G1>::NEW;
        let links: [_; 29] = core::array::from_fn(|i| {
            RobotModel::<f64, 29, 29, 29>::link(&robot, i).expect("there is a link")
        });
        let mut passed = Passed::NONE;
        let got = sums(|i, of| {
            let sum = *passed.onto(&of[i]);
            of[i] = sum;
            if let Some(parent) = of.get_mut(links[i].parent) {
                passed.add(&links[i], i, parent, sum * 1.1);
            }
        });
        let want = sums(|i, of| {
            let sum = of[i];
            if let Some(parent) = of.get_mut(links[i].parent) {
                *parent += sum * 1.1;
            }
        });
        assert_eq!(got, want);
    }

    /// The bits of the torques, of the inertia matrix and of the accelerations by a model and by
    /// the robot known at compile time, one of whose positions differs by that many units in the
    /// last place of f32: are they the same?
    fn have_same_bits<R: Real>(a1: &Model<R, 16, 12, 12>, other: u64) -> [bool; 3] {
        let of = |step: f64| core::array::from_fn(|i| R::from_f64(i as f64 * step - 1.3));
        let state = State { q: of(0.31), qd: of(0.47), qdd: of(0.83) };
        let mut y = state;
        y.q[4] = R::from_f64(f64::from_bits(y.q[4].to_f64().to_bits() + (other << 29)));
        let bits = |row: [R; 12]| row.map(|x| x.to_f64().to_bits());
        let tau = rnea(a1, &state, &RIGID_BODY);
        let m = [crba(a1, &state.q, &RIGID_BODY), Core::<A1>::crba(&y.q, &RIGID_BODY)];
        let qdd = [aba(a1, &state, &tau, &RIGID_BODY), Core::<A1>::aba(&y, &tau, &RIGID_BODY)];
        let [m, of_robot] = m.map(|m| m.rows.map(bits));
        [
            bits(tau) == bits(Core::<A1>::rnea(&y, &RIGID_BODY)),
            m == of_robot,
            qdd[0].map(bits) == qdd[1].map(bits),
        ]
    }

    /// It notices a parent that is taken for the body before: `RevoluteOrFixed` with
    /// `CHAIN = true`.
    #[test]
    fn a_tree_with_fixed_joints_read_at_run_time_keeps_its_bits() {
        assert_eq!(have_same_bits::<f64>(&A1::MODEL, 0), [true; 3]);
        assert_eq!(have_same_bits::<f32>(&A1::MODEL_F32, 0), [true; 3]);
        // And a bit of a position, one that no rounding hides.
        assert_eq!(have_same_bits::<f64>(&A1::MODEL, 64), [false; 3]);
        assert_eq!(have_same_bits::<f32>(&A1::MODEL_F32, 64), [false; 3]);
    }
}
