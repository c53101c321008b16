//! This library's forms.

use std::hint::black_box;

use dynamics_core::algorithms;
use dynamics_core::effects::{Coriolis, Effect, Gravity, RIGID_BODY};
use dynamics_core::model::{Model, Robot, model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

use crate::subject::{Subject, square};

/// The core over a model that the compiler knows nothing of.
const RUN_TIME: &str = "core run-time model";

/// The core over a model known at run time.
pub fn run_time<T, R, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
{
    let model: Box<Model<R, B, N, N>> = black_box(Box::new(*model::<R, T, B, N, N>()));
    let states = states.to_vec();
    vec![match algorithm {
        "rnea" => run_time_rnea(model, states, &RIGID_BODY),
        "bias" => run_time_rnea(model, states, &(Gravity::EARTH, Coriolis)),
        "gravity" => run_time_rnea(model, states, &(Gravity::EARTH,)),
        "crba" => squares::<R, N>(RUN_TIME, move |out| {
            for (m, state) in std::iter::zip(out.chunks_mut(N), &states) {
                let found = algorithms::crba(&*model, &state.q, &RIGID_BODY);
                copy(&found, m);
            }
        }),
        _ => rows::<R, N>(RUN_TIME, move |out| {
            for (qdd, state) in std::iter::zip(out, &states) {
                *qdd = algorithms::aba(&*model, state, &state.qdd, &RIGID_BODY).expect("M > 0");
            }
        }),
    }]
}

fn run_time_rnea<R: Real, E: Effect<R, B, N>, const B: usize, const N: usize>(
    model: Box<Model<R, B, N, N>>,
    states: Vec<State<R, N, N>>,
    effects: &'static E,
) -> Subject<R> {
    rows::<R, N>(RUN_TIME, move |out| {
        for (tau, state) in std::iter::zip(out, &states) {
            *tau = algorithms::rnea(&*model, state, effects);
        }
    })
}

/// Core and engine of a robot known while compiling: inverse dynamics.
pub fn inverse<T, R, const B: usize, const N: usize>(
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

/// The same, with M and forward dynamics.
pub fn all<T, R, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
{
    let (of_core, of_engine) = (states.to_vec(), states.to_vec());
    match algorithm {
        "crba" => vec![
            squares::<R, N>("core", move |out| {
                for (m, state) in std::iter::zip(out.chunks_mut(N), &of_core) {
                    copy(&Core::<T>::crba(&state.q, &RIGID_BODY), m);
                }
            }),
            squares::<R, N>("engine", move |out| {
                for (m, state) in std::iter::zip(out.chunks_mut(N), &of_engine) {
                    copy(&Engine::<T>::crba(&state.q, &RIGID_BODY), m);
                }
            }),
        ],
        "aba" => vec![
            rows::<R, N>("core", move |out| {
                for (qdd, state) in std::iter::zip(out, &of_core) {
                    *qdd = Core::<T>::aba(state, &state.qdd, &RIGID_BODY).expect("M > 0");
                }
            }),
            rows::<R, N>("engine", move |out| {
                for (qdd, state) in std::iter::zip(out, &of_engine) {
                    *qdd = Engine::<T>::forward_dynamics(state, &state.qdd, &RIGID_BODY)
                        .expect("M > 0");
                }
            }),
        ],
        _ => inverse::<T, R, B, N>(algorithm, states),
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
        rows::<R, N>("core", move |out| {
            for (tau, state) in std::iter::zip(out, &of_core) {
                *tau = Core::<T>::rnea(state, effects);
            }
        }),
        rows::<R, N>("engine", move |out| {
            for (tau, state) in std::iter::zip(out, &of_engine) {
                *tau = Engine::<T>::rnea(state, effects);
            }
        }),
    ]
}

fn copy<R: Real, const N: usize>(m: &dynamics_core::MassMatrix<R, N>, rows: &mut [[R; N]]) {
    for (i, row) in rows.iter_mut().enumerate() {
        if let Some(found) = m.row(i) {
            *row = *found;
        }
    }
}

/// A function that writes N numbers a state.
fn rows<R: Real, const N: usize>(
    peer: &str,
    mut run: impl FnMut(&mut [[R; N]]) + 'static,
) -> Subject<R> {
    Subject {
        peer: peer.to_owned(),
        run: Box::new(move |out| run(out.as_chunks_mut().0)),
        outputs: N,
        order: (0..N).map(Some).collect(),
        timed: true,
        gravity: 1.0,
    }
}

/// A function that writes M by rows.
fn squares<R: Real, const N: usize>(
    peer: &str,
    run: impl FnMut(&mut [[R; N]]) + 'static,
) -> Subject<R> {
    Subject {
        outputs: N * N,
        order: square(&std::array::from_fn::<usize, N, _>(|i| i)),
        ..rows(peer, run)
    }
}
