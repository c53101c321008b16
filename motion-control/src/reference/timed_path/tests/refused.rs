//! Paths that are refused, with the joint and the point of the grid.

use super::*;
use crate::limits::LimitKind;
use crate::tests::motion_limits;

fn refused<const V: usize>(
    path: &impl GeometricPath<f64, V>,
    limits: &PathLimits<f64, V>,
    id: impl Fn(&State<f64, V, V>) -> [f64; V],
) -> TimedPathError {
    let motion = TimedPath::<_, _, 11>::new(path, 1e-3, limits, id);
    motion.err().expect("refused")
}

#[test]
fn gravity_beyond_a_limit_names_joint_and_point() {
    // A pendulum that is lifted: 9 sin q exceeds 6 N·m from 0.73 rad on, which is after grid point
    // 4 of 1.8 rad.
    let path = Curve(|s: f64| [[0.0, 1.8 * s], [0.1, 1.8], [0.0; 2]]);
    let lift = |state: &State<f64, 2, 2>| [state.qdd[0], state.qdd[1] + 9.0 * state.q[1].sin()];
    let error = refused(&path, &torques([6.0; 2]), lift);
    let TimedPathError::Torque { point, joint, needed, allowed } = error else {
        panic!("{error}");
    };
    // The backward pass meets the last such point first.
    assert_eq!((point, joint, allowed), (9, 1, 6.0));
    assert!((needed - 9.0 * 1.62_f64.sin()).abs() < 1e-12);
    // With friction against the motion the limit is exceeded where gravity alone does not.
    let mut limits = torques([6.0, 9.5]);
    assert!(TimedPath::<_, _, 11>::new(&path, 1e-3, &limits, lift).is_ok());
    limits.friction[1].coulomb = 0.6;
    let error = refused(&path, &limits, lift);
    let lifted = matches!(error, TimedPathError::Torque { joint: 1, .. });
    assert!(lifted, "{error}");
}

#[test]
fn friction_in_the_inverse_dynamics_is_found() {
    let path = line(1.0);
    for friction in [|qd: f64| 0.01 * qd, |qd: f64| 0.01 * qd.signum()] {
        let id = |state: &State<f64, 1, 1>| [2.0 * state.qdd[0] + friction(state.qd[0])];
        let error = refused(&path, &torques([5.0]), id);
        let (point, joint) = (10, 0);
        assert_eq!(error, TimedPathError::SignOfVelocity { point, joint });
    }
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    let path = Curve(|s: f64| [[s, s], [1.0, if s > 0.55 { f64::NAN } else { 1.0 }], [0.0; 2]]);
    let error = refused(&path, &torques([5.0; 2]), |state| state.qdd);
    let (point, joint) = (10, 1);
    assert_eq!(error, TimedPathError::NotFinite { point, joint });
    let path = Curve(|s: f64| [[s, s], [1.0; 2], [0.0; 2]]);
    let id = |state: &State<f64, 2, 2>| {
        let bad = (0.35..0.45).contains(&state.q[0]);
        [state.qdd[0], if bad { f64::INFINITY } else { state.qdd[1] }]
    };
    let error = refused(&path, &torques([5.0; 2]), id);
    assert_eq!(error, TimedPathError::NotFinite { point: 4, joint: 1 });
}

#[test]
fn limits_that_allow_nothing_are_named() {
    let (path, good) = (line(1.0), torques([5.0]));
    let same = |value: f64, bad: f64| value == bad || value.is_nan() && bad.is_nan();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&path, &torques([bad]), inertia);
        let TimedPathError::TorqueLimit { joint: 0, value } = error else {
            panic!("{error}");
        };
        assert!(same(value, bad));
        let tick = TimedPath::<_, _, 11>::new(&path, bad, &good, inertia);
        assert_eq!(tick.err(), Some(TimedPathError::Tick));
    }
    let unlimited = f64::INFINITY;
    for bad in [0.0, -1.0, f64::NAN] {
        for (limit, kind) in [
            (motion_limits(bad, unlimited), LimitKind::Speed),
            (motion_limits(unlimited, bad), LimitKind::Acceleration),
        ] {
            let motion = [limit];
            let error = refused(&path, &PathLimits { motion, ..good }, inertia);
            match error {
                TimedPathError::MotionLimit { joint, of, value } => {
                    assert!(same(value, bad) && (joint, of) == (0, kind), "{error}");
                }
                _ => panic!("{error}"),
            }
        }
    }
    for [coulomb, viscous, certain] in
        [[-0.1, 0.0, 0.0], [0.0, f64::NAN, 0.0], [0.0, f64::INFINITY, 0.0], [0.0, 0.0, 1.1]]
    {
        let friction = [self::friction(coulomb, viscous, certain)];
        let error = refused(&path, &PathLimits { friction, ..good }, inertia);
        assert_eq!(error, TimedPathError::Friction { joint: 0 });
    }
}

#[test]
fn a_motion_of_too_many_ticks_is_refused() {
    let slow = PathLimits { motion: [motion_limits(1e-9, f64::INFINITY)], ..torques([5.0]) };
    let error = refused(&line(10.0), &slow, inertia);
    assert_eq!(error, TimedPathError::TooLong);
}
