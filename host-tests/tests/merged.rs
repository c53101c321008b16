//! Robots whose bodies on fixed joints are parts of others compute what the same robots compute
//! without.

use crate::common::{Worst, six};
use dynamics_core::algorithms::{aba, crba, frame::Local, jacobian, kinematics, rnea};
use dynamics_core::effects::{BodyWrench, Contact, ContactPoint, RIGID_BODY, Width};
use dynamics_core::model::{BASE, Body, Joint, JointKind, Merged, Model, Problem, Robot};
use dynamics_core::robots::{A1, A1Free, A1Leg, Ur5e};
use dynamics_core::spatial::{Force, Motion, Xform};
use dynamics_core::state::State;
use glam::DVec3;
use host_tests::random::{random_body, random_numbers, state_of};
use host_tests::stress_robot::StressRobot;
use host_tests::tolerances::check;
use host_tests::trees::{TreeA, TreeB};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

const QUANTITIES: [&str; 8] =
    ["rnea", "crba", "aba", "poses", "velocities", "accelerations", "jacobian", "wrenches"];

/// The differences of a robot, in the order of [`QUANTITIES`].
type Differences = [Worst; 8];

/// The largest of robots, relative to the full scale of each.
fn largest(robots: &[Differences]) -> [f64; 8] {
    let relative = |worst: &Worst| match worst.full_scale {
        0.0 => worst.error,
        scale => worst.error / scale,
    };
    std::array::from_fn(|k| {
        let of = robots.iter().map(|worst| relative(&worst[k]));
        host_tests::measured::largest(of)
    })
}

/// A floor above everything, which presses on a point of a body.
fn floor(body: usize, point: DVec3) -> Contact<f64, 1> {
    Contact {
        points: [ContactPoint { body, point }],
        normal: DVec3::new(0.36, 0.48, 0.8),
        height: 5.0,
        stiffness: 200.0,
        damping: 5.0,
        damping_depth: Width::new(1e-2),
        friction: 0.7,
        slip_tolerance: 0.1,
    }
}

/// Compares a robot with its merged form at a state.
fn see<const B: usize, const M: usize, const Q: usize, const V: usize>(
    worst: &mut Differences,
    robot: &Model<f64, B, Q, V>,
    merged: &Merged<B, M, Q, V>,
    state: &State<f64, Q, V>,
) {
    let [torque, inertia, forward, at, speed, rate, columns, wrenches] = worst;
    let model = &merged.model;
    let tau = rnea(robot, state, &RIGID_BODY);
    torque.see(rnea(model, state, &RIGID_BODY), tau);
    let (m, m_merged) = (crba(robot, &state.q, &RIGID_BODY), crba(model, &state.q, &RIGID_BODY));
    for i in 0..V {
        inertia.see(*m_merged.row(i).unwrap(), *m.row(i).unwrap());
    }
    let moved = [aba(model, state, &tau, &RIGID_BODY), aba(robot, state, &tau, &RIGID_BODY)];
    let [got, want] = moved.map(|qdd| qdd.expect("every body has mass"));
    forward.see(got, want);
    let (k, k_merged) = (kinematics(robot, state, &()), kinematics(model, state, &()));
    for (i, place) in merged.places.iter().enumerate() {
        let x = place.placement;
        let (pose, v, a) = match k_merged.poses.get(place.body) {
            Some(pose) => {
                (pose.xform(), k_merged.velocities[place.body], k_merged.accelerations[place.body])
            }
            None => (Xform::IDENTITY, Motion::ZERO, Motion::ZERO),
        };
        let (got, want) = (x * pose, k.poses[i].xform());
        at.see(got.rot.to_cols_array(), want.rot.to_cols_array());
        at.see(got.pos.to_array(), want.pos.to_array());
        speed.see(six::<f64>(x * v), six::<f64>(k.velocities[i]));
        rate.see(six::<f64>(x * a), six::<f64>(k.accelerations[i]));
        if place.body == BASE {
            continue;
        }
        let got = jacobian(model, &state.q, place.body, Local);
        let want = jacobian(robot, &state.q, i, Local);
        for (got, want) in std::iter::zip(got, want) {
            columns.see(six::<f64>(x * got), six::<f64>(want));
        }
        let point = DVec3::new(0.1, -0.2, 0.05);
        wrenches.see(
            rnea(model, state, &floor(place.body, place.point(point))),
            rnea(robot, state, &floor(i, point)),
        );
        let wrench = Force::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(3.0, 4.0, -5.0));
        let carried = BodyWrench { body: place.body, wrench: x.transpose_mul(wrench) };
        wrenches
            .see(rnea(model, state, &carried), rnea(robot, state, &BodyWrench { body: i, wrench }));
    }
}

/// Compares a robot with its merged form at some states.
fn differences<const B: usize, const M: usize, const Q: usize, const V: usize>(
    robot: &Model<f64, B, Q, V>,
    rng: &mut TestRng,
) -> Differences {
    let merged: Merged<B, M, Q, V> = robot.try_merged().expect("M bodies move");
    let mut worst = Differences::default();
    for _ in 0..5 {
        see(&mut worst, robot, &merged, &state_of(robot, rng));
    }
    worst
}

