//! Random states with closed loops.

use dynamics_core::loops::{Moving, assemble, coordinate_map};
use dynamics_core::model::Static;
use dynamics_core::state::State;
use host_tests::random::{random_numbers, within};

use crate::machines::Machine;

/// States with closed loops: the actuated coordinates are random, rates within 2 and accelerations
/// within 10 (of all coordinates, of which inverse dynamics reads the independent ones).
pub fn closed_states<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    count: usize,
) -> Vec<State<f64, Q, V>>
where
    T: Machine<B, Q, V, L, C, A>,
{
    let mut rng = random_numbers();
    let robot = Static::<T>::NEW;
    let states = std::iter::repeat_with(|| {
        let mut guess = T::HOME;
        for (at, off) in T::ACTUATED_Q.into_iter().zip(within::<A>(&mut rng, T::RANGE)) {
            guess[at] += off;
        }
        let closed = assemble(&robot, &T::LOOPS, &guess, Moving::Passive).expect("it closes");
        let map = coordinate_map(&robot, &T::LOOPS, &closed.q).expect("it is driven");
        State { q: closed.q, qd: map.velocity(&within(&mut rng, 2.0)), qdd: within(&mut rng, 10.0) }
    });
    states.take(count).collect()
}
