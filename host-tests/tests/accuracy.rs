//! The ways to compute that `cargo xtask accuracy` compares: that there are enough of them, each
//! once, and that the default and its oracle are as good as the report says.

use std::collections::BTreeSet;

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1Leg, Panda, Ur5e};
use dynamics_core::state::State;
use dynamics_core::trig::{Kernel, Minimax, Table};
use dynamics_core::{Core, Engine};
use fixtures::accuracy::key::Key;
use fixtures::accuracy::model::Rounded;
use fixtures::accuracy::simulation::{self, DoublePendulum};
use fixtures::accuracy::{Inverse, Visitor, list};
use host_tests::carried;
use host_tests::measured::largest;
use host_tests::recordings::{Precise, load, read};
use host_tests::tolerances::check;
use motion_control::law::{FirstOrderHold, InertiaUpdate};
use serde_json::Value;

#[derive(Default)]
struct Names(Vec<String>);

impl<const N: usize> Visitor<N> for Names {
    fn way<W: Inverse<N>>(&mut self) {
        self.0.push(W::KEY.to_string());
    }
}

impl<const N: usize> simulation::Visitor<N> for Names {
    fn simulation<S: simulation::Simulation<N>>(&mut self) {
        self.0.push(S::KEY.to_string());
    }
}

fn names<T: Robot<B, N, N>, const B: usize, const N: usize>() -> Vec<String> {
    let mut names = Names::default();
    list::inverse::<T, B, N>(&mut names);
    names.0
}

fn distinct(names: &[String]) -> usize {
    names.iter().collect::<BTreeSet<_>>().len()
}

#[test]
fn each_robot_has_80_configurations_default_first() {
    for names in [names::<Ur5e, 6, 6>(), names::<Panda, 7, 7>(), names::<A1Leg, 4, 3>()] {
        assert!(names.len() >= 80, "{}", names.len());
        assert_eq!(distinct(&names), names.len());
        assert_eq!(names[0], Key::DEFAULT.to_string());
        // One word, as the firmware's log has it.
        assert!(names.iter().all(|name| !name.contains(' ') && name.len() <= 96));
    }
}

/// By how much the cheapest of these configurations of a robot exceeds the cheapest of all of them,
/// for each error that may be allowed: 1, 1.1, 1.2 … N·m times a power of ten, from the default's
/// error on.
fn excess(recorded: &[Value], robot: &str, these: &[String], cost: &str) -> Vec<f64> {
    let of = |point: &&Value| {
        let [model, trig] = ["model", "trig"].map(|axis| point["configuration"][axis].as_str());
        // The library ships neither rounded parameters nor sines of others.
        let shipped = !model.is_some_and(|name| name.starts_with("params"))
            && !matches!(trig, Some("libm" | "micromath"));
        shipped && point["robot"] == robot && point["kind"] == "inverse"
    };
    let points: Vec<&Value> = recorded.iter().filter(of).collect();
    let number = |point: &Value, name: &str| point[name].as_f64().unwrap_or(f64::INFINITY);
    let is_one = |point: &Value| these.iter().any(|key| point["key"] == **key);
    let read = |point: &&Value| (number(point, "error_max"), number(point, cost), is_one(point));
    let costs: Vec<(f64, f64, bool)> = points.iter().map(read).collect();
    let default = points.iter().find(|point| point["key"] == "default").expect("the default");
    let least = number(default, "error_max");
    let decade = |ten| (10..100).map(move |digits| 0.1 * f64::from(digits) * 10_f64.powi(ten));
    let allowed = (-8..2).flat_map(decade).filter(|allowed| *allowed >= least);
    let excess = allowed.map(|allowed| {
        let within = costs.iter().filter(|(error, ..)| *error <= allowed);
        let cheapest = |wanted: fn(bool) -> bool| {
            let wanted = within.clone().filter(|(.., one)| wanted(*one));
            wanted.map(|(_, cost, _)| *cost).fold(f64::INFINITY, f64::min)
        };
        cheapest(|one| one) / cheapest(|_| true) - 1.0
    });
    excess.collect()
}

