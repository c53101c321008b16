//! Clusters that no loop joint describes: a differential, a belt.

use dynamics_core::clusters::{
    Belt, ClusterError, Clustered, ClusteredRobot, Differential, Driven, ForwardError,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use fixtures::hard::loops::scene;
use host_tests::export::robot;
use host_tests::hard::Row;

use super::outcome::{Outcome, rows};
use super::setup::{Exported, Start, WEIGHT, rounded};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

const fn wrist(name: &'static str, second: [f64; 3], parent: usize) -> ArmModel<f64, 2> {
    let bodies = [
        Body::new("first", BASE, Joint::revolute(Y))
            .mass(0.5)
            .com([0.0625, 0.0, 0.03125])
            .inertia([0.0078125, 0.0, 0.0009765625, 0.0078125, 0.0, 0.0078125]),
        Body::new("second", parent, Joint::revolute(second))
            .mass(1.0)
            .com([0.125, 0.0625, 0.0])
            .inertia([0.015625, 0.0, 0.0, 0.015625, 0.001953125, 0.0078125]),
    ];
    Model::new(name, bodies)
}

/// A wrist on a differential whose roll is 1024 times slower than its pitch.
pub struct Wrist;

impl Robot<2, 2, 2> for Wrist {
    const MODEL: ArmModel<f64, 2> = wrist("wrist", X, 0);
}
impl ClusteredRobot<2, 2, 2, 2, 2> for Wrist {
    type Clusters = (Driven<Differential, 2, 2>,);
    const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 1024.0])),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1]];
}

/// An arm on a belt that turns it by 1024 rad for each rad of its pulley, and more away from the
/// middle.
pub struct Steep;

const STEEP: [f64; 4] = [0.5, 1024.0, 512.0, -4096.0];

impl Robot<2, 2, 2> for Steep {
    const MODEL: ArmModel<f64, 2> = wrist("steep", Y, BASE);
}
impl ClusteredRobot<2, 2, 2, 1, 1> for Steep {
    type Clusters = (Driven<Belt<4>, 2, 1>,);
    const CLUSTERS: Self::Clusters = (Driven::new("steep", Belt::new(STEEP)),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1]];
}

fn problem<T, const N: usize>(
    case: u32,
    name: &str,
    gamma: Vec<Vec<Vec<f64>>>,
    states: &[State<f64, N, N>],
) -> Exported
where
    T: Robot<2, 2, 2>,
{
    let exported = Exported {
        case,
        name: name.into(),
        inputs: String::new(),
        robot: robot(&T::MODEL),
        loops: Vec::new(),
        gamma,
        actuated: Vec::new(),
        held: Vec::new(),
        gravity: WEIGHT,
        states: states.iter().map(Start::of).collect(),
    };
    exported.digested()
}

const WRIST_STATES: [State<f64, 2, 2>; 2] = [
    State { q: [0.5, 0.25], qd: [2.0, -1.5], qdd: [8.0, 5.0] },
    State { q: [700.5, -699.0], qd: [1000.0, -999.0], qdd: [-400.0, 401.0] },
];

const STEEP_STATES: [State<f64, 1, 1>; 2] = [
    State { q: [0.00390625], qd: [0.0078125], qdd: [0.015625] },
    State { q: [-0.009765625], qd: [-0.015625], qdd: [0.03125] },
];

/// The description of the differential that the oracle reads.
pub fn differential() -> Exported {
    let (half, slow) = (vec![0.0, 0.5], vec![0.0, 0.5 / 1024.0]);
    let minus = vec![0.0, -0.5 / 1024.0];
    let gamma = vec![vec![half.clone(), half], vec![slow, minus]];
    problem::<Wrist, 2>(62, "ratios 1 and 1024", gamma, &WRIST_STATES)
}

/// The description of the belt that the oracle reads.
pub fn belt() -> Exported {
    let gamma = vec![vec![vec![0.0, 1.0]], vec![STEEP.to_vec()]];
    problem::<Steep, 1>(63, "a slope of 1024", gamma, &STEEP_STATES)
}

pub fn differential_rows() -> Vec<Row> {
    against::<Wrist, 2>(&differential(), &WRIST_STATES)
}

pub fn belt_rows() -> Vec<Row> {
    against::<Steep, 1>(&belt(), &STEEP_STATES)
}

fn against<T, const Y: usize>(problem: &Exported, states: &[State<f64, Y, Y>]) -> Vec<Row>
where
    T: ClusteredRobot<2, 2, 2, Y, Y>,
{
    let truth = problem.truth();
    let given: Vec<&[f64]> = truth.states.iter().map(|state| &*state.given).collect();
    let (single, double) =
        (outcomes::<f32, T, Y>(states, &given), outcomes::<f64, T, Y>(states, &given));
    let tau: Vec<_> = truth.states.iter().map(|state| state.tau.as_deref()).collect();
    let forward = truth.states.iter().map(|state| Some(&*state.forward)).collect();
    let quantities =
        ["clusters: inverse dynamics", "engine: inverse dynamics", "clusters: forward dynamics"];
    let mut all = Vec::new();
    for ((k, quantity), truth) in quantities.into_iter().enumerate().zip([&tau, &tau, &forward]) {
        let name = format!("{quantity}, {}", problem.name);
        all.extend(rows(problem.case, &name, [&single[k], &double[k]], truth));
    }
    all
}

fn outcomes<R: Real, T, const Y: usize>(
    states: &[State<f64, Y, Y>],
    given: &[&[f64]],
) -> [Vec<Outcome>; 3]
where
    T: ClusteredRobot<2, 2, 2, Y, Y>,
{
    let mut all = [Vec::new(), Vec::new(), Vec::new()];
    let scene = scene::<R>();
    for (state, given) in states.iter().zip(given) {
        let y: State<R, Y, Y> =
            State { q: rounded(&state.q), qd: rounded(&state.qd), qdd: rounded(&state.qdd) };
        let of = |found: Result<[R; Y], ClusterError>| match found {
            Ok(x) => Outcome::of(&x, false),
            Err(error) if T::MODEL.name == error.cluster => Outcome::REFUSED,
            Err(_) => Outcome::NOTHING,
        };
        all[0].push(of(Clustered::<Core<T>>::rnea(&y, &scene)));
        all[1].push(of(Clustered::<Engine<T>>::rnea(&y, &scene)));
        let forward = Clustered::<Core<T>>::aba(&y, &rounded(given), &scene);
        all[2].push(match forward {
            Err(ForwardError::Cluster(error)) => of(Err(error)),
            Err(_) => Outcome::NOTHING,
            Ok(x) => of(Ok(x)),
        });
    }
    all
}
