//! This library's two forms.

use dynamics_core::effects::{Coriolis, Effect, Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

use crate::subject::Subject;

/// Core and engine for one of `rnea`, `bias` and `gravity`; the engine's `crba`, and for `aba` its
/// `forward`, with torques in the place of q̈.
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
        "crba" => {
            let states = states.to_vec();
            let mut triangle = subject::<R, N>("engine", move |out| {
                for (row, state) in out.chunks_exact_mut(N * (N + 1) / 2).zip(&states) {
                    let m = Engine::<T>::crba(&state.q, &RIGID_BODY);
                    let upper = (0..N).flat_map(|i| (i..N).map(move |j| (i, j)));
                    for (out, (i, j)) in row.iter_mut().zip(upper) {
                        *out = m.get(i, j);
                    }
                }
            });
            triangle.outputs = N * (N + 1) / 2;
            triangle.order = (0..triangle.outputs).collect();
            vec![triangle]
        }
        "aba" => {
            let states = states.to_vec();
            vec![subject::<R, N>("engine", move |out| {
                for (qdd, state) in out.as_chunks_mut::<N>().0.iter_mut().zip(&states) {
                    let forward = Engine::<T>::forward(state, &state.qdd, &RIGID_BODY);
                    *qdd = forward.unwrap_or([R::from_f64(f64::NAN); N]);
                }
            })]
        }
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
            for (tau, state) in std::iter::zip(out.as_chunks_mut().0, &of_core) {
                *tau = Core::<T>::rnea(state, effects);
            }
        }),
        subject::<R, N>("engine", move |out| {
            for (tau, state) in std::iter::zip(out.as_chunks_mut().0, &of_engine) {
                *tau = Engine::<T>::rnea(state, effects);
            }
        }),
    ]
}

fn subject<R: Real, const N: usize>(peer: &str, run: impl FnMut(&mut [R]) + 'static) -> Subject<R> {
    Subject {
        peer: peer.to_owned(),
        run: Box::new(run),
        outputs: N,
        order: (0..N).collect(),
        timed: true,
        gravity: 1.0,
    }
}