#[test]
fn the_candidates_for_a_file_are_as_good_as_all() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/accuracy.json");
    let text = std::fs::read_to_string(path).expect("the record");
    let recorded: Vec<Value> = serde_json::from_str(&text).expect("points");
    let mut candidates = Names::default();
    list::candidates::<Ur5e, 6, 6>(&mut candidates);
    let Names(mut candidates) = candidates;
    for robot in ["ur5e", "panda", "a1_leg"] {
        let worst = largest(excess(&recorded, robot, &candidates, "cycles"));
        assert!(worst <= 0.03, "{robot}: the worst tick takes {worst:.3} more");
        let mean = excess(&recorded, robot, &candidates, "cycles_mean");
        let beyond = mean.iter().filter(|excess| **excess > 0.1).count();
        assert!(100 * beyond <= mean.len(), "{robot}: {beyond} of {} means", mean.len());
    }
    // Without one of them they are not.
    candidates.retain(|key| key != "trig=table,model=pruned1000");
    assert!(largest(excess(&recorded, "ur5e", &candidates, "cycles")) > 0.03);
}

#[test]
fn every_simulation_configuration_occurs_once() {
    let mut names = Names::default();
    simulation::every::<DoublePendulum, 2>(&mut names);
    assert_eq!(distinct(&names.0), names.0.len());
    assert!(names.0.iter().any(|name| name == "default"));
}

/// Over the states recorded of a robot whose first coordinates are T's: the largest errors of `run`
/// and of our f64, relative to full scale.
fn recorded<T: Robot<B, N, N>, const B: usize, const N: usize>(
    name: &str,
    run: impl Fn(&State<f32, N, N>) -> [f32; N],
) -> [f64; 2] {
    let recording = load(name);
    let (mut scale, mut worst) = (0.0_f64, [0.0_f64; 2]);
    for (k, truth) in recording.rnea.iter().enumerate() {
        let first = |rows: &[Vec<f64>]| -> [f64; N] { std::array::from_fn(|j| rows[k][j]) };
        let [q, qd, qdd] = [&recording.q, &recording.qd, &recording.qdd].map(|rows| first(rows));
        let double = Core::<T>::rnea(&State { q, qd, qdd }, &RIGID_BODY);
        let [q, qd, qdd] = [q, qd, qdd].map(|numbers| numbers.map(|x| x as f32));
        let single = run(&State { q, qd, qdd });
        for j in 0..N {
            scale = scale.max(truth[j].abs());
            worst[0] = largest([worst[0], (f64::from(single[j]) - truth[j]).abs()]);
            worst[1] = largest([worst[1], (double[j] - truth[j]).abs()]);
        }
    }
    worst.map(|error| error / scale)
}

// This holds on all recorded states.
#[test]
fn the_default_is_within_3e_7_of_full_scale() {
    let errors = [
        recorded::<Ur5e, 6, 6>("ur5e", |state| Engine::<Ur5e>::rnea(state, &RIGID_BODY)),
        recorded::<Panda, 7, 7>("panda", |state| Engine::<Panda>::rnea(state, &RIGID_BODY)),
        recorded::<A1Leg, 4, 3>("a1", |state| Engine::<A1Leg>::rnea(state, &RIGID_BODY)),
    ];
    for [single, double] in errors {
        assert!(single <= 3e-7, "{single:.1e}");
        assert!(double <= 1e-13, "{double:.1e}");
    }
}

