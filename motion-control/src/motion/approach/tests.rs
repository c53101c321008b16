use super::*;
use crate::limits::Fault;
use crate::motion::MotionControllerConfig;
use crate::safety::{StopCategory, SupervisorConfig};

const TICK: f64 = 1e-3;
const LIMITS: [MotionLimits<f64>; 2] = [
    MotionLimits {
        velocity: 1.0,
        acceleration: 4.0,
    },
    MotionLimits {
        velocity: 2.0,
        acceleration: 3.0,
    },
];
const BOUNDS: SafetyLimits<f64, 2> = SafetyLimits {
    torque: [10.0; 2],
    rate: [10.0; 2],
    speed: [3.0; 2],
    lower: [-2.0; 2],
    upper: [2.0; 2],
};

/// Rest at zero.
#[derive(Debug)]
struct Rest;

impl Reference<f64, 2> for Rest {
    fn at(&self, _: u32) -> State<f64, 2, 2> {
        State::at([0.0; 2])
    }
    fn ticks(&self) -> u32 {
        0
    }
}

fn plan(from: [f64; 2]) -> Result<Approach<'static, f64, 2, Rest>, ApproachError> {
    Approach::plan(&from, &Rest, TICK, &LIMITS, &BOUNDS, Circles::NONE)
}

#[test]
fn a_way_uses_its_limits_and_keeps_them() {
    for from in [[1.9, -0.3], [-0.01, 1.5], [1e-6, 0.0], [-2.0, 2.0]] {
        let way = plan(from).expect("within the limits");
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
        assert!(
            used >= 0.98 || way.path_ticks() < 10,
            "{used} in {}",
            way.path_ticks()
        );
    }
}

#[test]
fn refusals_name_the_joint_and_the_limit() {
    let outside = |joint, position| ApproachError::Position {
        joint,
        position,
        lower: -2.0,
        upper: 2.0,
    };
    assert_eq!(plan([0.0, 2.1]).unwrap_err(), outside(1, 2.1));
    assert_eq!(plan([-2.1, 2.1]).unwrap_err(), outside(0, -2.1));
    assert_eq!(
        plan([0.0, f64::NAN]).unwrap_err(),
        ApproachError::NotFinite { joint: 1 }
    );
    for (change, of) in [
        (
            (|l| l.velocity = 0.0) as fn(&mut MotionLimits<f64>),
            LimitKind::Speed,
        ),
        (|l| l.acceleration = -1.0, LimitKind::Torque),
        (|l| l.velocity = f64::NAN, LimitKind::Speed),
    ] {
        let mut limits = LIMITS;
        change(&mut limits[1]);
        let refused =
            Approach::plan(&[1.0; 2], &Rest, TICK, &limits, &BOUNDS, Circles::NONE).unwrap_err();
        assert_eq!(refused, ApproachError::NoMotion { joint: 1, of });
    }
    // A joint that does not have to move needs no speed.
    let mut limits = LIMITS;
    limits[1].velocity = 0.0;
    assert!(Approach::plan(&[1.0, 0.0], &Rest, TICK, &limits, &BOUNDS, Circles::NONE).is_ok());
    let slow = [MotionLimits {
        velocity: 1e-7,
        acceleration: 1.0,
    }; 2];
    let refused =
        Approach::plan(&[1.0; 2], &Rest, TICK, &slow, &BOUNDS, Circles::NONE).unwrap_err();
    assert!(matches!(refused, ApproachError::Path(_)), "{refused}");
}

#[test]
fn an_unknown_position_gets_no_approach_and_no_torque() {
    let mut controller = MotionController::<f64, 2>::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: BOUNDS,
            tick: TICK,
            resolution: 0.0,
            ride_through_ticks: 2,
            hold_ticks: 3,
            reentry_ticks: 10,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: 0.1,
    });
    for on_brake in [false, true] {
        if on_brake {
            controller = controller.on_brake();
        }
        for measured in [Err(Fault::Stale), Ok(&[f64::NAN; 2])] {
            let command = controller.tick(measured, &Rest, |_, _| [5.0; 2]);
            assert_eq!((command.torque, command.brake), ([0.0; 2], true));
            let refused = controller.approach(&Rest, &LIMITS, &BOUNDS).unwrap_err();
            assert_eq!(refused, ApproachError::Reset(ResetError::NoMeasurement));
            controller.stop_by(Fault::External, StopCategory::ControlledHold);
        }
    }
    controller.tick(Ok(&[1.0; 2]), &Rest, |_, _| [0.0; 2]);
    assert!(controller.approach(&Rest, &LIMITS, &BOUNDS).is_ok());
}

/// From a place on, at a constant speed.
#[derive(Debug)]
struct Leave {
    q: [f64; 2],
    qd: [f64; 2],
}

impl Reference<f64, 2> for Leave {
    fn at(&self, tick: u32) -> State<f64, 2, 2> {
        let [a, b] = self.q;
        let gone = if tick == 0 { 0.0 } else { 0.5 };
        State {
            qd: self.qd,
            ..State::at([a + gone, b])
        }
    }
    fn ticks(&self) -> u32 {
        700
    }
}

