//! The linearisation against the arm itself, and the regulator against dynamic programming.

use dynamics_core::Core;
use dynamics_core::algorithms::{Linearisation, forward_dynamics_derivatives};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, Viscous};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::runge_kutta;
use dynamics_core::state::State;
use lqr_gains::{Deviations, LqrError, held, lqr, source};
use nalgebra::DMatrix;

const TICK: f64 = 2e-3;
const SCENE: (Gravity, Inertia, Coriolis, Viscous<f64, 6>, Armature<f64, 6>) =
    (Gravity::EARTH, Inertia, Coriolis, Viscous([2.0; 6]), Armature([0.3; 6]));

/// A UR5e in motion, and the torques that keep its velocity.
fn arm() -> (State<f64, 6, 6>, [f64; 6], Linearisation<f64, 6>) {
    let qd = [0.5, -1.0, 0.8, 1.0, -0.5, 2.0];
    let state = State { qd, ..State::at([0.2, -1.2, 1.5, 0.3, 0.7, 0.0]) };
    let tau = Core::<Ur5e>::rnea(&state, &SCENE);
    let by = forward_dynamics_derivatives(&Ur5e::MODEL, &state, &tau, &SCENE).expect("an arm");
    (state, tau, Linearisation::new(&Ur5e::MODEL, &by))
}

/// Gains of positions and velocities, and how often in a tick they act.
type Feedback = ([[[f64; 6]; 6]; 2], u32);

/// How far the arm is off after a tick, by simulation beside one that is not, under more torque and
/// feedback.
fn simulated([q, qd, more]: [[f64; 6]; 3], (gains, steps): &Feedback) -> [[f64; 6]; 2] {
    let (mut nominal, tau, _) = arm();
    let sum = |x: [f64; 6], y: [f64; 6], sign| core::array::from_fn(|i| x[i] + sign * y[i]);
    let mut moved = State { q: sum(nominal.q, q, 1.0), qd: sum(nominal.qd, qd, 1.0), ..nominal };
    let step = |at: &mut State<f64, 6, 6>, tau: [f64; 6]| {
        let h = TICK / f64::from(*steps);
        runge_kutta(&Ur5e::MODEL, at, &tau, &SCENE, h).expect("forward dynamics");
    };
    for _ in 0..*steps {
        let off = [sum(moved.q, nominal.q, -1.0), sum(moved.qd, nominal.qd, -1.0)];
        let mut by_feedback = sum(tau, more, 1.0);
        for (rows, x) in gains.iter().zip(&off) {
            let product = rows.map(|row| row.iter().zip(x).map(|(k, x)| k * x).sum());
            by_feedback = sum(by_feedback, product, -1.0);
        }
        step(&mut nominal, tau);
        step(&mut moved, by_feedback);
    }
    [sum(moved.q, nominal.q, -1.0), sum(moved.qd, nominal.qd, -1.0)]
}

/// The largest error of a column of a tick of the linear system, of what a simulation has.
fn of_tick(feedback: &Feedback, plant: &Linearisation<f64, 6>) -> f64 {
    let [phi, gamma] = held(plant, TICK);
    let error = |k: usize| {
        let mut off = [[0.0; 6]; 3];
        off[k / 6][k % 6] = 1e-4;
        let moved = simulated(off, feedback).concat();
        let column = if k < 12 { phi.column(k) } else { gamma.column(k - 12) };
        // The velocity changes the linear system within the tick: in proportion to it.
        let off = moved.iter().zip(&column).map(|(moved, entry)| (moved / 1e-4 - entry).abs());
        off.max_by(f64::total_cmp).expect("entries") / column.amax()
    };
    (0..18).map(error).max_by(f64::total_cmp).expect("columns")
}

