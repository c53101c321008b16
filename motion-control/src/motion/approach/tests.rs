use super::*;
use crate::limits::Fault;
use crate::motion::MotionControllerConfig;
use crate::reference::Trajectory;
use crate::safety::StopCategory;
use crate::tests::{Motion, controlled, motion_limits, safety_limits, stop};

const TICK: f64 = 1e-3;
const LIMITS: [MotionLimits<f64>; 2] = [motion_limits(1.0, 4.0), motion_limits(2.0, 3.0)];
const BOUNDS: SafetyLimits<f64, 2> =
    safety_limits([10.0; 2], [10.0; 2], [3.0; 2], [-2.0; 2], [2.0; 2]);

const CONFIG: MotionControllerConfig<f64, 2> =
    controlled(BOUNDS, TICK, [2, 3, 10], [250.0, 25.0, 0.1]);
/// Rest at zero.
const REST: State<f64, 2, 2> = State { q: [0.0; 2], qd: [0.0; 2], qdd: [0.0; 2] };

fn plan<M: Reference<f64, 2>>(
    from: [f64; 2],
    motion: &M,
) -> Result<Approach<'_, f64, 2, M>, ApproachError> {
    Approach::plan(&from, motion, TICK, &LIMITS, &BOUNDS, Circles::NONE)
}

fn outside(joint: usize, position: f64) -> ApproachError {
    ApproachError::Position { joint, position, lower: -2.0, upper: 2.0 }
}

#[test]
fn a_way_uses_its_limits_and_keeps_them() {
    for from in [[1.9, -0.3], [-0.01, 1.5], [1e-6, 0.0], [-2.0, 2.0]] {
        let way = plan(from, &REST).expect("within the limits");
        assert_eq!((way.at(0).q, way.at(way.path_ticks()).q), (from, [0.0; 2]));
        assert_eq!((way.first_point(), way.last_point()), (&from, &[0.0; 2]));
        let mut used = 0.0_f64;
        for tick in 0..way.path_ticks() {
            let state = way.at(tick);
            for joint in 0..2 {
                used = used.max(state.qd[joint].abs() / LIMITS[joint].velocity);
                used = used.max(state.qdd[joint].abs() / LIMITS[joint].acceleration);
                assert!(state.q[joint].abs() <= from[joint].abs());
            }
        }
        assert!(used <= 1.0, "{used}");
        // One tick of rounding of a way of a tick or two is much.
        assert!(used >= 0.98 || way.path_ticks() < 10, "{used}");
    }
}

#[test]
fn limits_without_motion_are_refused_by_joint_and_name() {
    let planned = |from: [f64; 2], limits| {
        let way = Approach::plan(&from, &REST, TICK, &limits, &BOUNDS, Circles::NONE);
        way.map(|way| way.path_ticks())
    };
    let good = LIMITS[1];
    for (limit, of) in [
        (motion_limits(0.0, good.acceleration), LimitKind::Speed),
        (motion_limits(good.velocity, -1.0), LimitKind::Torque),
        (motion_limits(f64::NAN, good.acceleration), LimitKind::Speed),
    ] {
        let refused = Err(ApproachError::NoMotion { joint: 1, of });
        assert_eq!(planned([1.0; 2], [LIMITS[0], limit]), refused);
    }
    // A joint that does not have to move needs no speed.
    let still = [LIMITS[0], motion_limits(0.0, good.acceleration)];
    assert!(planned([1.0, 0.0], still).is_ok());
    let refused = planned([1.0; 2], [motion_limits(1e-7, 1.0); 2]).unwrap_err();
    assert!(matches!(refused, ApproachError::Path(_)), "{refused}");
}

#[test]
fn an_unknown_position_gets_no_approach_and_no_torque() {
    let mut controller = MotionController::<f64, 2>::new(CONFIG);
    for on_brake in [false, true] {
        if on_brake {
            controller = controller.on_brake();
        }
        for measured in [Err(Fault::Stale), Ok(&[f64::NAN; 2])] {
            let command = controller.tick(measured, &REST, |_, _| [5.0; 2]);
            assert_eq!((command.torque, command.brake), ([0.0; 2], true));
            let refused = controller.approach(&REST, &LIMITS, &BOUNDS).unwrap_err();
            assert_eq!(refused, ApproachError::Reset(ResetError::NoMeasurement));
            controller.stop_by(Fault::External, StopCategory::ControlledHold);
        }
    }
    controller.tick(Ok(&[1.0; 2]), &REST, |_, _| [0.0; 2]);
    assert!(controller.approach(&REST, &LIMITS, &BOUNDS).is_ok());
}

/// From a place on, at a constant speed.
fn leave(q: [f64; 2], qd: [f64; 2]) -> Motion<impl Fn(u32) -> State<f64, 2, 2>> {
    Motion(move |tick| {
        let gone = if tick == 0 { 0.0 } else { 0.5 };
        let state = State::at([q[0] + gone, q[1]]);
        State { qd, ..state }
    })
}

#[test]
fn a_way_ends_at_the_begin_of_its_motion() {
    let q = [1.0, -1.0];
    let motion = leave(q, [0.0; 2]);
    // An arm that is there already; and 15/8 · 1.6 rad at 1 rad/s, and a tick for rounding.
    for (from, ticks) in [(q, 1), ([-0.6, -1.0], 3001)] {
        let way =
            plan(from, &motion).map(|way| (way.ends[1], way.path_ticks(), way.path_seconds(TICK)));
        assert_eq!(way, Ok((q, ticks, f64::from(ticks) * TICK)));
    }
    let motion = Trajectory::new(&[stop(q, 0), stop(q, 700)], TICK, &LIMITS).expect("at rest");
    let way = plan([-0.6, -1.0], &motion);
    assert_eq!(way.expect("within the limits").ticks(), 3001 + 700);
}

