//! This library's forms.

use std::hint::black_box;

use dynamics_core::algorithms;
use dynamics_core::effects::{Coriolis, Effect, Gravity, RIGID_BODY};
use dynamics_core::model::{Model, Robot, model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine, MassMatrix};

use crate::subject::{Subject, square};

/// Ours of an algorithm, on these states.
pub type Subjects<R, const N: usize> = fn(&str, &[State<R, N, N>]) -> Vec<Subject<R>>;

const BIAS: (Gravity, Coriolis) = (Gravity::EARTH, Coriolis);
const GRAVITY: (Gravity,) = (Gravity::EARTH,);

/// The core over a model known at run time, of which the compiler knows nothing.
pub fn run_time<T: Robot<B, N, N>, R: Real, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>> {
    const PEER: &str = "core run-time model";
    let model: Box<Model<R, B, N, N>> = black_box(Box::new(*model::<R, T, B, N, N>()));
    vec![match algorithm {
        "rnea" => rows(PEER, states, move |s| {
            algorithms::rnea(&*model, s, &RIGID_BODY)
        }),
        "bias" => rows(PEER, states, move |s| algorithms::rnea(&*model, s, &BIAS)),
        "gravity" => rows(PEER, states, move |s| {
            algorithms::rnea(&*model, s, &GRAVITY)
        }),
        "crba" => squares(PEER, states, move |s| {
            algorithms::crba(&*model, &s.q, &RIGID_BODY)
        }),
        _ => rows(PEER, states, move |s| {
            algorithms::aba(&*model, s, &s.qdd, &RIGID_BODY).expect("M > 0")
        }),
    }]
}

/// Core and engine of a robot known while compiling: inverse dynamics.
pub fn inverse<T: Robot<B, N, N>, R: Real, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>> {
    match algorithm {
        "rnea" => under::<T, R, _, B, N>(states, &RIGID_BODY),
        "bias" => under::<T, R, _, B, N>(states, &BIAS),
        "gravity" => under::<T, R, _, B, N>(states, &GRAVITY),
        _ => Vec::new(),
    }
}

/// The same, with M and forward dynamics.
pub fn all<T: Robot<B, N, N>, R: Real, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>> {
    match algorithm {
        "crba" => vec![
            squares("core", states, |s| Core::<T>::crba(&s.q, &RIGID_BODY)),
            squares("engine", states, |s| Engine::<T>::crba(&s.q, &RIGID_BODY)),
        ],
        "aba" => vec![
            rows("core", states, |s| {
                Core::<T>::aba(s, &s.qdd, &RIGID_BODY).expect("M > 0")
            }),
            rows("engine", states, |s| {
                Engine::<T>::forward_dynamics(s, &s.qdd, &RIGID_BODY).expect("M > 0")
            }),
        ],
        _ => inverse::<T, R, B, N>(algorithm, states),
    }
}

fn under<T: Robot<B, N, N>, R: Real, E: Effect<R, B, N>, const B: usize, const N: usize>(
    states: &[State<R, N, N>],
    effects: &'static E,
) -> Vec<Subject<R>> {
    vec![
        rows("core", states, |s| Core::<T>::rnea(s, effects)),
        rows("engine", states, |s| Engine::<T>::rnea(s, effects)),
    ]
}

/// A function that gives N numbers a state.
pub fn rows<R: Real, S: Clone + 'static, const N: usize>(
    peer: &str,
    states: &[S],
    call: impl Fn(&S) -> [R; N] + 'static,
) -> Subject<R> {
    let states = states.to_vec();
    let run = move |out: &mut [R]| {
        for (out, state) in std::iter::zip(out.as_chunks_mut().0, &states) {
            *out = call(state);
        }
    };
    Subject::new(peer, Box::new(run), (0..N).map(Some).collect())
}

/// A function that gives M, which is written by rows.
fn squares<R: Real, const N: usize>(
    peer: &str,
    states: &[State<R, N, N>],
    call: impl Fn(&State<R, N, N>) -> MassMatrix<R, N> + 'static,
) -> Subject<R> {
    let states = states.to_vec();
    let run = move |out: &mut [R]| {
        for (rows, state) in std::iter::zip(out.as_chunks_mut::<N>().0.chunks_mut(N), &states) {
            let m = call(state);
            for (i, row) in rows.iter_mut().enumerate() {
                row.copy_from_slice(m.row(i).map_or(&[], |row| row));
            }
        }
    };
    Subject::new(peer, Box::new(run), square(&(0..N).collect::<Vec<_>>()))
}
