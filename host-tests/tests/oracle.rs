//! Core against Pinocchio, in f64 and f32, on every recorded state.

use dynamics_core::algorithms::{aba, rnea};
use dynamics_core::effects::{Coriolis, Effect, Gravity, RIGID_BODY};
use dynamics_core::model::{Model, Robot, model};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
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

fn worst<R: Real, const N: usize>(got: [R; N], want: [f64; N], scale: f64) -> f64 {
    got.iter().zip(want).fold(0.0, |worst, (&got, want)| {
        let error = (got.to_f64() - want).abs() / scale;
        if error > worst || error.is_nan() {
            error
        } else {
            worst
        }
    })
}

fn compare<R: Real, const B: usize, const N: usize>(
    model: &Model<R, B, N, N>,
    recording: &Recording,
    verdict: &mut Verdict,
) where
    (Gravity, Coriolis): Effect<R, B, N>,
{
    let name = recording.robot.as_str();
    let scalar = std::any::type_name::<R>();
    let (mut full, mut gravity, mut bias, mut forward) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    let scale = recording.full_scale;
    assert!(recording.q.len() > 200);
    for i in 0..recording.q.len() {
        let cast = |rows| row::<N>(rows, i).map(R::from_f64);
        let state = State {
            q: cast(&recording.q),
            qd: cast(&recording.qd),
            qdd: cast(&recording.qdd),
        };
        let expect = |rows| row::<N>(rows, i);
        let tau = rnea(model, &state, &RIGID_BODY);
        full = full.max(worst(tau, expect(&recording.rnea), scale.rnea));
        let tau = rnea(model, &state, &(Gravity::EARTH,));
        gravity = gravity.max(worst(tau, expect(&recording.gravity), scale.gravity));
        let tau = rnea(model, &state, &(Gravity::EARTH, Coriolis));
        bias = bias.max(worst(tau, expect(&recording.bias), scale.bias));
        let qdd = aba(model, &state, &cast(&recording.tau), &RIGID_BODY).expect("M is positive");
        forward = forward.max(worst(qdd, expect(&recording.aba), scale.aba));
    }
    verdict.check(name, "rnea", scalar, full);
    verdict.check(name, "gravity", scalar, gravity);
    verdict.check(name, "bias", scalar, bias);
    verdict.check(name, "aba", scalar, forward);
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
    compare::<f64, B, N>(model::<f64, T, B, N, N>(), &recording, verdict);
    compare::<f32, B, N>(model::<f32, T, B, N, N>(), &recording, verdict);
}

#[test]
fn core_agrees_with_pinocchio_within_the_table() {
    let mut verdict = Verdict(vec![]);
    robot::<Ur5e, 6, 6>(&mut verdict);
    robot::<Panda, 7, 7>(&mut verdict);
    robot::<Iiwa14, 7, 7>(&mut verdict);
    robot::<A1, 16, 12>(&mut verdict);
    assert!(verdict.0.is_empty(), "\n{}", verdict.0.join("\n"));
}
