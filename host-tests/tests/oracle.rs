//! Core and engine against Pinocchio, in f64 and f32, on every recorded state.

use dynamics_core::effects::{Coriolis, Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::recordings::{Recording, load, row};
use host_tests::{export, tolerances};

/// Collects every complaint, so that one run shows the whole table.
struct Verdict(Vec<String>);

impl Verdict {
    fn check(&mut self, robot: &str, quantity: &str, scalar: &str, error: f64) {
        if let Err(e) = tolerances::check(robot, quantity, scalar, error) {
            self.0.push(e);
        }
    }
}

/// The largest error of one quantity over the states.
struct Worst {
    quantity: &'static str,
    full_scale: f64,
    error: f64,
}

impl Worst {
    fn new(quantity: &'static str, full_scale: f64) -> Self {
        Self {
            quantity,
            full_scale,
            error: 0.0,
        }
    }

    fn see<R: Real, const N: usize>(&mut self, got: [R; N], want: [f64; N]) {
        for (got, want) in got.iter().zip(want) {
            let error = (got.to_f64() - want).abs() / self.full_scale;
            if error > self.error || error.is_nan() {
                self.error = error;
            }
        }
    }
}

fn compare<R: Real, T, const B: usize, const N: usize>(recording: &Recording, verdict: &mut Verdict)
where
    T: Robot<B, N, N>,
{
    let scale = recording.full_scale;
    let mut full = ["rnea", "engine rnea"].map(|q| Worst::new(q, scale.rnea));
    let mut gravity = ["gravity", "engine gravity"].map(|q| Worst::new(q, scale.gravity));
    let mut bias = ["bias", "engine bias"].map(|q| Worst::new(q, scale.bias));
    let mut forward = ["aba", "engine forward"].map(|q| Worst::new(q, scale.aba));
    let mut matrix = Worst::new("engine crba", scale.mass_matrix);
    assert!(recording.q.len() > 200);
    for i in 0..recording.q.len() {
        let cast = |rows| row::<N>(rows, i).map(R::from_f64);
        let state = State {
            q: cast(&recording.q),
            qd: cast(&recording.qd),
            qdd: cast(&recording.qdd),
        };
        let want = row::<N>(&recording.rnea, i);
        full[0].see(Core::<T>::rnea(&state, &RIGID_BODY), want);
        full[1].see(Engine::<T>::rnea(&state, &RIGID_BODY), want);
        let (want, scene) = (row::<N>(&recording.gravity, i), (Gravity::EARTH,));
        gravity[0].see(Core::<T>::rnea(&state, &scene), want);
        gravity[1].see(Engine::<T>::rnea(&state, &scene), want);
        let (want, scene) = (row::<N>(&recording.bias, i), (Gravity::EARTH, Coriolis));
        bias[0].see(Core::<T>::rnea(&state, &scene), want);
        bias[1].see(Engine::<T>::rnea(&state, &scene), want);
        let (want, tau) = (row::<N>(&recording.aba, i), cast(&recording.tau));
        let accelerations = [
            Core::<T>::aba(&state, &tau, &RIGID_BODY),
            Engine::<T>::forward(&state, &tau, &RIGID_BODY),
        ];
        for (worst, qdd) in forward.iter_mut().zip(accelerations) {
            worst.see(qdd.expect("M is positive"), want);
        }
        if let Some(triangle) = recording.mass_matrix.get(i) {
            let m = Engine::<T>::crba(&state.q, &RIGID_BODY);
            let mut triangle = triangle.iter();
            for i in 0..N {
                for j in i..N {
                    let want = *triangle.next().expect("a triangle of N");
                    matrix.see([m.get(i, j), m.get(j, i)], [want; 2]);
                }
            }
        }
    }
    let scalar = std::any::type_name::<R>();
    for worst in full
        .iter()
        .chain(&gravity)
        .chain(&bias)
        .chain(&forward)
        .chain([&matrix])
    {
        verdict.check(&recording.robot, worst.quantity, scalar, worst.error);
    }
}

fn robot<T, const B: usize, const N: usize>(verdict: &mut Verdict)
where
    T: Robot<B, N, N>,
{
    let recording = load(T::MODEL.name);
    assert_eq!(
        recording.model,
        export::robot(&T::MODEL),
        "the recording is of other numbers: run host-tests/oracle/record.py again"
    );
    compare::<f64, T, B, N>(&recording, verdict);
    compare::<f32, T, B, N>(&recording, verdict);
}

#[test]
fn core_and_engine_agree_with_pinocchio_within_the_table() {
    let mut verdict = Verdict(vec![]);
    robot::<Ur5e, 6, 6>(&mut verdict);
    robot::<Panda, 7, 7>(&mut verdict);
    robot::<Iiwa14, 7, 7>(&mut verdict);
    robot::<A1, 16, 12>(&mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}

/// The engine's articulated bodies, on one robot: they take the compiler long.
fn articulated<R: Real>(recording: &Recording, verdict: &mut Verdict) {
    let mut worst = Worst::new("engine aba", recording.full_scale.aba);
    for i in 0..recording.q.len() {
        let cast = |rows| row::<6>(rows, i).map(R::from_f64);
        let state = State {
            qd: cast(&recording.qd),
            ..State::at(cast(&recording.q))
        };
        let qdd = Engine::<Ur5e>::aba(&state, &cast(&recording.tau), &RIGID_BODY);
        worst.see(qdd.expect("M is positive"), row(&recording.aba, i));
    }
    let scalar = std::any::type_name::<R>();
    verdict.check("ur5e", worst.quantity, scalar, worst.error);
}

#[test]
fn articulated_bodies_of_the_engine_agree_with_pinocchio() {
    let (mut verdict, recording) = (Verdict(vec![]), load("ur5e"));
    articulated::<f64>(&recording, &mut verdict);
    articulated::<f32>(&recording, &mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}