#[test]
fn a_tick_of_the_linearisation_is_that_of_the_arm_alone_and_under_feedback() {
    let (_, _, plant) = arm();
    let alone = ([[[0.0; 6]; 6]; 2], 4);
    let entry = |pd, other, i: usize, j: usize| if i == j { pd } else { other * (2 * i) as f64 };
    let rows =
        |pd, other| core::array::from_fn(|i| core::array::from_fn(|j| entry(pd, other, i, j)));
    let held = ([rows(800.0, 20.0), rows(30.0, -0.5)], 50);
    let [by_q, by_qd] = &held.0;
    let controlled = plant.controlled(by_q, by_qd);
    for (feedback, system) in [(&alone, &plant), (&held, &controlled)] {
        let error = of_tick(feedback, system);
        assert!(error < 5e-3, "{error:.1e}");
    }
    assert!(of_tick(&held, &plant) > 0.02, "the feedback is too weak to be seen");

    let driven = controlled.driven_at([3, 1, 6]);
    assert_eq!((driven.dq, driven.dqd), (controlled.dq, controlled.dqd));
    for (few, all) in driven.du.iter().zip(&controlled.du) {
        assert_eq!(*few, [all[3], all[1], 0.0]);
    }
}

#[test]
fn the_regulator_is_that_of_dynamic_programming() {
    let (_, _, plant) = arm();
    let deviations = Deviations { q: [0.02; 6], qd: [0.5; 6], u: [10.0; 6] };
    let k = lqr(&plant, TICK, &deviations).expect("gains");
    let [a, b] = held(&plant, TICK);
    let diagonal = |x: Vec<f64>| DMatrix::from_diagonal(&nalgebra::DVector::from_vec(x));
    let q = diagonal([[2500.0; 6], [4.0; 6]].concat());
    let (mut p, mut last) = (q.clone(), k.clone());
    for _ in 0..5000 {
        let inner = diagonal(vec![0.01; 6]) + b.transpose() * &p * &b;
        last = inner.try_inverse().expect("positive") * b.transpose() * &p * &a;
        p = &q + a.transpose() * &p * (&a - &b * &last);
    }
    let error = (&k - &last).amax() / k.amax();
    assert!(error < 1e-9, "{error:.1e}");
}

#[test]
fn what_no_input_reaches_and_what_is_no_number_has_no_gains() {
    let falls =
        Linearisation { dq: [[9.0, 0.0], [0.0, 0.0]], dqd: [[0.0; 2]; 2], du: [[0.0], [1.0]] };
    let deviations = Deviations { q: [0.1; 2], qd: [1.0; 2], u: [1.0] };
    let unreached = |coordinate| Err(LqrError::NotReached(coordinate));
    assert_eq!(lqr(&falls, TICK, &deviations), unreached(0));
    // A yaw that no input drives: free, damped, and without a weight.
    let yaw = Linearisation { du: [[1.0], [0.0]], ..falls };
    assert_eq!(lqr(&yaw, TICK, &deviations), unreached(1));
    let damped = Linearisation { dqd: [[0.0; 2], [0.0, -0.5]], ..yaw };
    assert_eq!(lqr(&damped, TICK, &deviations), unreached(1));
    let ignored = Deviations { q: [0.1, f64::INFINITY], qd: [1.0, f64::INFINITY], u: [1.0] };
    assert_eq!(lqr(&yaw, TICK, &ignored), unreached(1));
    // The angle of a wheel that is driven and has no weight.
    let wheel = Linearisation { dq: [[9.0, 0.0], [-3.0, 0.0]], du: [[-1.0], [2.0]], ..falls };
    let unseen = Deviations { qd: [1.0; 2], ..ignored };
    let found = lqr(&wheel, TICK, &unseen);
    assert_eq!(found, Err(LqrError::NotWeighted(1)));
    assert!(
        found.expect_err("no weight").to_string().contains("mostly of coordinate 1, has no weight")
    );
    assert!(lqr(&wheel, TICK, &deviations).is_ok());
    let reached = Linearisation { du: [[1.0], [1.0]], ..falls };
    assert!(lqr(&reached, TICK, &deviations).is_ok());
    let none = Deviations { u: [0.0], ..deviations };
    assert_eq!(lqr(&reached, TICK, &none), Err(LqrError::NotFinite));
    let broken = Linearisation { dq: [[f64::NAN; 2]; 2], ..reached };
    assert_eq!(lqr(&broken, TICK, &deviations), Err(LqrError::NotFinite));
}