#[test]
fn f64_is_good_to_1e_13_by_50_digits() {
    fn worst<T: Robot<B, N, N>, const B: usize, const N: usize>(name: &str) -> f64 {
        let (recording, precise) = (load(name), read::<Precise>("precise"));
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        for (&k, truth) in precise.states.iter().zip(precise.rnea(name)) {
            let first = |rows: &[Vec<f64>]| -> [f64; N] { std::array::from_fn(|j| rows[k][j]) };
            let state = State {
                q: first(&recording.q),
                qd: first(&recording.qd),
                qdd: first(&recording.qdd),
            };
            for (torque, truth) in Core::<T>::rnea(&state, &RIGID_BODY).iter().zip(truth) {
                scale = scale.max(truth.abs());
                worst = largest([worst, (torque - truth).abs()]);
            }
        }
        worst / scale
    }
    for error in
        [worst::<Ur5e, 6, 6>("ur5e"), worst::<Panda, 7, 7>("panda"), worst::<A1Leg, 4, 3>("a1")]
    {
        assert!(error <= 1e-13, "{error:.1e}");
    }
}

/// The largest error of a kernel over ±`range` rad.
fn worst_of<K: Kernel<f32>>(range: f64) -> f64 {
    const POINTS: i32 = 200_000;
    let at = |k: i32| {
        let x = (f64::from(k) / f64::from(POINTS) * range) as f32;
        let (s, c) = K::sin_cos(x);
        let (sin, cos) = f64::from(x).sin_cos();
        largest([f64::from(s) - sin, f64::from(c) - cos].map(f64::abs))
    };
    largest((-POINTS..=POINTS).map(at))
}

#[test]
fn kernels_are_within_their_stated_error() {
    let errors = [
        ("minimax of degree 3", worst_of::<Minimax<3, 2>>(100.0)),
        ("minimax of degree 5", worst_of::<Minimax<5, 2>>(100.0)),
        ("minimax of degree 7", worst_of::<Minimax<7, 2>>(100.0)),
        ("minimax of degree 7, 3 parts", worst_of::<Minimax<7, 3>>(1e4)),
        ("table of 256, order 1", worst_of::<Table<256, 1>>(100.0)),
        ("table of 256, order 2", worst_of::<Table<256, 2>>(100.0)),
        ("table of 64, order 4", worst_of::<Table<64, 4>>(100.0)),
    ];
    let results = errors.map(|(kernel, error)| check("trig", kernel, "f32", error));
    let failed: Vec<_> = results.into_iter().filter_map(Result::err).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn carried_sines_do_not_drift_in_any_motion() {
    let errors = carried::motions().into_iter().map(|(name, first, mut motion)| {
        let error = carried::worst_error::<7>(20_000, first, &mut motion);
        println!("{name}: {error:.1e}");
        error
    });
    check("trig", "carried, seven joints", "f32", largest(errors)).unwrap();
}

#[test]
fn torque_between_computations_is_exact_where_it_is_linear() {
    let mut extrapolated = FirstOrderHold::<f64, 1, 4>::start();
    let mut linearised = InertiaUpdate::<f64, 6, 4>::start();
    let at = |tick: usize| State {
        qdd: [(tick % 7) as f64; 6], // jumps
        ..State::at([0.3; 6])
    };
    for tick in 0..40 {
        let (line, state) = (2.0 + 0.5 * tick as f64, at(tick));
        let computed = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
        let torque = if tick % 4 == 0 {
            let m = Core::<Ur5e>::crba(&state.q, &RIGID_BODY);
            linearised.update(computed, m, &state.qdd)
        } else {
            linearised.hold(&state.qdd)
        };
        let goes_on = if tick % 4 == 0 { extrapolated.update([line]) } else { extrapolated.hold() };
        assert!(torque.iter().zip(computed).all(|(a, b)| (a - b).abs() < 1e-12));
        assert!(tick < 4 || (goes_on[0] - line).abs() < 1e-12);
    }
}

#[test]
fn a_rounded_robot_has_rounded_parameters() {
    let rounded = <Rounded<Ur5e, 8> as Robot<6, 6, 6>>::MODEL;
    assert_eq!(rounded.links[1].inertia.mass, 8.0625); // kg, of 8.058
}
