//! Closed states of robots with kinematic loops.

use dynamics_core::loops::{LoopRobot, Moving, assemble};
use dynamics_core::model::Static;
use dynamics_core::state::State;
use firmware_demo::robots::Delta;
use firmware_demo::robots::planar_loops::{FiveBar, FourBar};

use crate::costs::row::numbers;

pub fn four_bar<const N: usize>() -> [State<f32, 3, 3>; N] {
    states::<FourBar, 3, 3, 3, 1, 5, 1, N>([-1.0, 0.5, -1.5], ([0], 0.6))
}

pub fn five_bar<const N: usize>() -> [State<f32, 4, 4>; N] {
    states::<FiveBar, 4, 4, 4, 1, 5, 2, N>([-2.2, 1.2, -0.9, -1.2], ([0, 2], 0.4))
}

pub fn delta<const N: usize>() -> [State<f32, 22, 21>; N] {
    let mut home = [0.0; 22];
    (home[3], home[6]) = (1.0, -0.33);
    for first in [7, 12, 17] {
        (home[first], home[first + 1], home[first + 3]) = (0.2, 0.7, 0.7);
    }
    states::<Delta, 10, 22, 21, 6, 18, 3, N>(home, ([7, 12, 17], 0.4))
}

/// States near a configuration, by motors that are moved within `range` of theirs; the velocities
/// do not fit the loops.
fn states<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
    const N: usize,
>(
    home: [f32; Q],
    (motors, range): ([usize; A], f32),
) -> [State<f32, Q, V>; N]
where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let mut number = numbers();
    [(); N].map(|()| {
        let mut guess = home;
        for at in motors {
            guess[at] += number(range);
        }
        let closed = assemble(&Static::<T>::NEW, &T::LOOPS, &guess, Moving::Passive);
        State {
            q: match closed {
                Ok(closed) => closed.q,
                Err(_) => defmt::panic!("a loop does not close"),
            },
            qd: [(); V].map(|()| number(2.0)),
            qdd: [(); V].map(|()| number(10.0)),
        }
    })
}
