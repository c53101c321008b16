//! What Pinocchio says of the machines: `host-tests/oracle/loops.py`.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{Stabilisation, forward_dynamics, inverse_dynamics};
use dynamics_core::model::Static;
use dynamics_core::state::State;
use host_tests::measured::largest;
use host_tests::recordings::{full_scale, read, row};
use host_tests::tolerances;
use loop_tests::export::{Exported, machine};
use loop_tests::machines::{Delta, FiveBar, FourBar, Machine, Stewart};
use serde::Deserialize;

/// Every row of an array is a state.
#[derive(Deserialize)]
struct Recording {
    pinocchio: String,
    /// The machine that was recorded.
    machine: Exported,
    /// Positions with closed loops.
    q: Vec<Vec<f64>>,
    /// Velocities with closed loops.
    qd: Vec<Vec<f64>>,
    /// Accelerations with closed loops.
    qdd: Vec<Vec<f64>>,
    /// The motors' torques with those accelerations.
    tau: Vec<Vec<f64>>,
    /// Torques of the motors given to forward dynamics.
    given_tau: Vec<Vec<f64>>,
    /// The accelerations that they give: `constraintDynamics`.
    forward: Vec<Vec<f64>>,
}

fn agrees<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>()
where
    T: Machine<B, Q, V, L, C, A>,
{
    let (name, robot) = (T::MODEL.name, Static::<T>::NEW);
    let recording: Recording = read(&format!("loop_{name}"));
    assert!(
        recording.pinocchio.starts_with("4.1"),
        "{}",
        recording.pinocchio
    );
    assert_eq!(
        recording.machine,
        machine::<T, B, Q, V, L, C, A>(),
        "another machine was recorded"
    );
    assert_eq!(recording.q.len(), 200);
    let (mut torques, mut rates, mut accelerations) = (vec![], vec![], vec![]);
    let difference = |got: &[f64], want: &[f64]| {
        largest(got.iter().zip(want).map(|(got, want)| (got - want).abs()))
    };
    for k in 0..recording.q.len() {
        let qd: [f64; V] = row(&recording.qd, k);
        let state = State {
            q: row(&recording.q, k),
            qd,
            qdd: row(&recording.qdd, k),
        };
        let id = inverse_dynamics(&robot, &T::LOOPS, &state, &RIGID_BODY).expect("a torque");
        torques.push(difference(&id.tau, &recording.tau[k]));
        rates.push(difference(&id.state.qd, &recording.qd[k]));
        rates.push(difference(&id.state.qdd, &recording.qdd[k]));
        let (tau, none) = (row(&recording.given_tau, k), Stabilisation::NONE);
        let fd = forward_dynamics(&robot, &T::LOOPS, &state, &tau, none, &RIGID_BODY);
        accelerations.push(difference(
            &fd.expect("accelerations").qdd,
            &recording.forward[k],
        ));
    }
    for (what, errors, rows) in [
        ("recorded torques", torques, &recording.tau),
        ("recorded rates", rates, &recording.qdd),
        ("recorded accelerations", accelerations, &recording.forward),
    ] {
        let error = largest(errors) / full_scale(rows);
        tolerances::check(name, what, "f64", error).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn a_four_bar_linkage_moves_as_in_pinocchio() {
    agrees::<FourBar, 3, 3, 3, 1, 5, 1>();
}

#[test]
fn a_five_bar_linkage_moves_as_in_pinocchio() {
    agrees::<FiveBar, 4, 4, 4, 1, 5, 2>();
}

#[test]
fn a_delta_robot_moves_as_in_pinocchio() {
    agrees::<Delta, 10, 22, 21, 6, 18, 3>();
}

#[test]
fn a_stewart_platform_moves_as_in_pinocchio() {
    agrees::<Stewart, 13, 25, 24, 6, 18, 6>();
}
