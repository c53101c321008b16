//! The status of loops in forward dynamics: their closure errors, and whether the rank dropped.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{
    LoopError, LoopMotion, LoopRank, LoopRobot, Mobility, Moving, OPEN, Stabilisation, assemble,
    forward_dynamics, mobility,
};
use dynamics_core::model::Static;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use loop_tests::machines::{FiveBar, FourBar, Machine, Parallelogram};

fn parallelogram<R: Real>(q: [R; 3], qd: [R; 3]) -> LoopMotion<R, 3, 1, 5> {
    let state = State { qd, ..State::at(q) };
    let robot = Static::<Parallelogram>::NEW;
    let (loops, none) = (&Parallelogram::LOOPS, Stabilisation::NONE);
    forward_dynamics(&robot, loops, &state, &[R::ONE], none, &RIGID_BODY).expect("accelerations")
}

#[test]
fn forward_dynamics_says_by_how_much_its_loops_are_open() {
    let closed = [-1.0, 1.0, -1.0];
    let rates = [2.0, -2.0, 2.0];
    let motion = parallelogram(closed, rates);
    let closure = motion.closure(&Parallelogram::LOOPS);
    assert!(closure.position < 1e-15 && closure.velocity < 1e-14, "{closure:?}");
    assert!(motion.closed(&Parallelogram::LOOPS).is_ok());

    // The rocker of 0.3 m is turned by δ: its end is 0.6 sin(δ/2) away. And its rate is off by 1
    // rad/s.
    for delta in [1e-3, 1e-2, 0.1_f64] {
        let motion = parallelogram([-1.0, 1.0, -1.0 - delta], [2.0, -2.0, 3.0]);
        let closure = motion.closure(&Parallelogram::LOOPS);
        let gap = 0.6 * (0.5 * delta).sin();
        let size = motion.constraints.size[4];
        // In one direction of two in the plane.
        let most = closure.position * size;
        assert!(most <= gap * (1.0 + 1e-9) && most >= gap / 2_f64.sqrt(), "{most} of {gap}");
        assert!(
            closure.velocity * size <= 0.3 * 1.1 && closure.velocity * size > 0.2,
            "{closure:?}"
        );
        let refused = motion.closed(&Parallelogram::LOOPS);
        match refused {
            Ok(_) => assert!(closure.position <= OPEN),
            Err(LoopError::Open { name, error }) => {
                assert!(name == "far_corner" && error == closure.position && error > OPEN);
            }
            Err(other) => panic!("{other}"),
        }
        assert_eq!(refused.is_err(), delta > 0.05, "{delta}: {closure:?}");
    }
}

#[test]
fn a_parallelogram_change_point_reports_a_dropped_rank() {
    let machine = mobility(&Static::<Parallelogram>::NEW, &Parallelogram::LOOPS, &[0.0_f64; 3]);
    let flat = machine.expect("it is closed");
    assert_eq!(flat, Mobility { here: 2, usual: 1 });
    let at = |off: f64| parallelogram([-off, off, -off], [1.0, -1.0, 1.0]);
    let (near, closer) = (at(1e-6), at(1e-8));
    // The accelerations jump, which no number of the result shows but its rank.
    let jump = (near.qdd[0] - closer.qdd[0]).abs() / near.qdd[0].abs();
    assert!(jump > 0.1, "{:?} {:?}", near.qdd, closer.qdd);
    assert_eq!(near.rank(&flat), LoopRank::Full);
    assert_eq!(closer.rank(&flat), LoopRank::Dropped { gained: 1 });
    // In f32 the same from a 500th of a radian on.
    let single = |off: f32| parallelogram([-off, off, -off], [1.0, -1.0, 1.0]);
    assert_eq!(single(0.05).rank(&flat), LoopRank::Full);
    assert_eq!(single(1e-4).rank(&flat), LoopRank::Dropped { gained: 1 });
}

/// The mobility of a machine in its home configuration, in both scalars.
fn at_home<T, const B: usize, const V: usize, const A: usize>() -> [Mobility; 2]
where
    T: LoopRobot<B, V, V, 1, 5, A> + Machine<B, V, V, 1, 5, A>,
{
    let robot = Static::<T>::NEW;
    let home = assemble(&robot, &T::LOOPS, &T::HOME, Moving::Passive).expect("it closes").q;
    let of_double = mobility(&robot, &T::LOOPS, &home).expect("closed");
    let single = assemble(&robot, &T::LOOPS, &home.map(|x| x as f32), Moving::Passive);
    let of_single = mobility(&robot, &T::LOOPS, &single.expect("it closes").q).expect("closed");
    [of_double, of_single]
}

#[test]
fn mobility_is_that_of_gruebler_away_from_change_points() {
    let one = Mobility { here: 1, usual: 1 };
    assert_eq!(at_home::<FourBar, 3, 3, 1>(), [one; 2]);
    assert_eq!(at_home::<Parallelogram, 3, 3, 1>(), [one; 2]);
    let two = Mobility { here: 2, usual: 2 };
    assert_eq!(at_home::<FiveBar, 4, 4, 2>(), [two; 2]);
    let open = mobility(&Static::<FourBar>::NEW, &FourBar::LOOPS, &FourBar::HOME);
    assert!(matches!(open, Err(LoopError::Open { .. })), "{open:?}");
}
