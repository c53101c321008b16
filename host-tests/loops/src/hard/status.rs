//! The results besides numbers: ranks, statuses and errors.

use dynamics_core::Core;
use dynamics_core::clusters::{ClusterProblem, Clustered};
use dynamics_core::loops::{Drive, LoopError, Moving, assemble, coordinate_map, inverse_dynamics};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::loops::{FourBar, LoopProblem, PROBLEMS, RIG, scene};
use host_tests::hard::Row;

use super::four_bars::crank;
use super::robots;
use super::setup::{Planar, rounded};

/// A claim in both scalars.
fn both(claim: &str, holds: [bool; 2]) -> [Row; 2] {
    let [single, double] = holds;
    [Row::claim(claim, "f32", single), Row::claim(claim, "f64", double)]
}

/// Rank 2 of five rows, the other three named.
pub fn redundant_rows() -> Vec<Row> {
    fn holds<R: Real>(robot: &impl RobotModel<R, 3, 3, 3>, setup: &Planar<3, 1>) -> bool {
        let truth = setup.truth();
        truth.states.iter().all(|state| {
            let q: [R; 3] = rounded(&state.q);
            let map = coordinate_map(robot, &setup.loops, &q).expect("it closes");
            map.rows().rank() == 2
                && map.drive() == Drive::Determined
                && map.rows().redundant().count() == 3
                && map.rows().redundant().all(|row| setup.loops.name_of_row(row) == "pin")
        })
    }
    let setup = Planar::of(&PROBLEMS[0]);
    let holds = [holds(&setup.single, &setup), holds(&setup.tree, &setup)];
    both("three of five rows are redundant, and named", holds).into()
}

/// More motors than degrees of freedom.
pub fn least_norm() -> Vec<Row> {
    fn holds<R: Real>(robot: &impl RobotModel<R, 4, 4, 4>, setup: &Planar<4, 3>) -> bool {
        let truth = setup.truth();
        truth.states.iter().all(|state| {
            let state: State<R, 4, 4> = state.state();
            let found = inverse_dynamics(robot, &setup.loops, &state, &scene());
            found.is_ok_and(|found| found.drive == Drive::LeastNorm { redundancy: 1 })
        })
    }
    let setup = Planar::of(&RIG);
    let holds = [holds(&setup.single, &setup), holds(&setup.tree, &setup)];
    both("least norm of one motor too many", holds).into()
}

/// A loop that cannot close is named by assembly, by inverse dynamics and as a cluster.
pub fn out_of_reach(problem: &LoopProblem<3, 1>) -> Vec<Row> {
    fn holds<R: Real>(
        robot: &impl RobotModel<R, 3, 3, 3>,
        problem: &LoopProblem<3, 1>,
    ) -> [bool; 3] {
        let open = |error| matches!(error, LoopError::Open { name: "pin", error } if error > 0.05 && error < 1.0);
        let mut all = [true; 3];
        for start in problem.starts {
            let [q, qd, qdd] = start.map(|row| rounded::<R, 3>(&row.map(f64::from)));
            let closed = assemble(robot, problem.loops, &q, Moving::Passive);
            all[0] &= closed.is_err_and(open);
            let torque = inverse_dynamics(robot, problem.loops, &State { q, qd, qdd }, &scene());
            all[1] &= torque.is_err_and(open);
            let [q, qd, qdd] = crank::<R>(start).map(|x| [x]);
            let cluster = Clustered::<Core<FourBar<7>>>::rnea(&State { q, qd, qdd }, &scene());
            all[2] &= cluster.is_err_and(|error| {
                error.cluster == "four_bar" && error.problem == ClusterProblem::CannotClose
            });
        }
        all
    }
    let (single, double) = (holds(problem.single, problem), holds(problem.tree, problem));
    let claims = ["assembly", "inverse dynamics", "clusters"];
    let rows = claims.into_iter().enumerate().flat_map(|(k, quantity)| {
        both(&format!("{quantity}: the open loop is named"), [single[k], double[k]])
    });
    rows.collect()
}

/// The Delta whose rods are in one plane.
pub fn coplanar_delta() -> Vec<Row> {
    let delta = robots::coplanar();
    let start = &delta.starts[0];
    let single: State<f32, 22, 21> =
        State { q: rounded(&start.q), qd: rounded(&start.qd), qdd: rounded(&start.qdd) };
    let found = [
        delta.inverse(&delta.single, &delta.loops, &single),
        delta.inverse(&delta.tree, &delta.loops, start),
    ];
    let holds = found.map(|outcome| outcome.is_named());
    both("inverse dynamics, rods coplanar: named, finite", holds).into()
}
