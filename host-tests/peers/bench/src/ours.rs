//! This library's two forms.

use dynamics_core::effects::{Coriolis, Effect, Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

use crate::subject::Subject;

/// Core and engine for one of `rnea`, `bias` and `gravity`; nothing for what they lack.
pub fn subjects<T, R, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
{
    match algorithm {
        "rnea" => under::<T, R, _, B, N>(states, &RIGID_BODY),
        "bias" => under::<T, R, _, B, N>(states, &(Gravity::EARTH, Coriolis)),
        "gravity" => under::<T, R, _, B, N>(states, &(Gravity::EARTH,)),
        _ => Vec::new(),
    }
}

fn under<T, R, E, const B: usize, const N: usize>(
    states: &[State<R, N, N>],
    effects: &'static E,
) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
    E: Effect<R, B, N>,
{
    let (of_core, of_engine) = (states.to_vec(), states.to_vec());
    vec![
        subject::<R, N>("core", move |out| {
            for (tau, state) in std::iter::zip(out, &of_core) {
                *tau = Core::<T>::rnea(state, effects);
            }
        }),
        subject::<R, N>("engine", move |out| {
            for (tau, state) in std::iter::zip(out, &of_engine) {
                *tau = Engine::<T>::rnea(state, effects);
            }
        }),
    ]
}

fn subject<R: Real, const N: usize>(
    peer: &str,
    mut run: impl FnMut(&mut [[R; N]]) + 'static,
) -> Subject<R> {
    Subject {
        peer: peer.to_owned(),
        run: Box::new(move |out| run(out.as_chunks_mut().0)),
        outputs: N,
        order: (0..N).collect(),
        timed: true,
        gravity: 1.0,
    }
}
