use super::*;
use crate::limits::MotionLimits;
use crate::reference::{Trajectory, WayPoint};

const H: f64 = 1e-3;
const TICKS: u32 = 200;
const DECAY: f64 = 40.0;

fn trajectory() -> Trajectory<f64, 1, 2> {
    let limits = [MotionLimits {
        velocity: 3.0,
        acceleration: 20.0,
    }];
    let point = |q, ticks| WayPoint {
        q: [q],
        qd: [0.0],
        ticks,
    };
    Trajectory::new(&[point(0.0, 0), point(1.5, 1000)], H, &limits).unwrap()
}

#[test]
fn the_return_reaches_the_trajectory_without_a_jump() {
    let trajectory = trajectory();
    let start = Estimate {
        q: [trajectory.at(400).q[0] + 0.03],
        qd: [1.0],
    };
    let mut resume = ResumeTrajectory::new(H, DECAY, TICKS);
    resume.start(&start, 400);
    let mut way: Vec<_> = (0..TICKS)
        .map(|tick| resume.at(&trajectory, f64::from(tick) / f64::from(TICKS)))
        .collect();
    let end = resume.finish();
    assert_eq!(end, 400 + TICKS / 2);
    way.extend((0..10).map(|tick| trajectory.at(end + tick)));
    assert_eq!((way[0].q, way[0].qd), (start.q, start.qd));
    for pair in way.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let mean = 0.5 * (a.qd[0] + b.qd[0]);
        assert!((b.q[0] - a.q[0] - H * mean).abs() < 4e-6, "{a:?} {b:?}");
        let mean = 0.5 * (a.qdd[0] + b.qdd[0]);
        assert!((b.qd[0] - a.qd[0] - H * mean).abs() < 2e-3, "{a:?} {b:?}");
        assert!(b.qd[0].abs() < 3.0);
    }
}

#[test]
fn a_way_that_is_left_early_keeps_the_trajectorys_progress() {
    let trajectory = trajectory();
    let mut resume = ResumeTrajectory::new(H, DECAY, TICKS);
    let start = Estimate {
        q: [0.5],
        qd: [0.0],
    };
    resume.start(&start, 400);
    for tick in 0..=TICKS / 2 {
        resume.at(&trajectory, f64::from(tick) / f64::from(TICKS));
    }
    assert!(resume.active());
    // ∫w over the first half is 0.078 of the whole way.
    assert_eq!(resume.cancel(), 415);
    assert!(!resume.active());
}

#[test]
fn the_trajectory_waits_where_a_decaying_speed_ends() {
    // 1/λ = 32 ticks.
    let resume = ResumeTrajectory::<f64, 1>::new(1.0 / 1024.0, 32.0, 200);
    assert_eq!(
        (resume.resume_tick(100), resume.resume_tick(u32::MAX)),
        (132, u32::MAX)
    );
}
