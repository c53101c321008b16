//! Loops that cannot be, and machines that cannot be driven: a typed error that names the loop,
//! never NaN.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{
    BodyFrame, LoopError, LoopJoint, LoopModelError, LoopProblem, LoopRobot, Loops, Moving,
    Stabilisation, assemble, forward_dynamics, inverse_dynamics,
};
use dynamics_core::model::{BASE, Body, Joint, Model, Problem, Robot, Static};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::all_finite;
use loop_tests::machines::Delta;
use loop_tests::states::closed_states;

const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// A four-bar linkage with a flange welded to its coupler, on a ground of this length.
const fn tree(ground: f64) -> Model<f64, 4, 3, 3> {
    Model::new("linkage", bodies(ground))
}

const fn bodies(ground: f64) -> [Body; 4] {
    let turn = Joint::revolute(Y);
    [
        Body::new("crank", BASE, turn).mass(1.0),
        Body::new("coupler", 0, turn).xyz([0.2, 0.0, 0.0]).mass(1.0),
        Body::new("flange", 1, Joint::fixed()).xyz([0.5, 0.0, 0.0]),
        Body::new("rocker", BASE, turn).xyz([ground, 0.0, 0.0]).mass(1.0),
    ]
}

const FLANGE: BodyFrame = BodyFrame::new(2);
const ROCKER: BodyFrame = BodyFrame::new(3).xyz([0.4, 0.0, 0.0]);

fn joint(joint: Joint<f64>, ends: [BodyFrame; 2]) -> LoopJoint {
    LoopJoint::new("pin", joint, ends)
}

fn pin(p: BodyFrame, s: BodyFrame) -> LoopJoint {
    joint(Joint::revolute(Y), [p, s])
}

/// The problem of one loop on a linkage with a ground of this length.
fn problem<const C: usize, const A: usize>(
    ground: f64,
    joint: LoopJoint,
    actuated: [usize; A],
) -> Result<(), (&'static str, LoopProblem)> {
    let loops = Loops::<1, C, A>::try_new(&tree(ground), [joint], actuated);
    loops.map(|_| ()).map_err(|LoopModelError { name, problem, .. }| (name, problem))
}

#[test]
fn impossible_loops_are_refused_by_name() {
    use LoopProblem::{
        ActuatedTwice, Angle, NoBody, NoCoordinate, NotFinite, OutOfReach, Rigid, Rows, SameBody,
        Unconstrained,
    };
    let of_pin = |problem| Err(("pin", problem));
    let one = |ground, joint| problem::<5, 1>(ground, joint, [0]);
    assert_eq!(one(0.6, pin(FLANGE, ROCKER)), Ok(()));
    assert_eq!(one(0.6, pin(FLANGE, FLANGE)), of_pin(SameBody));
    assert_eq!(one(0.6, pin(BodyFrame::new(1), FLANGE)), of_pin(Rigid));
    assert_eq!(one(0.6, pin(FLANGE, BodyFrame::new(4))), of_pin(NoBody(4)));
    assert_eq!(one(1.1, pin(FLANGE, ROCKER)), Ok(())); // stretched out
    assert_eq!(one(1.101, pin(FLANGE, ROCKER)), of_pin(OutOfReach));
    assert_eq!(one(0.6, pin(FLANGE, ROCKER.xyz([f64::NAN, 0.0, 0.0]))), of_pin(NotFinite));
    assert_eq!(one(0.6, pin(FLANGE, ROCKER.rpy([0.0, 90.0, 0.0]))), of_pin(Angle));
    let without_axis = joint(Joint::revolute([0.0; 3]), [FLANGE, ROCKER]);
    assert_eq!(one(0.6, without_axis), of_pin(LoopProblem::Joint(Problem::Axis)));
    let free = joint(Joint::free(), [FLANGE, ROCKER]);
    assert_eq!(problem::<0, 3>(0.6, free, [0, 1, 2]), of_pin(Unconstrained));

    let of_all = |problem| Err(("linkage", problem));
    let (given, expected) = (3, 5);
    assert_eq!(problem::<3, 1>(0.6, pin(FLANGE, ROCKER), [0]), of_all(Rows { expected, given }));
    assert_eq!(problem::<5, 1>(0.6, pin(FLANGE, ROCKER), [3]), of_all(NoCoordinate(3)));
    assert_eq!(problem::<5, 2>(0.6, pin(FLANGE, ROCKER), [2, 2]), of_all(ActuatedTwice(2)));
    let table = joint(Joint::planar(), [BodyFrame::new(BASE), ROCKER]);
    assert_eq!(problem::<3, 0>(0.6, table, []), Ok(()));
}

