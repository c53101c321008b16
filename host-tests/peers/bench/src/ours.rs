//! This library's two forms, and its core over a model that is known only at run time.

use std::hint::black_box;

use dynamics_core::algorithms::{aba, crba, rnea};
use dynamics_core::effects::{Coriolis, Effect, Gravity, RIGID_BODY};
use dynamics_core::model::{Model, Robot, model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine, MassMatrix};

use crate::subject::Subject;

/// The core over a run-time model.
const AT_RUN_TIME: &str = "core at run time";

/// What we have for an algorithm.
pub fn subjects<T, R, const B: usize, const N: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
{
    match algorithm {
        "rnea" => inverse::<T, R, _, B, N>(states, &RIGID_BODY),
        "bias" => inverse::<T, R, _, B, N>(states, &(Gravity::EARTH, Coriolis)),
        "gravity" => inverse::<T, R, _, B, N>(states, &(Gravity::EARTH,)),
        "crba" => matrix::<T, R, B, N>(states),
        "aba" => forward::<T, R, B, N>(states),
        _ => Vec::new(),
    }
}

/// The robot's numbers, of which the compiler knows nothing.
fn unknown<T, R, const B: usize, const N: usize>() -> &'static Model<R, B, N, N>
where
    T: Robot<B, N, N>,
    R: Real,
{
    black_box(model::<R, T, B, N, N>())
}

fn inverse<T, R, E, const B: usize, const N: usize>(
    states: &[State<R, N, N>],
    effects: &'static E,
) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
    E: Effect<R, B, N>,
{
    let model = unknown::<T, R, B, N>();
    vec![
        subject(states, "core", N, move |state, tau| {
            tau.copy_from_slice(&Core::<T>::rnea(state, effects));
        }),
        subject(states, AT_RUN_TIME, N, move |state, tau| {
            tau.copy_from_slice(&rnea(model, state, effects));
        }),
        subject(states, "engine", N, move |state, tau| {
            tau.copy_from_slice(&Engine::<T>::rnea(state, effects));
        }),
    ]
}

fn matrix<T, R, const B: usize, const N: usize>(states: &[State<R, N, N>]) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
{
    let (model, outputs) = (unknown::<T, R, B, N>(), N * (N + 1) / 2);
    vec![
        subject(states, "core", outputs, |state, out| {
            upper(&Core::<T>::crba(&state.q, &RIGID_BODY), out);
        }),
        subject(states, AT_RUN_TIME, outputs, move |state, out| {
            upper(&crba(model, &state.q, &RIGID_BODY), out);
        }),
        subject(states, "engine", outputs, |state, out| {
            upper(&Engine::<T>::crba(&state.q, &RIGID_BODY), out);
        }),
    ]
}

/// The upper triangle, by rows.
fn upper<R: Real, const N: usize>(m: &MassMatrix<R, N>, mut out: &mut [R]) {
    for i in 0..N {
        let Some((row, rest)) = out.split_at_mut_checked(N - i) else {
            break;
        };
        row.copy_from_slice(m.row(i).map_or(&[], |row| &row[i..]));
        out = rest;
    }
}

/// Forward dynamics; the torque stands in the place of q̈.
fn forward<T, R, const B: usize, const N: usize>(states: &[State<R, N, N>]) -> Vec<Subject<R>>
where
    T: Robot<B, N, N>,
    R: Real,
{
    let model = unknown::<T, R, B, N>();
    vec![
        subject(states, "core", N, |state, qdd| {
            let result = Core::<T>::aba(state, &state.qdd, &RIGID_BODY);
            qdd.copy_from_slice(&result.expect("M is positive definite"));
        }),
        subject(states, AT_RUN_TIME, N, move |state, qdd| {
            let result = aba(model, state, &state.qdd, &RIGID_BODY);
            qdd.copy_from_slice(&result.expect("M is positive definite"));
        }),
        // Its quickest way: M and its factors.
        subject(states, "engine", N, |state, qdd| {
            let result = Engine::<T>::forward(state, &state.qdd, &RIGID_BODY);
            qdd.copy_from_slice(&result.expect("M is positive definite"));
        }),
    ]
}

fn subject<R: Real, const N: usize>(
    states: &[State<R, N, N>],
    peer: &str,
    outputs: usize,
    of: impl Fn(&State<R, N, N>, &mut [R]) + 'static,
) -> Subject<R> {
    let states = states.to_vec();
    Subject {
        peer: peer.to_owned(),
        run: Box::new(move |out| {
            for (out, state) in std::iter::zip(out.chunks_exact_mut(outputs), &states) {
                of(state, out);
            }
        }),
        outputs,
        order: (0..outputs).collect(),
        timed: true,
        gravity: 1.0,
    }
}
