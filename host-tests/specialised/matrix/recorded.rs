//! M and forward dynamics by it against Pinocchio, on every recorded state.

use dynamics_core::Core;
use dynamics_core::algorithms::{crba, forward_dynamics};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Robot, model};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::recordings::{Recording, load, row};
use host_tests::tolerances;

/// The largest errors of M and of q̈, of full scale.
fn errors<R: Real, T, const B: usize, const N: usize>(recording: &Recording) -> [f64; 2]
where
    T: Robot<B, N, N>,
{
    let (scale, mut errors) = (&recording.full_scale, [0.0_f64; 2]);
    let see = |error: &mut f64, got: R, want: f64, scale: f64| {
        let difference = (got.to_f64() - want).abs() / scale;
        assert!(difference.is_finite());
        *error = error.max(difference);
    };
    assert!(recording.mass_matrix.len() > 10);
    for (i, want) in recording.mass_matrix.iter().enumerate() {
        let q = row::<N>(&recording.q, i).map(R::from_f64);
        let m = Core::<T>::crba(&q, &RIGID_BODY);
        assert_eq!(m, crba(model::<R, T, B, N, N>(), &q, &RIGID_BODY), "run-time model");
        let upper = (0..N).flat_map(|i| (i..N).map(move |j| (i, j)));
        for ((i, j), &want) in upper.zip(want) {
            see(&mut errors[0], m.get(i, j), want, scale.mass_matrix);
        }
    }
    for i in 0..recording.q.len() {
        let cast = |rows| row::<N>(rows, i).map(R::from_f64);
        let state = State { q: cast(&recording.q), qd: cast(&recording.qd), qdd: [R::ZERO; N] };
        let tau = cast(&recording.tau);
        let qdd =
            Core::<T>::forward_dynamics(&state, &tau, &RIGID_BODY).expect("M is positive definite");
        let of_model = forward_dynamics(model::<R, T, B, N, N>(), &state, &tau, &RIGID_BODY);
        assert_eq!(of_model, Ok(qdd), "run-time model");
        for (got, want) in qdd.into_iter().zip(row::<N>(&recording.aba, i)) {
            see(&mut errors[1], got, want, scale.aba);
        }
    }
    errors
}

#[test]
fn m_and_forward_dynamics_agree_with_pinocchio_within_the_table() {
    fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>(complaints: &mut Vec<String>) {
        let name = T::MODEL.name;
        let recording = load(name);
        let double = errors::<f64, T, B, N>(&recording);
        let single = errors::<f32, T, B, N>(&recording);
        for (k, what) in ["crba", "forward"].into_iter().enumerate() {
            complaints.extend(tolerances::check(name, what, "f64", double[k]).err());
            complaints.extend(tolerances::check(name, what, "f32", single[k]).err());
        }
    }
    let mut complaints = Vec::new();
    robot::<Ur5e, 6, 6>(&mut complaints);
    robot::<Panda, 7, 7>(&mut complaints);
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::{A1, Iiwa14};
        robot::<Iiwa14, 7, 7>(&mut complaints);
        robot::<A1, 16, 12>(&mut complaints);
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}
