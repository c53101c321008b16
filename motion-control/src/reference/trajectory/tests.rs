//! Peaks against dense sampling, ends, and what makes no trajectory.

use super::segment::sqrt;
use crate::tests::motion_limits;
use super::*;

const FREE: MotionLimits<f64> = motion_limits(1e9, 1e9);

fn stop(q: f64, ticks: u32) -> WayPoint<f64, 1> {
    pass(q, 0.0, ticks)
}

fn pass(q: f64, qd: f64, ticks: u32) -> WayPoint<f64, 1> {
    WayPoint {
        q: [q],
        qd: [qd],
        ticks,
    }
}

/// Repeatable numbers in ±1.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
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
    let mut seed = 1;
    // Miri takes a minute for what is a second otherwise.
    for _ in 0..if cfg!(miri) { 1 } else { 60 } {
        let [a, b] = [noise(&mut seed), noise(&mut seed)];
        let points = [
            stop(0.0, 0),
            pass(a, 3.0 * noise(&mut seed), 700),
            pass(b, 3.0 * noise(&mut seed), 900),
            stop(noise(&mut seed), 500),
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
            assert_eq!(limit(qd * close, qdd * close), Ok(()));
            match limit(qd / close, qdd) {
                Err(TrajectoryError::Velocity { needed, .. }) => {
                    assert!(needed >= qd * (1.0 - 1e-12) && needed <= qd * close);
                }
                other => panic!("{other:?}"),
            }
            match limit(qd * close, qdd / close) {
                Err(TrajectoryError::Acceleration { needed, .. }) => {
                    assert!(needed >= qdd * (1.0 - 1e-12) && needed <= qdd * close);
                }
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
    let points = [
        stop(0.3, 0),
        pass(1.1, 0.7, 1234),
        pass(0.9, -0.2, 777),
        stop(0.1, 400),
    ];
    let motion = Trajectory::new(&points, 1e-3, &[FREE]).unwrap();
    let mut tick = 0;
    for (at, point) in points.iter().enumerate() {
        tick += point.ticks;
        let state = motion.at(tick);
        assert_eq!((state.q, state.qd, state.qdd), (point.q, point.qd, [0.0]));
        if let Some(segment) = at
            .checked_sub(1)
            .and_then(|at| motion.segments.each.get(at))
        {
            let end = segment.at(1.0);
            assert_eq!((end.qd, end.qdd), (point.qd, [0.0]));
            assert!((end.q[0] - point.q[0]).abs() < 1e-15);
        }
    }
    assert_eq!(
        (motion.ticks(), motion.at(u32::MAX)),
        (2411, State::at([0.1]))
    );
}

#[test]
fn a_day_later_a_move_has_the_same_bits() {
    let day = 86_400_000;
    let end = WayPoint {
        q: [1.0_f32],
        qd: [0.0],
        ticks: 1000,
    };
    let points = [
        WayPoint { ticks: 0, ..end },
        WayPoint { ticks: day, ..end },
        WayPoint { q: [2.0], ..end },
    ];
    let limits = [motion_limits(2.0, 10.0)];
    let late = Trajectory::new(&points, 1e-3, &limits).unwrap();
    let early = Trajectory::new(&[WayPoint { ticks: 0, ..end }, points[2]], 1e-3, &limits);
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
    for (at, point, error) in [
        (0, stop(0.0, 1), TrajectoryError::Ticks { point: 0 }),
        (1, stop(1.0, 0), TrajectoryError::Ticks { point: 1 }),
        (2, stop(0.0, u32::MAX), TrajectoryError::Ticks { point: 2 }),
        (
            0,
            pass(0.0, 0.1, 0),
            TrajectoryError::NotAtRest { point: 0, joint: 0 },
        ),
        (
            2,
            pass(0.0, 0.1, 9),
            TrajectoryError::NotAtRest { point: 2, joint: 0 },
        ),
        (
            1,
            stop(f64::NAN, 9),
            TrajectoryError::NotFinite { point: 1, joint: 0 },
        ),
        (
            1,
            pass(0.0, f64::INFINITY, 9),
            TrajectoryError::NotFinite { point: 1, joint: 0 },
        ),
    ] {
        assert_eq!(with(at, point), Some(error));
    }
    for tick in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(
            Trajectory::new(&good, tick, &[FREE]).err(),
            Some(TrajectoryError::Tick)
        );
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
    let unclear = MotionLimits {
        acceleration: f64::NAN,
        ..unlimited
    };
    assert!(matches!(
        Trajectory::new(&points, 1e-3, &[unclear]),
        Err(TrajectoryError::Acceleration { point: 1, .. })
    ));
}
