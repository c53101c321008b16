//! Inverse dynamics: errors over states anywhere and along the robot's way.

use dynamics_core::Core;
use dynamics_core::control::Reference;
use dynamics_core::drivetrain::{ElasticReference, elastic_inverse_dynamics};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Static;
use dynamics_core::state::State;
use firmware_demo::accuracy::robots::{Compared, Swung, momentary};
use firmware_demo::accuracy::{Inverse, Visitor, list};
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use host_tests::recordings::{Precise, Recording, load, read};
use serde_json::{Value, json};

use super::statistics::Errors;
use super::{speed, yardsticks};

/// States beside those recorded, whose oracle is our f64.
const MORE_STATES: usize = 2000;

/// Ticks that the robot rests before it goes, so that its way-points, where the torque bends, fall between the ticks
/// that compute: elsewhere, what rates lose would look too small.
const REST: u32 = 3;

/// What every way of a robot is held against.
pub struct Bench<const N: usize> {
    /// What the lines call them.
    kind: &'static str,
    robot: &'static str,
    /// What its joints are: `rigid` or `compliant`.
    plant: &'static str,
    full_scale: f64,
    /// How far the oracle itself is off, N·m: smaller errors are given as that.
    floor: f64,
    states: Vec<Asked<N>>,
    way: Vec<Asked<N>>,
}

/// Where the joints are to be, and the torques of it.
pub struct Asked<const N: usize> {
    pub course: ElasticReference<f32, N, N>,
    pub truth: [f64; N],
}

impl<const N: usize> Visitor<N> for Bench<N> {
    fn way<W: Inverse<N>>(&mut self) {
        let run = |asked: &[Asked<N>]| {
            let mut errors = Errors::<N>::new();
            let mut way = W::start(&asked[0].course.state);
            for (k, Asked { truth, .. }) in asked.iter().enumerate() {
                let given = &asked[(k + W::AHEAD).min(asked.len() - 1)];
                errors.add(&W::torque(&way.tick(&W::input(&given.course))), truth);
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
            "kind": self.kind,
            "plant": self.plant,
            "key": W::KEY.to_string(),
            "configuration": configuration,
            "unit": "N·m",
            "full_scale": self.full_scale,
            "error_max": largest([along.error_max, self.floor]),
            "error_rms": largest([along.error_rms, self.floor]),
            "error_p99": largest([along.error_p99, self.floor]),
            "relative_max": largest([along.relative_max, self.floor / self.full_scale]),
            "trajectory": along,
        });
        if !W::MEMORY && !self.states.is_empty() {
            line["states"] = json!(run(&self.states));
        }
        println!("{line}");
    }
}

/// Prints a line for each of these ways of the robot T, and for those that are printed to be pasted.
pub fn print<T: Compared<B, N, W>, const B: usize, const N: usize, const W: usize>(
    ways: fn(&mut Bench<N>),
) {
    let recording = load(T::RECORDED);
    let recorded = recorded_states::<N>(&recording);
    let full_scale = full_scale(&recorded);
    let ours = Errors::of(recorded.iter().map(|asked| {
        let state = widened(&asked.course.state);
        (Core::<T>::rnea(&state, &RIGID_BODY), asked.truth)
    }));
    let ours = ours.summary(full_scale);
    let precise: Precise = read("precise");
    let sample = precise.states.iter().zip(precise.rnea(T::RECORDED));
    let sample = Errors::<N>::of(sample.map(|(&k, tau)| {
        let state = widened(&recorded[k].course.state);
        let truth = std::array::from_fn(|j| tau[j]);
        (Core::<T>::rnea(&state, &RIGID_BODY), truth)
    }));
    println!(
        "{}",
        json!({
            "robot": T::MODEL.name,
            "kind": "oracle",
            "pinocchio": recording.pinocchio,
            "full_scale": full_scale,
            "f64_against_recorded": ours,
            "f64_against_50_digits": sample.summary(full_scale),
        })
    );
    let asked = |state| Asked {
        course: momentary(state),
        truth: Core::<T>::rnea(&widened(&state), &RIGID_BODY),
    };
    let way = T::way().expect("the robot can go there");
    let ticks = 0..=way.ticks() + REST;
    let way: Vec<_> = ticks
        .map(|tick| asked(way.at(tick.saturating_sub(REST))))
        .collect();
    yardsticks::print::<T, B, N>(full_scale, &way);
    speed::print::<T, B, N>(full_scale);
    let mut random = random_numbers();
    let more = (0..MORE_STATES).map(|_| {
        let mut numbers = |bound| within::<N>(&mut random, bound).map(|x| x as f32);
        asked(State {
            q: numbers(std::f64::consts::PI),
            qd: numbers(3.0),
            qdd: numbers(10.0),
        })
    });
    let mut bench = Bench {
        kind: "inverse",
        robot: T::MODEL.name,
        plant: "rigid",
        full_scale,
        floor: ours.error_max,
        states: recorded.into_iter().chain(more).collect(),
        way,
    };
    ways(&mut bench);
    bench.kind = "pasted";
    T::pasted(&mut bench);
}

#[allow(dead_code, reason = "the quick bin has no such joints")]
/// Prints a line for each way of the arm T on joints that give way.
pub fn print_compliant<T, const N: usize, const W: usize>()
where
    T: Compared<N, N, W> + Swung<N>,
{
    let swing = T::swing().expect("the arm can swing there");
    let asked = |tick| {
        let course = swing.course(tick);
        let double = ElasticReference {
            state: widened(&course.state),
            jerk: course.jerk.map(f64::from),
            snap: course.snap.map(f64::from),
        };
        let told = elastic_inverse_dynamics(&Static::<T>::NEW, &T::joints(), &double, &RIGID_BODY);
        Asked {
            course,
            truth: told.expect("joints of one freedom").torque,
        }
    };
    list::compliant::<T, N>(&mut Bench {
        kind: "inverse",
        robot: T::MODEL.name,
        plant: "compliant",
        full_scale: full_scale(&recorded_states::<N>(&load(T::RECORDED))),
        floor: 0.0,
        states: Vec::new(),
        way: (0..=swing.ticks()).map(asked).collect(),
    });
}

fn full_scale<const N: usize>(recorded: &[Asked<N>]) -> f64 {
    let truths = recorded.iter().flat_map(|asked| asked.truth);
    truths.fold(0.0, |most, tau| most.max(tau.abs()))
}

fn recorded_states<const N: usize>(recording: &Recording) -> Vec<Asked<N>> {
    let first = |row: &Vec<f64>| -> [f64; N] { std::array::from_fn(|j| row[j]) };
    let rows = recording.q.iter().zip(&recording.qd).zip(&recording.qdd);
    rows.zip(&recording.rnea)
        .map(|(((q, qd), qdd), tau)| Asked {
            course: momentary(State {
                q: first(q).map(|x| x as f32),
                qd: first(qd).map(|x| x as f32),
                qdd: first(qdd).map(|x| x as f32),
            }),
            truth: first(tau),
        })
        .collect()
}

/// The same state in f64.
pub fn widened<const N: usize>(state: &State<f32, N, N>) -> State<f64, N, N> {
    State {
        q: state.q.map(f64::from),
        qd: state.qd.map(f64::from),
        qdd: state.qdd.map(f64::from),
    }
}
