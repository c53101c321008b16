//! The engine against Pinocchio, on every recorded state.

use dynamics_core::Engine;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
#[cfg(feature = "full")]
use dynamics_core::robots::{A1, Iiwa14, OpenArm, Panda, Puma560, Yam};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::recordings::{Recording, load, row, symmetric};
use host_tests::tolerances;

/// The largest error of one answer, relative to its full scale.
fn worst<R: Real, const N: usize>(
    rows: &[Vec<f64>],
    full_scale: f64,
    answer: impl Fn(usize) -> [R; N],
) -> f64 {
    let mut worst = 0.0;
    for i in 0..rows.len() {
        for (got, want) in answer(i).iter().zip(row::<N>(rows, i)) {
            let error = (got.to_f64() - want).abs() / full_scale;
            // A NaN counts as wrong.
            worst = if error <= worst { worst } else { error };
        }
    }
    worst
}

fn state<R: Real, const N: usize>(recording: &Recording, i: usize) -> State<R, N, N> {
    let cast = |rows| row::<N>(rows, i).map(R::from_f64);
    State { q: cast(&recording.q), qd: cast(&recording.qd), qdd: cast(&recording.qdd) }
}

fn check<R>(robot: &str, quantity: &str, error: f64) {
    let scalar = std::any::type_name::<R>();
    tolerances::check(robot, quantity, scalar, error).unwrap_or_else(|e| panic!("{e}"));
}

fn inverse<R: Real, T, E, const B: usize, const N: usize>(
    quantity: &str,
    (rows, full_scale): (&[Vec<f64>], f64),
    recording: &Recording,
    effects: &E,
) where
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
{
    let error =
        worst(rows, full_scale, |i| Engine::<T>::rnea(&state::<R, N>(recording, i), effects));
    check::<R>(T::MODEL.name, quantity, error);
}

fn full<R: Real, T, const B: usize, const N: usize>(r: &Recording)
where
    T: Robot<B, N, N>,
{
    let of = (&*r.rnea, r.full_scale.rnea);
    inverse::<R, T, _, B, N>("engine rnea", of, r, &RIGID_BODY);
}

fn parts<R: Real, T, const B: usize, const N: usize>(r: &Recording)
where
    T: Robot<B, N, N>,
{
    let of = (&*r.gravity, r.full_scale.gravity);
    inverse::<R, T, _, B, N>("engine gravity", of, r, &Gravity::EARTH);
    let of = (&*r.bias, r.full_scale.bias);
    inverse::<R, T, _, B, N>("engine bias", of, r, &(Gravity::EARTH, Coriolis));
}

fn forward<R: Real, T, const B: usize, const N: usize>(r: &Recording)
where
    T: Robot<B, N, N>,
{
    let error = worst(&r.aba, r.full_scale.aba, |i| {
        let tau = row::<N>(&r.tau, i).map(R::from_f64);
        let qdd = Engine::<T>::forward_dynamics(&state::<R, N>(r, i), &tau, &RIGID_BODY);
        qdd.expect("M is positive")
    });
    check::<R>(T::MODEL.name, "engine forward", error);
}

fn matrix<R: Real, T, const B: usize, const N: usize>(r: &Recording)
where
    T: Robot<B, N, N>,
{
    let mut error = 0.0_f64;
    for i in 0..r.mass_matrix.len() {
        let m = Engine::<T>::crba(&state::<R, N>(r, i).q, &(Inertia,));
        for (i, wanted) in symmetric::<N>(&r.mass_matrix, i).iter().enumerate() {
            for (j, wanted) in wanted.iter().enumerate() {
                let found = m.get(i, j).to_f64();
                assert!(found.is_finite());
                error = error.max((found - wanted).abs() / r.full_scale.mass_matrix);
            }
        }
    }
    check::<R>(T::MODEL.name, "engine crba", error);
}

#[test]
fn inverse_dynamics_agree_with_pinocchio_within_the_table() {
    fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>() {
        let recording = load(T::MODEL.name);
        full::<f64, T, B, N>(&recording);
        full::<f32, T, B, N>(&recording);
    }
    robot::<Ur5e, 6, 6>();
    #[cfg(feature = "full")]
    {
        robot::<Panda, 7, 7>();
        robot::<Iiwa14, 7, 7>();
        robot::<Puma560, 6, 6>();
        robot::<OpenArm, 7, 7>();
        robot::<Yam, 6, 6>();
        robot::<A1, 16, 12>();
    }
    let recording = load("ur5e");
    parts::<f32, Ur5e, 6, 6>(&recording);
}

#[test]
fn m_and_forward_dynamics_agree_with_pinocchio_within_the_table() {
    // Few of them: they take the compiler long.
    let recording = load("ur5e");
    forward::<f32, Ur5e, 6, 6>(&recording);
    matrix::<f32, Ur5e, 6, 6>(&recording);
    #[cfg(feature = "full")]
    {
        forward::<f64, Iiwa14, 7, 7>(&load("iiwa14"));
        matrix::<f64, Panda, 7, 7>(&load("panda"));
        matrix::<f64, A1, 16, 12>(&load("a1"));
    }
}

#[test]
fn articulated_bodies_agree_with_pinocchio() {
    fn ur5e<R: Real>() {
        let r = load("ur5e");
        let error = worst(&r.aba, r.full_scale.aba, |i| {
            let tau = row::<6>(&r.tau, i).map(R::from_f64);
            let qdd = Engine::<Ur5e>::aba(&state::<R, 6>(&r, i), &tau, &RIGID_BODY);
            qdd.expect("M is positive")
        });
        check::<R>("ur5e", "engine aba", error);
    }
    ur5e::<f32>();
}