#[test]
fn a_motion_that_begins_in_motion_is_refused() {
    for bad in [0.5, -0.5, f64::NAN, f64::INFINITY] {
        let refused = plan([0.0; 2], &leave([0.0; 2], [0.0, bad])).err();
        assert_eq!(refused, Some(ApproachError::Moving { joint: 1 }));
    }
}

#[test]
fn both_ends_of_a_way_have_to_be_within_the_bounds() {
    let way = |from, q| plan(from, &leave(q, [0.0; 2])).map(|way| way.ends);
    // On the bounds themselves.
    for ends in [[[2.0; 2], [-2.0; 2]], [[-2.0; 2], [2.0; 2]]] {
        assert_eq!(way(ends[0], ends[1]), Ok(ends));
    }
    let (inside, none) = ([0.5; 2], ApproachError::NotFinite { joint: 1 });
    for (q, error) in [
        ([2.01, 0.0], outside(0, 2.01)),
        ([0.0, -2.01], outside(1, -2.01)),
        ([0.0, f64::NAN], none),
        ([0.0, f64::INFINITY], none),
        ([0.0, f64::NEG_INFINITY], none),
    ] {
        assert_eq!(way(q, inside), Err(error), "an arm at {q:?}");
        assert_eq!(way(inside, q), Err(error), "a motion from {q:?}");
    }
}

#[test]
fn the_slowest_joint_has_the_time_that_its_limits_need() {
    // 15/8 of the distance by the speed, and √(10/√3 · distance by the acceleration): the longer
    // one.
    for (distance, limit, seconds) in [
        (2.0, motion_limits(0.5, 1e3), 7.5),
        (2.0, motion_limits(1e3, 2.0), 2.402_811_414_134_757_2),
        (0.5, motion_limits(2.0, 10.0 / 3.0_f64.sqrt()), 0.707_106_781_186_547_5),
        (0.5, motion_limits(f64::INFINITY, 5.0 / 3.0_f64.sqrt()), 1.0),
        (0.0, motion_limits(0.0, 0.0), 0.0),
    ] {
        let least = least_seconds(0, distance, &limit).expect("a limit that allows motion");
        assert!((least - seconds).abs() < 1e-12, "{least}, not {seconds}");
    }
    // Whichever joint is the slower one; a tick more for what rounding takes.
    for from in [[-1.6, 0.1], [0.1, -3.2]] {
        let bounds = SafetyLimits { lower: [-4.0; 2], ..BOUNDS };
        let way =
            Approach::plan(&from, &REST, TICK, &LIMITS, &bounds, Circles::NONE).expect("limits");
        assert_eq!(way.path_ticks(), 3001);
    }
}

#[test]
fn a_stopped_arm_alone_gets_an_approach() {
    let mut controller = MotionController::<f64, 2>::new(CONFIG);
    let tick = |controller: &mut MotionController<f64, 2>| {
        controller.tick(Ok(&[1.0; 2]), &REST, |_, _| [0.0; 2])
    };
    for _ in 0..5 {
        tick(&mut controller);
    }
    let refused = Some(ApproachError::Reset(ResetError::NotStopped));
    let asked = |controller: &mut MotionController<f64, 2>| {
        controller.approach(&REST, &LIMITS, &BOUNDS).err()
    };
    assert_eq!(asked(&mut controller), refused, "it follows");
    assert_eq!(controller.trajectory_tick(), 5);
    controller.stop_by(Fault::External, StopCategory::ControlledHold);
    assert_eq!(asked(&mut controller), refused, "it is decelerated");
    for _ in 0..4 {
        tick(&mut controller);
    }
    assert_eq!(asked(&mut controller), None, "it stands");
    // The motion begins at its begin.
    assert_eq!(controller.trajectory_tick(), 0);
}

#[test]
fn a_circle_goes_the_short_way_and_a_line_as_far_as_its_number() {
    let limits = [motion_limits(1.0, 4.0)];
    let bounds = |end: f32| safety_limits([10.0], [8.0], [3.0], [-end], [end]);
    let travel = |from: f32, to: f32, end: f32, circles| {
        let motion = State::at([to]);
        let way = Approach::plan(&[from], &motion, 1e-3, &limits, &bounds(end), circles);
        let way = way.expect("within the bounds");
        assert_eq!(way.at(way.path_ticks()).q, [to]);
        way.last_point()[0] - way.first_point()[0]
    };
    let (circle, line) = (Circles::NONE.with(0), Circles::NONE);
    for (stands, begins) in [(-3.10, 3.18), (6.282, 0.01), (0.0, 25.13), (3.140_6, -3.140_6)] {
        assert!(travel(stands, begins, f32::INFINITY, circle).abs() < 0.02);
        let counted = travel(stands, begins, f32::INFINITY, line);
        assert_eq!(counted, begins - stands);
    }
    // Bounds are stops: the way goes around.
    assert_eq!(travel(2.9, -2.9, 3.0, circle), -5.8);
    let rest = State::at([1.0]);
    let refused = Approach::plan(&[0.0], &rest, 1e-3, &limits, &bounds(4.0), circle);
    assert!(matches!(refused.unwrap_err(), ApproachError::Bounds(_)));
}
