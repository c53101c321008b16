//! Ways to compute inverse dynamics, from the most accurate to the cheapest, each a type: what
//! `cargo xtask accuracy` runs on the target for their cost and on the host for their error.
//!
//! The bins `accuracy_…` log a row of the algorithm `inverse` or `simulation` for each, its inputs
//! the way's name; the host's bin `accuracy` prints a line of JSON for each under the same name. A
//! call of a row is a tick or a step.
//!
//! | module | what |
//! |---|---|
//! | [`key`] | the name of a way, the same on target and host |
//! | [`model`], [`form`], [`kernels`] | what is computed, by which form, with whose sines and cosines |
//! | [`inverse`] | ways that compute in every tick, in f32 and f64 |
//! | [`multirate`] | ways that compute in every few ticks |
//! | [`simulation`], [`passive_motion`] | ways to simulate, and what |
//! | [`list`], [`robots`] | all of them; whose they are |

/// Ways: their generics but N, their types and keys, what else they have, what a tick is given and
/// the numbers that it gives, what they start with, and a tick.
macro_rules! inverse {
    ($([$($generics:tt)*] $way:ty, $key:expr, { $($more:tt)* }, $input:ty = |$at:ident| $given:expr, $scalar:ty,
       |$first:pat_param| $start:expr, #[$inline:meta] |$self:ident, $now:ident| $tick:expr;)*) => {$(
        impl<$($generics)*, const N: usize> Inverse<N> for $way {
            const KEY: Key = $key;
            $($more)*
            type Input = $input;
            type Scalar = $scalar;

            fn start($first: &State<f32, N, N>) -> Self {
                $start
            }
            fn input($at: &State<f32, N, N>) -> Self::Input {
                $given
            }
            #[$inline]
            fn tick(&mut $self, $now: &Self::Input) -> [$scalar; N] {
                $tick
            }
        }
    )*};
}

pub mod form;
pub mod inverse;
pub mod kernels;
pub mod key;
pub mod list;
pub mod model;
pub mod multirate;
pub mod passive_motion;
pub mod robots;
pub mod simulation;

use dynamics_core::scalar::Real;
use dynamics_core::state::State;

use key::Key;

/// A way to compute the torques of N joints, tick by tick.
pub trait Inverse<const N: usize>: Sized {
    const KEY: Key;
    /// It remembers the ticks before: it has to be run along a way.
    const MEMORY: bool = false;
    /// A tick is given where the joints are to be so many ticks later.
    const AHEAD: usize = 0;
    /// The input of a tick: a state, in the numbers that it computes with.
    type Input;
    /// The numbers of the torques.
    type Scalar: Real;

    /// Before the first tick, which will be that of this state.
    fn start(first: &State<f32, N, N>) -> Self;
    /// The reference of the joints, in its own numbers, which a firmware of this kind would have
    /// computed with so far.
    fn input(state: &State<f32, N, N>) -> Self::Input;
    fn tick(&mut self, input: &Self::Input) -> [Self::Scalar; N];
    /// The address of the function that a tick is, or calls.
    fn address() -> usize {
        Self::tick as fn(&mut Self, &Self::Input) -> [Self::Scalar; N] as usize
    }
}

/// Visits each configuration.
pub trait Visitor<const N: usize> {
    fn way<W: Inverse<N>>(&mut self);
}
