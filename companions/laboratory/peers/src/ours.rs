//! This library's forms.

use std::hint::black_box;
use std::marker::PhantomData;

use dynamics_core::algorithms::frame::Local;
use dynamics_core::algorithms::{self, NotPositiveDefinite, OsimInverse, TorqueGradient};
use dynamics_core::effects::{Coriolis, Gravity, RIGID_BODY};
use dynamics_core::model::{Model, OnBody, Robot, model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine, MassMatrix};

use crate::subject::{Subject, square};

/// Ours of an algorithm, on these states.
pub type Subjects<R, const Q: usize, const V: usize> =
    fn(&str, &[State<R, Q, V>]) -> Vec<Subject<R>>;

const BIAS: (Gravity, Coriolis) = (Gravity::EARTH, Coriolis);
const GRAVITY: (Gravity,) = (Gravity::EARTH,);

/// The robot T of B bodies, with those on fixed joints as parts of the bodies that carry them:
/// Pinocchio merges them when it reads a model.
pub struct Merged<T, const B: usize>(PhantomData<T>);

impl<T, const B: usize, const M: usize, const Q: usize, const V: usize> Robot<M, Q, V>
    for Merged<T, B>
where
    T: Robot<B, Q, V>,
{
    const MODEL: Model<f64, M, Q, V> = T::MODEL.merged().model;
}

/// The core over a model known at run time, of which the compiler knows nothing.
pub fn run_time<T: Robot<B, Q, V>, R: Real, const B: usize, const Q: usize, const V: usize>(
    algorithm: &str,
    states: &[State<R, Q, V>],
) -> Vec<Subject<R>> {
    const PEER: &str = "core run-time model";
    let model: Box<Model<R, B, Q, V>> = black_box(Box::new(*model::<R, T, B, Q, V>()));
    vec![match algorithm {
        "rnea" => rows(PEER, states, move |s| algorithms::rnea(&*model, s, &RIGID_BODY)),
        "bias" => rows(PEER, states, move |s| algorithms::rnea(&*model, s, &BIAS)),
        "gravity" => rows(PEER, states, move |s| algorithms::rnea(&*model, s, &GRAVITY)),
        "crba" => squares(PEER, states, move |s| algorithms::crba(&*model, &s.q, &RIGID_BODY)),
        "gradient" => {
            gradients(PEER, states, move |s| algorithms::rnea_derivatives(&*model, s, &RIGID_BODY))
        }
        "osim" => tips(PEER, states, move |s| {
            algorithms::osim_inverse(&*model, &s.q, B - 1, Local, &RIGID_BODY)
        }),
        _ => rows(PEER, states, move |s| {
            algorithms::aba(&*model, s, &s.qdd, &RIGID_BODY).expect("M > 0")
        }),
    }]
}

/// Core and engine of a robot known while compiling: inverse dynamics.
pub fn inverse<T: Robot<B, Q, V>, R: Real, const B: usize, const Q: usize, const V: usize>(
    algorithm: &str,
    states: &[State<R, Q, V>],
) -> Vec<Subject<R>> {
    // The scene is a constant of each call, as in firmware.
    match algorithm {
        "rnea" => vec![
            rows("core", states, |s| Core::<T>::rnea(s, &RIGID_BODY)),
            rows("engine", states, |s| Engine::<T>::rnea(s, &RIGID_BODY)),
        ],
        "bias" => vec![
            rows("core", states, |s| Core::<T>::rnea(s, &BIAS)),
            rows("engine", states, |s| Engine::<T>::rnea(s, &BIAS)),
        ],
        "gravity" => vec![
            rows("core", states, |s| Core::<T>::rnea(s, &GRAVITY)),
            rows("engine", states, |s| Engine::<T>::rnea(s, &GRAVITY)),
        ],
        _ => Vec::new(),
    }
}

/// Inverse dynamics and its derivatives, of a robot of revolute joints.
pub fn tree<T: Robot<B, Q, V>, R: Real, const B: usize, const Q: usize, const V: usize>(
    algorithm: &str,
    states: &[State<R, Q, V>],
) -> Vec<Subject<R>> {
    match algorithm {
        "gradient" => {
            vec![gradients("engine", states, |s| Engine::<T>::rnea_derivatives(s, &RIGID_BODY))]
        }
        _ => inverse::<T, R, B, Q, V>(algorithm, states),
    }
}

