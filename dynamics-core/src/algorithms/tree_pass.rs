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
    use crate::Core;
    use crate::algorithms::{aba, crba, rnea};
    use crate::effects::RIGID_BODY;
    use crate::model::{Model, Robot};
    use crate::robots::A1;
    use crate::scalar::Real;
    use crate::state::State;

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

    /// It notices a parent that is taken for the body before: a `Model` with `CHAIN = true`.
    #[test]
    fn a_tree_with_fixed_joints_read_at_run_time_keeps_its_bits() {
        assert_eq!(have_same_bits::<f64>(&A1::MODEL, 0), [true; 3]);
        assert_eq!(have_same_bits::<f32>(&A1::MODEL_F32, 0), [true; 3]);
        // And a bit of a position, one that no rounding hides.
        assert_eq!(have_same_bits::<f64>(&A1::MODEL, 64), [false; 3]);
        assert_eq!(have_same_bits::<f32>(&A1::MODEL_F32, 64), [false; 3]);
    }
}
