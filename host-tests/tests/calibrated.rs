//! Calibration in the frames of the description: numbers that the description was made from give
//! the same model.

use dynamics_core::algorithms::{aba, forward_dynamics, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{
    BASE, Body, BodyInertia, Calibrated, Joint, Model, ModelError, Problem, Robot, RobotModel,
    Static, model,
};
use dynamics_core::robots::{Iiwa14, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// Axes along none of x, y, z, a body that is welded on, and one without mass.
const fn odd(forearm: BodyInertia<f64>) -> Model<f64, 4, 2, 2> {
    Model::new(
        "odd",
        [
            Body::new("arm", BASE, Joint::revolute([0.3, -0.5, 0.8]))
                .xyz([0.1, 0.0, 0.2])
                .rpy([0.4, -0.2, 0.7])
                .mass(3.0)
                .com([0.1, -0.05, 0.2])
                .inertia([0.05, 0.002, -0.003, 0.06, 0.001, 0.04]),
            Body::new("plate", 0, Joint::fixed())
                .xyz([0.2, 0.1, 0.0])
                .rpy([-0.3, 0.5, 0.1])
                .mass(0.5)
                .com([0.02, 0.0, 0.01])
                .inertia([0.001, 0.0, 0.0, 0.001, 0.0002, 0.0015]),
            Body::new("forearm", 1, Joint::revolute([-0.6, 0.1, 0.2]))
                .xyz([0.3, -0.1, 0.1])
                .rpy([0.9, 0.2, -0.6])
                .mass(forearm.mass)
                .com(forearm.com)
                .inertia(forearm.inertia),
            Body::new("frame", 2, Joint::fixed()).rpy([0.2, 0.0, 0.0]),
        ],
    )
}

const DESCRIBED: BodyInertia<f64> = BodyInertia {
    mass: 1.5,
    com: [0.12, 0.03, -0.04],
    inertia: [0.012, 0.001, -0.002, 0.02, 0.0005, 0.015],
};
const IDENTIFIED: BodyInertia<f64> = BodyInertia {
    mass: 1.9,
    com: [0.15, -0.01, 0.02],
    inertia: [0.02, -0.003, 0.001, 0.03, 0.002, 0.025],
};

struct StressRobot;
impl Robot<4, 2, 2> for StressRobot {
    const MODEL: Model<f64, 4, 2, 2> = odd(DESCRIBED);
}

const FOREARM: usize = StressRobot::MODEL.body("forearm");

/// The largest difference of the bodies' inertias, relative to the largest number of each.
fn apart<const B: usize, const Q: usize, const V: usize>(
    a: &Model<f64, B, Q, V>,
    b: &Model<f64, B, Q, V>,
) -> f64 {
    let mut worst = 0.0_f64;
    for (a, b) in a.links.iter().zip(&b.links) {
        let numbers = |link: &dynamics_core::model::Link<f64>| {
            let i = link.inertia;
            let mut numbers = i.rotational.to_cols_array().to_vec();
            numbers.extend(i.first_moment.to_array());
            numbers.push(i.mass);
            numbers
        };
        let (a, b) = (numbers(a), numbers(b));
        let size = b.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
        for (a, b) in a.into_iter().zip(b) {
            assert!((a - b).is_finite());
            if a != b {
                worst = worst.max((a - b).abs() / size);
            }
        }
    }
    worst
}

/// Sets every body to what it is described as, out of what `scrambled` has made of it.
fn described_again<T, const B: usize, const Q: usize, const V: usize>() -> f64
where
    T: Robot<B, Q, V>,
{
    let nominal = Calibrated::<T, f64, B, Q, V>::nominal();
    let mut arm = Calibrated::<T, f64, B, Q, V>::nominal();
    for body in 0..B {
        arm.set_inertia(body, IDENTIFIED, 0.0).expect("a body can be like that");
    }
    assert!(apart(arm.model(), nominal.model()) > 0.1);
    for body in 0..B {
        let inertia = nominal.inertia(body).expect("the robot has this body");
        // The published Panda passes by a hair, which rounding may cost it.
        arm.set_inertia(body, inertia, 1e-9).expect("the robot itself");
    }
    apart(arm.model(), nominal.model())
}

#[test]
fn described_numbers_reproduce_the_model() {
    assert!(described_again::<Ur5e, 6, 6, 6>() < 1e-15);
    assert!(described_again::<Panda, 7, 7, 7>() < 1e-15);
    assert!(described_again::<StressRobot, 4, 2, 2>() < 2e-15);
    let inertia =
        Calibrated::<StressRobot, f64, 4, 2, 2>::nominal().inertia(FOREARM).expect("a body");
    let pairs = [(inertia.com, DESCRIBED.com)].map(|(a, b)| (a.to_vec(), b.to_vec()));
    let more = (inertia.inertia.to_vec(), DESCRIBED.inertia.to_vec());
    for (got, want) in pairs.into_iter().chain([more]) {
        for (got, want) in got.into_iter().zip(want) {
            assert!((got - want).abs() < 2e-16, "{got} for {want}");
        }
    }
    assert_eq!(inertia.mass, DESCRIBED.mass);
}

// Both have the same numbers.
#[test]
fn calibrated_and_described_robots_need_equal_torques() {
    let mut arm = Calibrated::<StressRobot, f64, 4, 2, 2>::nominal();
    arm.set_inertia(FOREARM, IDENTIFIED, 0.0).expect("a body can be like that");
    let state = State { q: [0.4, -0.9], qd: [1.1, -0.6], qdd: [2.0, 3.0] };
    let got = rnea(&arm, &state, &RIGID_BODY);
    let want = rnea(&odd(IDENTIFIED), &state, &RIGID_BODY);
    let before = rnea(&StressRobot::MODEL, &state, &RIGID_BODY);
    for (i, (got, want)) in got.into_iter().zip(want).enumerate() {
        assert!((got - want).abs() < 2e-14, "{got} for {want}");
        assert!((want - before[i]).abs() > 0.1);
    }
}

#[test]
fn an_impossible_inertia_is_named_and_not_taken_over() {
    let mut arm = Calibrated::<StressRobot, f64, 4, 2, 2>::nominal();
    arm.set_inertia(FOREARM, IDENTIFIED, 0.0).expect("a body can be like that");
    let good = *arm.model();
    let mut refused = |body, inertia| -> ModelError {
        let error = arm.set_inertia(body, inertia, 1e-6).expect_err("no body is like that");
        assert_eq!(*arm.model(), good);
        error
    };
    let mut problem = |inertia| {
        let error = refused(FOREARM, inertia);
        assert_eq!(error.body, "forearm");
        error.problem
    };
    let changed = |change: fn(&mut BodyInertia<f64>)| {
        let mut inertia = IDENTIFIED;
        change(&mut inertia);
        inertia
    };
    assert_eq!(problem(changed(|i| i.mass = -0.1)), Problem::Mass(-0.1));
    assert_eq!(problem(changed(|i| i.mass = f64::NAN)), Problem::NotFinite);
    assert_eq!(problem(changed(|i| i.com[1] = f64::INFINITY)), Problem::NotFinite);
    assert_eq!(problem(changed(|i| i.inertia[4] = f64::NAN)), Problem::NotFinite);
    assert_eq!(problem(changed(|i| i.mass = 0.0)), Problem::Massless);
    let long = |i: &mut BodyInertia<f64>| i.inertia = [0.05, 0.0, 0.0, 0.02, 0.0, 0.02];
    let Problem::Triangle(excess) = problem(changed(long)) else {
        panic!("0.05 exceeds 0.02 + 0.02");
    };
    assert!((excess - 0.2).abs() < 1e-12, "{excess}");
    let error = refused(4, IDENTIFIED);
    assert_eq!((error.body, error.problem), ("odd", Problem::NoBody(4)));
    assert_eq!(error.to_string(), "body `odd`: the robot has no body of this number: 4");
    assert_eq!(arm.inertia(4), None);
}

/// A state in which everything moves.
fn moving<R: Real, const N: usize>() -> (State<R, N, N>, [R; N]) {
    let rows = [1.0, 0.7, -2.0]
        .map(|scale| std::array::from_fn(|i| R::from_f64(scale * (1.3 * i as f64 + scale).sin())));
    let [q, qd, qdd] = rows;
    (State { q, qd, qdd }, qdd)
}

/// Whether ABA of T crosses its links by screws.
fn screws_alike<R: Real, T: Robot<N, N, N>, const N: usize>() -> Option<bool> {
    let (state, tau) = moving::<R, N>();
    let read = model::<R, T, N, N, N>();
    let known = aba(&Static::<T>::NEW, &state, &tau, &RIGID_BODY);
    assert!(known.is_ok());
    assert_eq!(known, aba(read, &state, &tau, &RIGID_BODY));
    <Static<T> as RobotModel<R, N, N, N>>::SCREWS
}

#[test]
fn aba_has_the_same_bits_over_a_known_and_a_read_robot() {
    let screws = [
        screws_alike::<f32, Ur5e, 6>(),
        screws_alike::<f64, Ur5e, 6>(),
        screws_alike::<f32, Panda, 7>(),
        screws_alike::<f64, Iiwa14, 7>(),
    ];
    assert_eq!(screws, [Some(true), Some(true), Some(true), Some(false)]);
}

#[test]
fn aba_asks_anew_how_a_link_is_placed() {
    let (state, tau) = moving::<f64, 6>();
    let turn = glam::DMat3::from_rotation_y(0.01);
    let moves: [fn(&mut dynamics_core::spatial::Xform<f64>, glam::DMat3); 2] =
        [|x, _| x.pos.y += 0.01, |x, turn| x.rot *= turn];
    for moved in moves {
        let mut arm = Ur5e::MODEL;
        let before = aba(&arm, &state, &tau, &RIGID_BODY).expect("M > 0");
        moved(&mut arm.links[2].placement, turn);
        let by_bodies = aba(&arm, &state, &tau, &RIGID_BODY).expect("M > 0");
        let by_matrix = forward_dynamics(&arm, &state, &tau, &RIGID_BODY).expect("M > 0");
        let largest = |other: &[f64; 6]| {
            let apart = std::iter::zip(by_bodies, other).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        assert!(largest(&by_matrix) < 1e-9, "{by_bodies:?} {by_matrix:?}");
        assert!(largest(&before) > 1e-3);
    }
}