#[test]
fn a_way_ends_at_the_begin_of_its_motion() {
    let q = [1.0, -1.0];
    let motion = Leave { q, qd: [0.0; 2] };
    let way = Approach::plan(&q, &motion, TICK, &LIMITS, &BOUNDS, Circles::NONE)
        .expect("within the limits");
    // It is there already.
    assert_eq!((way.last_point(), way.path_ticks()), (&q, 1));
    let way = Approach::plan(
        &[-0.6, -1.0],
        &motion,
        TICK,
        &LIMITS,
        &BOUNDS,
        Circles::NONE,
    );
    let way = way.expect("within the limits");
    // 15/8 · 1.6 rad at 1 rad/s, and a tick for rounding.
    assert_eq!((way.last_point(), way.path_ticks()), (&q, 3001));
    assert_eq!(way.ticks(), 3001 + 700);
    assert_eq!(way.path_seconds(TICK), 3001.0 * TICK);
}

#[test]
fn a_motion_that_begins_in_motion_is_refused() {
    for bad in [0.5, -0.5, f64::NAN, f64::INFINITY] {
        let motion = Leave {
            q: [0.0; 2],
            qd: [0.0, bad],
        };
        let refused =
            Approach::plan(&[0.0; 2], &motion, TICK, &LIMITS, &BOUNDS, Circles::NONE).unwrap_err();
        assert_eq!(refused, ApproachError::Moving { joint: 1 });
    }
}

#[test]
fn both_ends_of_a_way_have_to_be_within_the_bounds() {
    let outside = |joint, position| ApproachError::Position {
        joint,
        position,
        lower: -2.0,
        upper: 2.0,
    };
    let way = |from: [f64; 2], q| {
        let motion = Leave { q, qd: [0.0; 2] };
        Approach::plan(&from, &motion, TICK, &LIMITS, &BOUNDS, Circles::NONE).map(|way| way.ends)
    };
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
    let limit = |velocity, acceleration| MotionLimits {
        velocity,
        acceleration,
    };
    // 15/8 of the distance by the speed, and √(10/√3 · distance by the acceleration): the longer
    // one.
    for (distance, limit, seconds) in [
        (2.0, limit(0.5, 1e3), 7.5),
        (2.0, limit(1e3, 2.0), 2.402_811_414_134_757_2),
        (
            0.5,
            limit(2.0, 10.0 / 3.0_f64.sqrt()),
            0.707_106_781_186_547_5,
        ),
        (0.5, limit(f64::INFINITY, 5.0 / 3.0_f64.sqrt()), 1.0),
        (0.0, limit(0.0, 0.0), 0.0),
    ] {
        let least = least_seconds(0, distance, &limit).expect("a limit that allows motion");
        assert!((least - seconds).abs() < 1e-12, "{least}, not {seconds}");
    }
    // Whichever joint is the slower one; a tick more for what rounding takes.
    for from in [[-1.6, 0.1], [0.1, -3.2]] {
        let bounds = SafetyLimits {
            lower: [-4.0; 2],
            ..BOUNDS
        };
        let way =
            Approach::plan(&from, &Rest, TICK, &LIMITS, &bounds, Circles::NONE).expect("limits");
        assert_eq!(way.path_ticks(), 3001);
    }
}

#[test]
fn a_stopped_arm_alone_gets_an_approach() {
    let config = MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: BOUNDS,
            tick: TICK,
            resolution: 0.0,
            ride_through_ticks: 2,
            hold_ticks: 3,
            reentry_ticks: 10,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: 0.1,
    };
    let mut controller = MotionController::<f64, 2>::new(config);
    let tick = |controller: &mut MotionController<f64, 2>| {
        controller.tick(Ok(&[1.0; 2]), &Rest, |_, _| [0.0; 2])
    };
    for _ in 0..5 {
        tick(&mut controller);
    }
    let refused = Some(ApproachError::Reset(ResetError::NotStopped));
    let asked = |controller: &mut MotionController<f64, 2>| {
        controller.approach(&Rest, &LIMITS, &BOUNDS).err()
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
    let limits = [MotionLimits {
        velocity: 1.0,
        acceleration: 4.0,
    }];
    let bounds = |end: f32| SafetyLimits {
        torque: [10.0],
        rate: [8.0],
        speed: [3.0],
        lower: [-end],
        upper: [end],
    };
    let travel = |from: f32, to: f32, end: f32, circles| {
        let motion = State::at([to]);
        let way = Approach::plan(&[from], &motion, 1e-3, &limits, &bounds(end), circles);
        let way = way.expect("within the bounds");
        assert_eq!(way.at(way.path_ticks()).q, [to]);
        way.last_point()[0] - way.first_point()[0]
    };
    let (circle, line) = (Circles::NONE.with(0), Circles::NONE);
    for (stands, begins) in [
        (-3.10, 3.18),
        (6.282, 0.01),
        (0.0, 25.13),
        (3.140_6, -3.140_6),
    ] {
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
