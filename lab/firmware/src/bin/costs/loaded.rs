//! The engine with base parameters that are loaded at run time.

use dynamics_core::Engine;
use dynamics_core::algorithms::{MassMatrix, NotPositiveDefinite};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Calibrated, Robot};
use dynamics_core::state::State;

use super::inverse::{Inside, Precomputed};
use super::row::Row;
use super::{Ask, STATES};

type Crba<E, const N: usize> = fn(&[f32; N], &E) -> MassMatrix<f32, N>;
type Solution<const N: usize> = Result<[f32; N], NotPositiveDefinite>;
type Aba<'a, E, const N: usize> = fn(&'a State<f32, N, N>, &[f32; N], &E) -> Solution<N>;

/// Measures inverse dynamics, M and forward dynamics.
pub fn engine<T: Robot<B, N, N>, const B: usize, const N: usize>(asks: &[Ask<N>; STATES]) {
    let arm = Calibrated::<T, f32, B, N, N>::nominal();
    let Ok(set) = Engine::<T>::base_parameters(&arm, &()) else {
        return;
    };
    let scene = &(RIGID_BODY, set);
    let row = |algorithm, trig| Row::of::<T, B, N>(algorithm, "engine", "loaded", trig);
    let run: Inside<'_, _, N> = Engine::<T>::rnea;
    row("rnea", true).measure(run as usize, asks, |ask| run(&ask.state, scene));
    let run: Precomputed<'_, _, N> = Engine::<T>::rnea;
    row("rnea", false).measure(run as usize, asks, |ask| run(ask.trig.with(&ask.state), scene));
    let run: Crba<_, N> = Engine::<T>::crba;
    row("crba", true).measure(run as usize, asks, |ask| run(&ask.state.q, scene));
    let run: Aba<'_, _, N> = Engine::<T>::aba;
    row("aba", true).measure(run as usize, asks, |ask| run(&ask.state, &ask.state.qdd, scene));
}
