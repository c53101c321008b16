//! Inverse dynamics: errors over states anywhere and along the robot's way.

use std::f64::consts::PI;

use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::accuracy::robots::{Compared, in_box};
use fixtures::accuracy::{Inverse, Visitor};
use host_tests::random::{random_numbers, within};
use host_tests::recordings::{Precise, load, read};
use proptest::test_runner::TestRng;
use serde_json::json;

use super::problem::{Problem, drawn};
use super::statistics::{Errors, object, widened};
use super::yardsticks;

/// States beside those recorded, whose oracle is our f64.
const MORE_STATES: usize = 2000;

/// Ticks that the robot rests before it goes, so that its way-points, where the torque bends, fall
/// between the ticks that compute: elsewhere, what rates lose would look too small.
const REST: u32 = 3;

/// The reference that every way of a robot is compared with.
pub struct Bench<const N: usize> {
    pub kind: &'static str,
    robot: &'static str,
    /// The robot is that of a file.
    own: bool,
    full_scale: f64,
    /// The error of the oracle itself, N·m: smaller errors are given as this one.
    floor: f64,
    states: Vec<Problem<N>>,
    way: Vec<Problem<N>>,
}

impl<const N: usize> Visitor<N> for Bench<N> {
    fn way<W: Inverse<N>>(&mut self) {
        let run = |problems: &[Problem<N>]| {
            let mut way = W::start(&problems[0].state);
            let given = (0..).map(|k: usize| &problems[(k + W::AHEAD).min(problems.len() - 1)]);
            let answers = given.map(|given| way.tick(&W::input(&given.state)).map(Real::to_f64));
            Errors::of(answers.zip(problems.iter().map(|problem| problem.truth)))
        };
        let states = !W::MEMORY && !self.states.is_empty();
        let largest = states.then(|| run(&self.states).max());
        let line = json!({
            "key": W::KEY.to_string(),
            "configuration": object(W::KEY.axes().iter()),
            "anywhere": largest.map(|error| error / self.full_scale),
            "error_box": largest.filter(|_| self.own),
        });
        let scales = [self.full_scale, self.floor];
        run(&self.way).print(self.robot, self.kind, scales, line);
    }
}

/// Prints what everything is compared with, and a line for each of these ways of the robot T.
pub fn print<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>(
    ways: fn(&mut Bench<N>),
) {
    let labelled = |state| Problem { state, truth: ours::<T, B, N>(&state) };
    let mut random = random_numbers();
    let own = T::RECORDED.is_none();
    let more = (0..MORE_STATES).map(|k| match own {
        false => labelled(drawn(&mut random, [PI, 3.0, 10.0])),
        true => labelled(in_box::<T, B, N, W>(shares(&mut random, k))),
    });
    let mut states: Vec<_> = more.collect();
    let (mut full_scale, mut floor) = (full_scale(&states), 0.0);
    if let Some(name) = T::RECORDED {
        let recorded = recorded_states::<N>(name);
        (full_scale, floor) = print_oracle::<T, B, N>(name, &recorded);
        states.splice(..0, recorded);
    }
    let way = T::way().expect("the robot can go there");
    let ticks = 0..=way.ticks() + REST;
    let way = ticks.map(|tick| labelled(way.at(tick.saturating_sub(REST))));
    let way: Vec<_> = way.collect();
    yardsticks::print::<T, B, N>(full_scale, &way);
    let (kind, robot) = ("inverse", T::MODEL.name);
    ways(&mut Bench { kind, robot, own, full_scale, floor, states, way });
}

/// Random shares of the joints' box: every other state is at a corner of speeds and accelerations,
/// where torques are largest.
fn shares<const N: usize>(random: &mut TestRng, number: usize) -> [[f32; N]; 3] {
    let [q, qd, qdd] = [(); 3].map(|()| within::<N>(random, 1.0).map(|x| x as f32));
    match number % 2 {
        0 => [q, qd, qdd],
        _ => [q, qd.map(f32::signum), qdd.map(f32::signum)],
    }
}

fn ours<T: Robot<B, N, N>, const B: usize, const N: usize>(state: &State<f32, N, N>) -> [f64; N] {
    Core::<T>::rnea(&widened(state), &RIGID_BODY)
}

/// Prints how far the f64 is off from what was recorded; returns the full scale and the largest
/// error.
fn print_oracle<T: Robot<B, N, N>, const B: usize, const N: usize>(
    name: &str,
    recorded: &[Problem<N>],
) -> (f64, f64) {
    let full_scale = full_scale(recorded);
    let ours = ours::<T, B, N>;
    let off = Errors::of(recorded.iter().map(|it| (ours(&it.state), it.truth)));
    let precise: Precise = read("precise");
    let sample = precise.states.iter().zip(precise.rnea(name));
    let sample = Errors::of(sample.map(|(&k, tau)| {
        let truth: [f64; N] = std::array::from_fn(|j| tau[j]);
        (ours(&recorded[k].state), truth)
    }));
    let oracle = json!({
        "pinocchio": load(name).pinocchio,
        "states": recorded.len(),
        "from_50_digits": sample.max() / full_scale,
        "sample": precise.states.len(),
    });
    off.print(T::MODEL.name, "oracle", [full_scale, 0.0], oracle);
    (full_scale, off.max())
}

fn full_scale<const N: usize>(recorded: &[Problem<N>]) -> f64 {
    let truths = recorded.iter().flat_map(|problem| problem.truth);
    truths.fold(0.0, |most, tau| most.max(tau.abs()))
}

fn recorded_states<const N: usize>(name: &str) -> Vec<Problem<N>> {
    let recording = load(name);
    let first = |rows: &[Vec<f64>], k: usize| -> [f64; N] { std::array::from_fn(|j| rows[k][j]) };
    let state = |k| {
        let [q, qd, qdd] = [&recording.q, &recording.qd, &recording.qdd]
            .map(|rows| first(rows, k).map(|x| x as f32));
        Problem { state: State { q, qd, qdd }, truth: first(&recording.rnea, k) }
    };
    (0..recording.rnea.len()).map(state).collect()
}