#[test]
fn the_source_is_read_as_the_same_numbers() {
    let k = DMatrix::from_row_slice(2, 2, &[1.0, 1.0 / 3.0, -2e-9, 7e6]);
    let source = source(&[k.clone(), k]);
    let numbers: Vec<f32> = source
        .split(|c: char| c.is_whitespace() || "[],".contains(c))
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().expect("a number"))
        .collect();
    assert_eq!(numbers, [[1.0, 1.0 / 3.0, -2e-9, 7e6]; 2].concat());
}

/// The largest error of a column of a tick by `after`, of its own largest entry, or of 10⁻⁶ of it
/// where it is smaller.
fn error_of_after(plant: &Linearisation<f64, 6>, h: f64) -> f64 {
    let [phi, gamma] = held(plant, h);
    let error = |k: usize| {
        let mut x = [[0.0; 6]; 3];
        x[k / 6][k % 6] = 1.0;
        let got = plant.after(&[x[0], x[1]], &x[2], h).concat();
        let column = if k < 12 { phi.column(k) } else { gamma.column(k - 12) };
        let off = got.iter().zip(&column).map(|(got, entry)| (got - entry).abs());
        off.max_by(f64::total_cmp).expect("entries") / column.amax()
    };
    (0..18).map(error).max_by(f64::total_cmp).expect("columns")
}

#[test]
fn a_tick_that_is_long_for_the_system_is_exact_but_for_rounding() {
    // A wrist with the friction of a shoulder and no rotors: its fastest rate is 31,361 1/s.
    let stiff = (Gravity::EARTH, Inertia, Coriolis, Viscous([8.0; 6]));
    let state = State::at([0.2, -1.2, 1.5, 0.3, 0.7, 0.0]);
    let tau = Core::<Ur5e>::rnea(&state, &stiff);
    let by = forward_dynamics_derivatives(&Ur5e::MODEL, &state, &tau, &stiff).expect("an arm");
    let plant = Linearisation::new(&Ur5e::MODEL, &by);
    for h in [1e-5, 1e-4, 5e-4, 2e-3, 0.1] {
        let error = error_of_after(&plant, h);
        assert!(error < 1e-11, "{h} s: {error:e}");
    }
    // The series by itself has lost all digits there, which this bound notices.
    let x = [[0.0; 6], [0.0, 0.0, 0.0, 0.0, 0.0, 0.01]];
    let mut series = x;
    let mut term = x;
    for k in 1..26 {
        term = plant.rates(&term, &[0.0; 6]).map(|x| x.map(|x| x * 2e-3 / f64::from(k)));
        for (sum, term) in series.iter_mut().flatten().zip(term.iter().flatten()) {
            *sum += term;
        }
    }
    assert!(series[1][5].abs() > 1e6, "{}", series[1][5]);
}

#[test]
fn a_joint_that_stops_within_a_tick_and_numbers_that_are_none_end_as_they_should() {
    for (rate, h) in [(10.0_f64, 1.0), (40.0, 1.0), (5e5, 2e-3), (1e12, 1.0)] {
        let joint = Linearisation { dq: [[0.0]], dqd: [[-rate]], du: [[1.0]] };
        let [[q], [qd]] = joint.after(&[[0.5], [3.0]], &[2.0], h);
        let (decay, still): (f64, f64) = ((-rate * h).exp(), 2.0 / rate);
        let travelled = (3.0 - still) * (1.0 - decay) / rate + still * h;
        assert!((q - 0.5 - travelled).abs() < 1e-13, "{rate}: {q}");
        assert!((qd - still - (3.0 - still) * decay).abs() < 1e-12 * 3.0, "{rate}: {qd}");
    }
    let lost = Linearisation { dq: [[0.0]], dqd: [[f64::NEG_INFINITY]], du: [[1.0]] };
    assert!(!lost.after(&[[0.5], [3.0]], &[2.0], 1.0)[1][0].is_finite());
}
