//! The ways to compute inverse dynamics that docs/accuracy.md compares: those that compute in every
//! tick, by their keys.

use dynamics_core::model::{Pruned, Robot};
use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use dynamics_core::state::State;
use dynamics_core::trig::{Minimax, Table};
use dynamics_core::{Core, Engine};
use fixtures::accuracy::Inverse;
use fixtures::accuracy::inverse::{By, In};
use fixtures::accuracy::model::{Full, GravityOnly, NoCoriolis, Without};

use crate::machine::Motion;

type Coarse = Table<256, 1>;

/// Torques by every way of a list, until one has the key.
macro_rules! by_key {
    ($wanted:expr, $state:expr, $n:expr; $($way:ty),* $(,)?) => {{
        $(if <$way as Inverse<$n>>::KEY.to_string() == $wanted {
            return Some(torque::<$way, $n>($state));
        })*
        None
    }};
}

fn torque<W: Inverse<N>, const N: usize>(state: &State<f32, N, N>) -> Vec<f64> {
    use dynamics_core::scalar::Real as _;
    let torque = W::start(state).tick(&W::input(state));
    torque.iter().map(|x| x.to_f64()).collect()
}

fn of<T: Robot<B, N, N>, const B: usize, const N: usize>(
    key: &str,
    state: &State<f32, N, N>,
) -> Option<Vec<f64>> {
    by_key! { key, state, N;
        In<f32, Full<T>, Engine<T>, B>,
        In<f64, Full<T>, Engine<T>, B>,
        By<f32, Table<128, 3, 4>, Full<T>, Engine<T>, B>,
        By<f32, Minimax<7, 2>, Full<T>, Engine<T>, B>,
        By<f32, Minimax<5, 2>, Full<T>, Engine<T>, B>,
        By<f32, Minimax<3, 2>, Full<T>, Engine<T>, B>,
        By<f32, Table<64, 4>, Full<T>, Engine<T>, B>,
        By<f32, Table<256, 2>, Full<T>, Engine<T>, B>,
        By<f32, Coarse, Full<T>, Engine<T>, B>,
        In<f32, Without<T, 100>, Engine<Pruned<T, 100>>, B>,
        In<f32, Without<T, 1000>, Engine<Pruned<T, 1000>>, B>,
        By<f32, Coarse, Without<T, 1000>, Engine<Pruned<T, 1000>>, B>,
        By<f32, Coarse, Without<T, 3000>, Engine<Pruned<T, 3000>>, B>,
        By<f32, Coarse, Without<T, 10_000>, Engine<Pruned<T, 10_000>>, B>,
        By<f32, Coarse, Without<T, 30_000>, Engine<Pruned<T, 30_000>>, B>,
        In<f32, NoCoriolis<T>, Engine<T>, B>,
        By<f32, Coarse, NoCoriolis<T>, Engine<T>, B>,
        In<f32, GravityOnly<T>, Engine<T>, B>,
        By<f32, Table<256, 2>, GravityOnly<T>, Engine<T>, B>,
        By<f32, Coarse, GravityOnly<T>, Engine<T>, B>,
        By<f32, Minimax<7, 2>, Full<T>, Core<T>, B>,
        In<f32, Full<T>, Core<T>, B>,
    }
}

/// The torque of a robot in a state by the way of a key, which leaves out the level of
/// optimisation; none if this page does not have that way, or the robot no recorded front.
pub fn by(robot: &str, key: &str, motion: &Motion) -> Option<Vec<f64>> {
    fn state<const N: usize>(motion: &Motion) -> State<f32, N, N> {
        let row = |xs: &[f64]| std::array::from_fn(|i| xs.get(i).map_or(0.0, |&x| x as f32));
        State { q: row(&motion.q), qd: row(&motion.qd), qdd: row(&motion.qdd) }
    }
    match robot {
        "ur5e" => of::<Ur5e, 6, 6>(key, &state(motion)),
        "panda" => of::<Panda, 7, 7>(key, &state(motion)),
        "a1_leg" => of::<A1Leg, 4, 3>(key, &state(motion)),
        _ => None,
    }
}
