//! Algorithms on any state: no panic, and of ordinary states ordinary numbers.

use super::bytes::Bytes;
use crate::trees::TreeB;
use dynamics_core::algorithms::{aba, crba, forward_dynamics, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Robot, model};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::{difference, integrate, normalise};

/// A state of the UR5e in f32, or of a tree with every kind of joint in f64.
///
/// # Panics
/// If ordinary numbers (a speed up to 100, a torque up to 10⁴) lead to one that is not finite.
pub fn dynamics(bytes: &[u8]) {
    let from = &mut Bytes(bytes);
    match from.byte() % 2 {
        0 => of::<f32, Ur5e, 6, 6, 6>(from),
        _ => of::<f64, TreeB, 17, 35, 32>(from),
    }
}

fn of<R: Real, T, const B: usize, const Q: usize, const V: usize>(from: &mut Bytes<'_>)
where
    T: Robot<B, Q, V>,
{
    let model = model::<R, T, B, Q, V>();
    // In an array after the other, one number of any kind among ordinary ones, or all of them.
    let wild = from.byte();
    let mut number = |i: usize| {
        if wild == 255 || usize::from(wild) == i { from.number() } else { from.ordinary() }
    };
    let mut q: [R; Q] = core::array::from_fn(|i| R::from_f64(number(i)));
    let [qd, qdd, tau]: [[R; V]; 3] =
        core::array::from_fn(|k| core::array::from_fn(|i| R::from_f64(number(Q + k * V + i))));
    let whole = normalise(model, &mut q).is_ok();
    let state = State { q, qd, qdd };
    let within = |values: &[R], most: f64| values.iter().all(|x| x.to_f64().abs() <= most);
    let ordinary =
        whole && within(&q, 100.0) && within(&qd, 100.0) && within(&qdd, 1e4) && within(&tau, 1e4);

    let torque = rnea(model, &state, &RIGID_BODY);
    let m = crba(model, &q, &RIGID_BODY);
    let [by_bodies, by_matrix] =
        [aba(model, &state, &tau, &RIGID_BODY), forward_dynamics(model, &state, &tau, &RIGID_BODY)];
    let there = integrate(model, &q, &qd);
    let back = difference(model, &q, &there);
    if ordinary {
        let finite = |values: &[R]| values.iter().all(|x| x.is_finite());
        assert!(finite(&torque) && finite(&there) && finite(&back), "{state:?}");
        assert!((0..V).all(|i| m.get(i, i) > R::ZERO), "{state:?}");
        assert!(by_bodies.is_ok_and(|qdd| finite(&qdd)), "{by_bodies:?} {state:?}");
        assert!(by_matrix.is_ok_and(|qdd| finite(&qdd)), "{by_matrix:?} {state:?}");
    }
}
