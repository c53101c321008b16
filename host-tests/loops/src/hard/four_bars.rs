//! The planar linkages: as loops, and the four-bars as clusters, too.

use dynamics_core::clusters::{Clustered, ClusteredRobot, ForwardError};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use fixtures::hard::loops::{FourBar, LoopProblem, PROBLEMS, scene};
use host_tests::hard::Row;

use super::outcome::{Outcome, rows};
use super::setup::{Planar, Truth, rounded};

pub fn problem(case: u32, name: &str) -> &'static LoopProblem<3, 1> {
    let mut all = PROBLEMS.iter();
    let found = all.find(|problem| (problem.case, problem.name) == (case, name));
    found.unwrap_or_else(|| panic!("there is no linkage {name:?} of case {case}"))
}

/// The problems of this case against the oracle, as loops and as clusters.
pub fn of_case(case: u32) -> Vec<Row> {
    let problems = PROBLEMS.iter().filter(|problem| problem.case == case);
    problems.flat_map(of_problem).collect()
}

fn of_problem(problem: &LoopProblem<3, 1>) -> Vec<Row> {
    let setup = Planar::of(problem);
    let truth = setup.truth();
    let mut all = setup.rows_against(&truth);
    if let Some(linkage) = problem.linkage {
        all.extend(as_clusters(problem, linkage, &truth));
    }
    all
}

/// The outcomes of core and engine for a cluster in one state.
pub type OfCluster = [Outcome; 3];

fn as_clusters(problem: &LoopProblem<3, 1>, linkage: usize, truth: &Truth) -> Vec<Row> {
    let states = || problem.starts.iter().zip(&truth.states);
    let single: Vec<OfCluster> = states()
        .map(|(start, truth)| of(linkage, crank::<f32>(start), truth.given[0] as f32))
        .collect();
    let double: Vec<OfCluster> =
        states().map(|(start, truth)| of(linkage, crank::<f64>(start), truth.given[0])).collect();
    let of_states = |from: &[OfCluster], k: usize| -> Vec<Outcome> {
        from.iter().map(|outcomes| outcomes[k].clone()).collect()
    };
    let tau: Vec<_> = truth.states.iter().map(|state| state.tau.as_deref()).collect();
    let forward = truth.states.iter().map(|state| state.forward.get(..1)).collect();
    let quantities =
        ["clusters: inverse dynamics", "engine: inverse dynamics", "clusters: forward dynamics"];
    let mut all = Vec::new();
    for ((k, quantity), truth) in quantities.into_iter().enumerate().zip([&tau, &tau, &forward]) {
        let name = format!("{quantity}, {}", problem.name);
        let (single, double) = (of_states(&single, k), of_states(&double, k));
        all.extend(rows(problem.case, &name, [&single, &double], truth));
    }
    all
}

/// Inverse dynamics by core and engine, and forward dynamics, of y, ẏ and ÿ of a linkage and a
/// torque of its crank.
pub fn of<R: Real>(linkage: usize, numbers: [R; 3], tau: R) -> OfCluster {
    let run = match linkage {
        0 => of_linkage::<R, 0>,
        1 => of_linkage::<R, 1>,
        2 => of_linkage::<R, 2>,
        3 => of_linkage::<R, 3>,
        4 => of_linkage::<R, 4>,
        5 => of_linkage::<R, 5>,
        6 => of_linkage::<R, 6>,
        _ => of_linkage::<R, 7>,
    };
    run(numbers, tau)
}

fn of_linkage<R: Real, const K: usize>(numbers: [R; 3], tau: R) -> OfCluster
where
    FourBar<K>: ClusteredRobot<3, 3, 3, 1, 1>,
{
    let ([q, qd, qdd], scene) = (numbers.map(|x| [x]), scene::<R>());
    let y = State { q, qd, qdd };
    let motion = Clustered::<Core<FourBar<K>>>::motion(&y);
    let named = match &motion {
        Ok(motion) => motion.singular() == Some("four_bar"),
        Err(error) => error.cluster == "four_bar",
    };
    let refused = if named { Outcome::REFUSED } else { Outcome::NOTHING };
    let of = |found: Result<[R; 1], ()>| found.map_or(refused.clone(), |x| Outcome::of(&x, named));
    let forward = Clustered::<Core<FourBar<K>>>::aba(&y, &[tau], &scene);
    [
        of(Clustered::<Core<FourBar<K>>>::rnea(&y, &scene).map_err(|_| ())),
        of(Clustered::<Engine<FourBar<K>>>::rnea(&y, &scene).map_err(|_| ())),
        match forward {
            Err(ForwardError::Cluster(error)) if error.cluster == "four_bar" => Outcome::REFUSED,
            found => of(found.map_err(|_| ())),
        },
    ]
}

/// The numbers of a crank as R's.
pub fn crank<R: Real>(start: &[[f32; 3]; 3]) -> [R; 3] {
    rounded(&start.map(|[y, ..]| f64::from(y)))
}
