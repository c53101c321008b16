//! Inverse dynamics: errors over states anywhere and along the robot's way.

use dynamics_core::Core;
use dynamics_core::control::WayPoint;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use firmware_demo::accuracy::{Inverse, Visitor, list};
use firmware_demo::trajectories::reference;
use host_tests::random::{random_numbers, within};
use host_tests::recordings::{Recording, load};
use serde_json::{Value, json};

use super::statistics::Errors;

/// States beside those recorded, whose oracle is our f64.
const MORE_STATES: usize = 2000;

/// What every way of a robot is held against.
pub struct Bench<const N: usize> {
    robot: &'static str,
    full_scale: f64,
    states: Vec<Asked<N>>,
    way: Vec<Asked<N>>,
}

/// A state and its torques.
struct Asked<const N: usize> {
    state: State<f32, N, N>,
    truth: [f64; N],
}

impl<const N: usize> Visitor<N> for Bench<N> {
    fn way<W: Inverse<N>>(&mut self) {
        let run = |asked: &[Asked<N>]| {
            let mut errors = Errors::<N>::new();
            let mut way = W::start(&asked[0].state);
            for Asked { state, truth } in asked {
                errors.add(&W::torque(&way.tick(&W::input(state))), truth);
            }
            errors.summary(self.full_scale)
        };
        let along = run(&self.way);
        let configuration: serde_json::Map<String, Value> = W::KEY
            .axes()
            .map(|(axis, value)| (axis.to_owned(), json!(value)))
            .into_iter()
            .collect();
        let mut line = json!({
            "robot": self.robot,
            "kind": "inverse",
            "key": W::KEY.to_string(),
            "configuration": configuration,
            "unit": "N·m",
            "full_scale": self.full_scale,
            "error_max": along.error_max,
            "error_rms": along.error_rms,
            "error_p99": along.error_p99,
            "relative_max": along.relative_max,
            "trajectory": along,
        });
        if !W::MEMORY {
            line["states"] = json!(run(&self.states));
        }
        println!("{line}");
    }
}

/// Prints a line for each way of the robot T, recorded under this name, whose first N coordinates are T's.
pub fn print<T: Robot<B, N, N>, const B: usize, const N: usize, const W: usize>(
    recorded: &'static str,
    points: &[WayPoint<f32, N>; W],
) {
    let recording = load(recorded);
    let mut states = recorded_states(&recording);
    let truths = states.iter().map(|asked| asked.truth.map(f64::abs));
    let full_scale = truths.flatten().fold(0.0, f64::max);
    let ours = Errors::<N>::of(states.iter().map(|asked| (double::<T, B, N>(&asked.state), asked.truth)));
    println!(
        "{}",
        json!({
            "robot": T::MODEL.name,
            "kind": "oracle",
            "pinocchio": recording.pinocchio,
            "recorded": states.len(),
            "f64_against_recorded": ours.summary(full_scale),
        })
    );
    let mut random = random_numbers();
    let asked = |state| Asked {
        state,
        truth: double::<T, B, N>(&state),
    };
    states.extend((0..MORE_STATES).map(|_| {
        let mut numbers = |bound| within::<N>(&mut random, bound).map(|x| x as f32);
        asked(State {
            q: numbers(std::f64::consts::PI),
            qd: numbers(3.0),
            qdd: numbers(10.0),
        })
    }));
    let way = reference::<T, B, N, W>(points).expect("the robot can go there");
    let way = (0..=way.ticks()).map(|tick| asked(way.at(tick))).collect();
    list::inverse::<T, B, N>(&mut Bench {
        robot: T::MODEL.name,
        full_scale,
        states,
        way,
    });
}

fn recorded_states<const N: usize>(recording: &Recording) -> Vec<Asked<N>> {
    let first = |row: &Vec<f64>| -> [f64; N] { std::array::from_fn(|j| row[j]) };
    let rows = recording.q.iter().zip(&recording.qd).zip(&recording.qdd);
    rows.zip(&recording.rnea)
        .map(|(((q, qd), qdd), tau)| Asked {
            state: State {
                q: first(q).map(|x| x as f32),
                qd: first(qd).map(|x| x as f32),
                qdd: first(qdd).map(|x| x as f32),
            },
            truth: first(tau),
        })
        .collect()
}

/// Our f64.
fn double<T: Robot<B, N, N>, const B: usize, const N: usize>(
    state: &State<f32, N, N>,
) -> [f64; N] {
    let state = State {
        q: state.q.map(f64::from),
        qd: state.qd.map(f64::from),
        qdd: state.qdd.map(f64::from),
    };
    Core::<T>::rnea(&state, &RIGID_BODY)
}
