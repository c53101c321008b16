//! Tuples of effects: hooks run in the order of the tuple.

use super::{Effect, JointState};
use crate::effects::delegate::delegate_effect;
use crate::scalar::Real;

macro_rules! tuple {
    ($($name:ident $at:tt),*) => {
        delegate_effect! {
            impl[R: Real, const B: usize, const V: usize, $($name: Effect<R, B, V>),*]
            Effect<R, B, V> for ($($name,)*),
            |this| { $($name => this.$at),* }, advance
        }
    };
}

/// The empty scene.
impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for () {
    const DIFFERENTIABLE: bool = true;
    #[cfg_attr(optimised, inline(always))]
    fn torque(&self, _: usize, _: JointState<R>, _: &mut R) {}
}

tuple!(E0 0);
tuple!(E0 0, E1 1);
tuple!(E0 0, E1 1, E2 2);
tuple!(E0 0, E1 1, E2 2, E3 3);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8, E9 9);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8, E9 9, E10 10);
tuple!(E0 0, E1 1, E2 2, E3 3, E4 4, E5 5, E6 6, E7 7, E8 8, E9 9, E10 10, E11 11);