// Their number alone shows here that they are too few.
#[test]
fn too_few_actuated_coordinates_are_refused() {
    let table = joint(Joint::planar(), [BodyFrame::new(BASE), BodyFrame::new(5)]);
    let error = Loops::<1, 3, 2>::try_new(&Ur5e::MODEL, [table], [0, 1]).expect_err("too few");
    let (needed, given) = (3, 2);
    assert_eq!(error.problem, LoopProblem::TooFewActuated { needed, given });
    let text =
        "robot `ur5e`: fewer coordinates are actuated than are free to move: 2 of at least 3";
    assert_eq!(error.to_string(), text);
}

/// The Delta without the motor of its first crank.
#[test]
fn an_underactuated_loop_and_its_coordinate_are_named() {
    let loops = Loops::<6, 18, 3>::new(&Delta::MODEL, *Delta::LOOPS.joints(), [6, 11, 16]);
    assert_eq!(loops, Delta::LOOPS);
    // The third is a rod's, which moves with the cranks: dependent on them.
    let loops = Loops::<6, 18, 3>::new(&Delta::MODEL, *Delta::LOOPS.joints(), [6, 11, 12]);
    let [state, ..] = closed_states::<Delta, 10, 22, 21, 6, 18, 3>(1)[..] else {
        panic!("no state");
    };
    let torque = inverse_dynamics(&Static::<Delta>::NEW, &loops, &state, &RIGID_BODY);
    assert!(torque.is_ok(), "a rod's angle stands for the third crank: {torque:?}");
    // Both angles of the platform's attitude, which does not turn.
    let loops = Loops::<6, 18, 3>::new(&Delta::MODEL, *Delta::LOOPS.joints(), [6, 0, 1]);
    let torque = inverse_dynamics(&Static::<Delta>::NEW, &loops, &state, &RIGID_BODY);
    let Err(LoopError::UnderActuated { name, joint }) = torque else {
        panic!("{torque:?}");
    };
    assert!(name.starts_with("ball_") && joint < 21, "{name} {joint}");
}

#[test]
fn nonfinite_numbers_are_errors_and_reach_no_torque() {
    let robot = Static::<Delta>::NEW;
    let [state, ..] = closed_states::<Delta, 10, 22, 21, 6, 18, 3>(1)[..] else {
        panic!("no state");
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        for i in 0..22 {
            let mut wrong = state;
            wrong.q[i] = bad;
            let torque = inverse_dynamics(&robot, &Delta::LOOPS, &wrong, &RIGID_BODY);
            assert!(torque.is_err(), "q[{i}] = {bad}: {torque:?}");
            assert!(
                assemble(&robot, &Delta::LOOPS, &wrong.q, Moving::Passive).is_err() || bad == 1e300
            );
        }
        for i in 0..21 {
            let mut wrong = state;
            (wrong.qd[i], wrong.qdd[i]) = (bad, bad);
            let torque = inverse_dynamics(&robot, &Delta::LOOPS, &wrong, &RIGID_BODY);
            let read = Delta::LOOPS.actuated().contains(&i);
            assert_eq!(torque.is_err(), read, "q̇[{i}] = {bad}");
            let none = Stabilisation::NONE;
            let motion =
                forward_dynamics(&robot, &Delta::LOOPS, &wrong, &[0.0; 3], none, &RIGID_BODY);
            // Some velocities of 10³⁰⁰ have finite accelerations.
            let finite = motion.is_ok_and(|motion| all_finite(&motion.qdd) && bad.is_finite());
            assert!(motion.is_err() || finite, "q̇[{i}] = {bad}");
        }
        let mut tau = [0.0; 3];
        tau[1] = bad;
        let none = Stabilisation::NONE;
        let motion = forward_dynamics(&robot, &Delta::LOOPS, &state, &tau, none, &RIGID_BODY);
        assert_eq!(motion.is_err(), !bad.is_finite(), "a torque of {bad}");
    }
}
