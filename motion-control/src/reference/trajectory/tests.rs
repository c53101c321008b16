//! Peaks against dense sampling, ends, and what makes no trajectory.

use super::segment::sqrt;
use super::*;
use crate::estimate::tests::Numbers;
use crate::tests::motion_limits;

const FREE: MotionLimits<f64> = motion_limits(1e9, 1e9);

fn stop(q: f64, ticks: u32) -> WayPoint<f64, 1> {
    pass(q, 0.0, ticks)
}

fn pass(q: f64, qd: f64, ticks: u32) -> WayPoint<f64, 1> {
    let (q, qd) = ([q], [qd]);
    WayPoint { q, qd, ticks }
}

#[test]
fn roots_are_square_roots() {
    for n in 75..=300 {
        let x = f64::from(n) / 100.0;
        assert!((sqrt(x) - x.sqrt()).abs() < 4e-16, "{x}");
    }
}

#[test]
#[cfg_attr(miri, ignore = "18 million samples")]
fn peaks_are_those_of_dense_sampling() {
    let mut numbers = Numbers(1);
    // Miri takes a minute for what is a second otherwise.
    for _ in 0..if cfg!(miri) { 1 } else { 60 } {
        let [a, b] = [(); 2].map(|()| numbers.next());
        let points = [
            stop(0.0, 0),
            pass(a, 3.0 * numbers.next(), 700),
            pass(b, 3.0 * numbers.next(), 900),
            stop(numbers.next(), 500),
        ];
        let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
        for (point, segment) in (1..4).zip(&motion.segments.each) {
            let samples = (0..=20_000).map(|k| segment.at(f64::from(k) / 20_000.0));
            let (qd, qdd) = samples.fold((0.0_f64, 0.0_f64), |(qd, qdd), x| {
                (qd.max(x.qd[0].abs()), qdd.max(x.qdd[0].abs()))
            });
            // A limit just above the sampled peak holds, one just below names it.
            let limit = |velocity, acceleration| {
                segment.check(point, &[motion_limits(velocity, acceleration)])
            };
            let close = 1.0 + 1e-6;
            let near = |needed: f64, peak: f64| (1.0 - 1e-12..=close).contains(&(needed / peak));
            assert_eq!(limit(qd * close, qdd * close), Ok(()));
            match limit(qd / close, qdd) {
                Err(TrajectoryError::Velocity { needed, .. }) if near(needed, qd) => {}
                other => panic!("{other:?}"),
            }
            match limit(qd * close, qdd / close) {
                Err(TrajectoryError::Acceleration { needed, .. }) if near(needed, qdd) => {}
                other => panic!("{other:?}"),
            }
        }
    }
}

#[test]
fn velocity_and_acceleration_are_the_derivatives() {
    let points = [stop(0.2, 0), pass(1.0, -0.7, 400), stop(-0.5, 600)];
    let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
    for segment in &motion.segments.each[..2] {
        let ds = 1e-6;
        for k in 1..100 {
            let s = f64::from(k) / 100.0;
            let [before, now, after] = [s - ds, s, s + ds].map(|s| segment.at(s));
            let dt = 2.0 * ds * segment.seconds;
            assert!(((after.q[0] - before.q[0]) / dt - now.qd[0]).abs() < 1e-7);
            assert!(((after.qd[0] - before.qd[0]) / dt - now.qdd[0]).abs() < 1e-5);
        }
    }
}

#[test]
fn way_points_are_met_exactly() {
    let between = [pass(1.1, 0.7, 1234), pass(0.9, -0.2, 777)];
    let points = [stop(0.3, 0), between[0], between[1], stop(0.1, 400)];
    let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
    let mut tick = 0;
    for (at, point) in points.iter().enumerate() {
        tick += point.ticks;
        let state = motion.at(tick);
        assert_eq!((state.q, state.qd, state.qdd), (point.q, point.qd, [0.0]));
        if at > 0 {
            let end = motion.segments.each[at - 1].at(1.0);
            assert_eq!((end.qd, end.qdd), (point.qd, [0.0]));
            assert!((end.q[0] - point.q[0]).abs() < 1e-15);
        }
    }
    assert_eq!(motion.ticks(), 2411);
    assert_eq!(motion.at(u32::MAX), State::at([0.1]));
}

#[test]
fn a_day_later_a_move_has_the_same_bits() {
    let day = 86_400_000;
    let end = |q: f32, ticks| crate::tests::stop([q], ticks);
    let points = [end(1.0, 0), end(1.0, day), end(2.0, 1000)];
    let limits = [motion_limits(2.0, 10.0)];
    let late = Trajectory::new(&points, 1e-3, &limits).unwrap();
    let early = Trajectory::new(&[points[0], points[2]], 1e-3, &limits);
    let early = early.unwrap();
    for tick in 0..=1001 {
        assert_eq!(late.at(day + tick), early.at(tick));
    }
}

#[test]
fn unusable_way_points_are_named() {
    let new = |points: [WayPoint<f64, 1>; 3]| Trajectory::new(&points, 1e-3, &[FREE]).err();
    let good = [stop(0.0, 0), stop(1.0, 10), stop(0.0, 10)];
    let with = |at: usize, point| {
        let mut points = good;
        points[at] = point;
        new(points)
    };
    assert_eq!(new(good), None);
    let joint = 0;
    let moving = |point| TrajectoryError::NotAtRest { point, joint };
    let none = TrajectoryError::NotFinite { point: 1, joint };
    for (at, point, error) in [
        (0, stop(0.0, 1), TrajectoryError::Ticks { point: 0 }),
        (1, stop(1.0, 0), TrajectoryError::Ticks { point: 1 }),
        (2, stop(0.0, u32::MAX), TrajectoryError::Ticks { point: 2 }),
        (0, pass(0.0, 0.1, 0), moving(0)),
        (2, pass(0.0, 0.1, 9), moving(2)),
        (1, stop(f64::NAN, 9), none),
        (1, pass(0.0, f64::INFINITY, 9), none),
    ] {
        assert_eq!(with(at, point), Some(error));
    }
    for tick in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Trajectory::new(&good, tick, &[FREE]).err();
        assert_eq!(refused, Some(TrajectoryError::Tick));
    }
}

#[test]
fn overflows_and_nan_limits_are_errors() {
    let unlimited = motion_limits(f64::INFINITY, f64::INFINITY);
    for points in [
        [stop(1e308, 0), stop(-1e308, 10)],
        [stop(0.0, 0), stop(1e307, 10)],
        [stop(0.0, 0), stop(1e306, 1)],
    ] {
        assert!(Trajectory::new(&points, 1e-3, &[unlimited]).is_err());
    }
    let points = [stop(0.0, 0), stop(0.0, 10)];
    assert!(Trajectory::new(&points, 1e-3, &[unlimited]).is_ok());
    let unclear = MotionLimits { acceleration: f64::NAN, ..unlimited };
    assert!(matches!(
        Trajectory::new(&points, 1e-3, &[unclear]),
        Err(TrajectoryError::Acceleration { point: 1, .. })
    ));
}