fn hold(robots: &[Differences]) {
    for (quantity, error) in std::iter::zip(QUANTITIES, largest(robots)) {
        check("merged robots", quantity, "f64", error).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Ten bodies, five of them on fixed joints: the first, and others wherever they fall.
fn welded(rng: &mut TestRng) -> Model<f64, 10, 5, 5> {
    const NAMES: [&str; 10] = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"];
    let mut left = [4, 5];
    let bodies = std::array::from_fn(|i| {
        let parent = match rng.random_range(0..=i) {
            0 => BASE,
            // Every other body prolongs a chain.
            j => (if i % 2 == 0 { i } else { j }) - 1,
        };
        let moves = i > 0 && rng.random_range(0..left[0] + left[1]) >= left[0];
        if i > 0 {
            left[usize::from(moves)] -= 1;
        }
        let axis = host_tests::random::within(rng, 1.0);
        let joint = match rng.random_range(0..3) {
            _ if !moves => Joint::fixed(),
            0 => Joint::prismatic(axis),
            _ => Joint::revolute(axis),
        };
        random_body(rng, Body::new(NAMES[i], parent, joint))
    });
    Model::new("welded", bodies)
}

#[test]
fn merged_robots_have_the_dynamics_and_kinematics_of_before() {
    let rng = &mut random_numbers();
    let mut all = vec![
        differences::<16, 12, 12, 12>(&A1::MODEL, rng),
        differences::<4, 3, 3, 3>(&A1Leg::MODEL, rng), // becomes a chain of revolute joints
        differences::<17, 13, 19, 18>(&A1Free::MODEL, rng),
        differences::<11, 7, 7, 7>(&StressRobot::MODEL, rng),
        differences::<17, 15, 35, 32>(&TreeA::MODEL, rng),
        differences::<17, 16, 35, 32>(&TreeB::MODEL, rng),
    ];
    // Welds on welds, on the base, and with joints on them.
    let mut seen = [0; 3];
    for _ in 0..30 {
        let tree = welded(rng);
        let fixed =
            |i: usize| tree.links.get(i).is_some_and(|link| link.joint.kind == JointKind::Fixed);
        for (i, link) in tree.links.iter().enumerate() {
            seen[0] += usize::from(fixed(i) && fixed(link.parent));
            seen[1] += usize::from(fixed(i) && link.parent == BASE);
            seen[2] += usize::from(!fixed(i) && fixed(link.parent));
        }
        all.push(differences::<10, 5, 5, 5>(&tree, rng));
    }
    assert!(seen.into_iter().all(|count| count > 30), "{seen:?}");
    hold(&all);
}

/// The stress robot with one of its welds 0.1 mm beside its place.
fn displaced() -> Model<f64, 11, 7, 7> {
    let mut robot = StressRobot::MODEL;
    let tool = robot.body("tool");
    robot.links[tool].placement.pos.x += 1e-4;
    robot
}

#[test]
fn a_part_in_another_place_shows_in_every_quantity() {
    let rng = &mut random_numbers();
    let (robot, other) = (StressRobot::MODEL, displaced().merged::<7>());
    let mut worst = Differences::default();
    see(&mut worst, &robot, &other, &state_of(&robot, rng));
    for (quantity, error) in std::iter::zip(QUANTITIES, largest(&[worst])) {
        assert!(error > 1e-7, "{quantity}: {error:.1e}");
        check("merged robots", quantity, "f64", error).expect_err(quantity);
    }
}

#[test]
fn merging_keeps_order_names_and_frames_of_bodies_that_move() {
    let Merged { model, places, .. } = StressRobot::MODEL.merged::<7>();
    let names = model.links.map(|link| link.name);
    assert_eq!(names, ["rail", "yoke", "quill", "head", "boom", "jib", "lift"]);
    let body = |name| places[StressRobot::MODEL.body(name)].body;
    let [plinth, bracket, tool, ballast] = ["plinth", "bracket", "tool", "ballast"].map(body);
    assert_eq!([plinth, bracket, tool, ballast], [BASE, 1, 3, 6]);
    let mass: f64 = model.links.iter().map(|link| link.inertia.mass).sum();
    let before: f64 = StressRobot::MODEL.links.iter().map(|link| link.inertia.mass).sum();
    assert!((mass + 3.0 - before).abs() < 1e-14); // what stands on the base is not in it
    assert!(model.check(1e-9).is_ok());
    assert_eq!(Ur5e::MODEL.merged::<6>().model, Ur5e::MODEL);
    assert_eq!(model.merged::<7>().model, model);
}

#[test]
fn another_number_of_bodies_is_refused_and_named() {
    let error = A1::MODEL.try_merged::<16>().expect_err("four are fixed");
    assert_eq!(error.body, "a1");
    let (expected, given) = (A1::MODEL.moving_bodies(), 16);
    assert_eq!(error.problem, Problem::Bodies { expected, given });
    assert_eq!(error.to_string(), "robot `a1`: 12 of its bodies move, not M = 16");
    assert!(A1::MODEL.try_merged::<11>().is_err());
    let still = Model::<f64, 1, 0, 0>::new("still", [Body::new("foot", BASE, Joint::fixed())]);
    assert!(still.try_merged::<1>().is_err());
    assert_eq!(still.merged::<0>().places[0].body, BASE);
}

#[test]
fn a_parent_that_is_not_listed_before_is_refused() {
    let last = A1::MODEL.links.len() - 1;
    for (body, parent) in [(0, 0), (2, 99), (last, last)] {
        let mut robot = A1::MODEL;
        robot.links[body].parent = parent;
        let error = robot.try_merged::<12>().expect_err("no parent");
        assert_eq!(error.body, robot.links[body].name);
        assert_eq!(error.problem, Problem::Parent);
    }
}

#[test]
#[should_panic(expected = "robot `a1`: 12 of its bodies move, not M = 13")]
fn the_constant_form_panics_with_the_numbers() {
    let _: Merged<16, 13, 12, 12> = A1::MODEL.merged();
}