/// Inverse dynamics under all effects, M and forward dynamics.
pub fn dynamics<T: Robot<B, Q, V>, R: Real, const B: usize, const Q: usize, const V: usize>(
    algorithm: &str,
    states: &[State<R, Q, V>],
) -> Vec<Subject<R>> {
    match algorithm {
        "rnea" => inverse::<T, R, B, Q, V>(algorithm, states),
        "crba" => vec![
            squares("core", states, |s| Core::<T>::crba(&s.q, &RIGID_BODY)),
            squares("engine", states, |s| Engine::<T>::crba(&s.q, &RIGID_BODY)),
        ],
        "aba" => vec![
            rows("core", states, |s| Core::<T>::aba(s, &s.qdd, &RIGID_BODY).expect("M > 0")),
            rows("engine", states, |s| {
                Engine::<T>::forward_dynamics(s, &s.qdd, &RIGID_BODY).expect("M > 0")
            }),
        ],
        _ => Vec::new(),
    }
}

/// All of an arm with this body at its tip.
pub fn arm<T: Robot<B, N, N>, R: Real, const B: usize, const N: usize, const TIP: usize>(
    algorithm: &str,
    states: &[State<R, N, N>],
) -> Vec<Subject<R>> {
    let tip = OnBody::<TIP>;
    match algorithm {
        "crba" | "aba" => dynamics::<T, R, B, N, N>(algorithm, states),
        "osim" => vec![
            tips("core", states, move |s| Core::<T>::osim_inverse(&s.q, tip, Local, &RIGID_BODY)),
            tips("engine", states, move |s| {
                Engine::<T>::osim_inverse(&s.q, tip, Local, &RIGID_BODY)
            }),
        ],
        _ => tree::<T, R, B, N, N>(algorithm, states),
    }
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

/// A function that gives ∂τ/∂q and ∂τ/∂q̇, each by rows.
fn gradients<R: Real, const Q: usize, const N: usize>(
    peer: &str,
    states: &[State<R, Q, N>],
    call: impl Fn(&State<R, Q, N>) -> TorqueGradient<R, N> + 'static,
) -> Subject<R> {
    let states = states.to_vec();
    let run = move |out: &mut [R]| {
        for (out, by) in std::iter::zip(out.chunks_mut(2 * N * N), states.iter().map(&call)) {
            out[..N * N].copy_from_slice(by.dq.as_flattened());
            out[N * N..].copy_from_slice(by.dqd.as_flattened());
        }
    };
    Subject::new(peer, Box::new(run), (0..2 * N * N).map(Some).collect())
}

/// A function that gives M, which is written by rows.
fn squares<R: Real, const Q: usize, const N: usize>(
    peer: &str,
    states: &[State<R, Q, N>],
    call: impl Fn(&State<R, Q, N>) -> MassMatrix<R, N> + 'static,
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

/// A function that gives Λ⁻¹, of which a user takes columns: here all.
fn tips<R: Real, const Q: usize, const V: usize>(
    peer: &str,
    states: &[State<R, Q, V>],
    call: impl Fn(&State<R, Q, V>) -> Result<OsimInverse<R>, NotPositiveDefinite> + 'static,
) -> Subject<R> {
    let unit = |k| {
        let e = |j| if j == k { R::ONE } else { R::ZERO };
        Force::new(R::Vec3::new(e(0), e(1), e(2)), R::Vec3::new(e(3), e(4), e(5)))
    };
    let units: [Force<R>; 6] = std::array::from_fn(unit);
    let columns = rows(peer, states, move |s| {
        let mobility = call(s).expect("M > 0");
        let mut columns = [R::ZERO; 36];
        for (column, f) in std::iter::zip(columns.as_chunks_mut::<6>().0, &units) {
            let a = mobility * *f;
            column[..3].copy_from_slice(&a.ang.array());
            column[3..].copy_from_slice(&a.lin.array());
        }
        columns
    });
    Subject { order: square(&[0, 1, 2, 3, 4, 5]), ..columns }
}
