use super::*;
use crate::reference::Trajectory;
use crate::tests::{Motion, estimate_of, motion_limits, stop};

const H: f64 = 1e-3;
const TICKS: u32 = 200;
const DECAY: f64 = 40.0;

fn trajectory() -> Trajectory<f64, 1, 2> {
    let limits = [motion_limits(3.0, 20.0)];
    Trajectory::new(&[stop([0.0], 0), stop([1.5], 1000)], H, &limits).unwrap()
}

#[test]
fn the_return_reaches_the_trajectory_without_a_jump() {
    let trajectory = trajectory();
    let start = estimate_of([trajectory.at(400).q[0] + 0.03], [1.0]);
    let mut resume = ResumeTrajectory::new(H, DECAY, TICKS);
    resume.start(&start, 400);
    let mut way: Vec<_> =
        (0..TICKS).map(|tick| resume.at(&trajectory, f64::from(tick) / f64::from(TICKS))).collect();
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
    let start = estimate_of([0.5], [0.0]);
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
    let ends = [100, u32::MAX].map(|tick| resume.resume_tick(tick));
    assert_eq!(ends, [132, u32::MAX]);
}

#[test]
fn a_return_that_begins_again_is_a_new_one() {
    let trajectory = trajectory();
    let start = estimate_of([0.5], [2.0]);
    let mut new = ResumeTrajectory::new(H, DECAY, TICKS);
    let mut used = new;
    used.start(&start, 300);
    for tick in 0..TICKS / 2 {
        used.at(&trajectory, f64::from(tick) / f64::from(TICKS));
    }
    new.start(&start, 400);
    used.start(&start, 400);
    assert_eq!(used, new);
    // It begins as the decay does.
    assert_eq!(new.rest.qdd, [-2.0 * DECAY]);
    assert_eq!(new.cancel(), 400);
}

#[test]
fn a_return_of_no_ticks_advances_by_one() {
    let mut resume = ResumeTrajectory::<f64, 1>::new(H, DECAY, 0);
    resume.start(&estimate_of([0.0], [0.0]), 400);
    assert_eq!(resume.finish(), 401);
}

#[test]
fn a_whole_tick_that_has_passed_is_counted() {
    let mut resume = ResumeTrajectory::new(H, DECAY, TICKS);
    resume.start(&estimate_of([0.0], [0.0]), 400);
    // The rate is one at the end.
    resume.at(&trajectory(), 2.0);
    assert_eq!(resume.cancel(), 401);
}

const A: f64 = 8.0;

/// A constant acceleration, of which a step between two ticks is exact.
fn after(seconds: f64) -> State<f64, 1, 1> {
    State { q: [0.5 * A * seconds * seconds], qd: [A * seconds], qdd: [A] }
}

type Plain = Motion<fn(u32) -> State<f64, 1, 1>>;
const PARABOLA: Plain = Motion(|tick| after(H * f64::from(tick)));
/// A motion of one rad in each tick.
const STEADY: Plain = Motion(|tick| State { q: [tick as f64], qd: [1.0 / H], qdd: [0.0] });

#[test]
fn between_two_ticks_the_trajectory_is_extrapolated() {
    let mut resume = ResumeTrajectory::new(H, DECAY, TICKS);
    let (start, clock) = (estimate_of([0.0], [0.0]), 100);
    resume.start(&start, clock);
    for tick in 0..TICKS {
        let share = f64::from(tick) / f64::from(TICKS);
        let [w, slope, _] = resume.weights(share);
        let goal = resume.goal(&PARABOLA, share, w, slope);
        let ticks = f64::from(clock + resume.advanced) + resume.fraction;
        let exact = after(H * ticks);
        let rates = [w * exact.qd[0], w * w * A + slope * exact.qd[0]];
        assert!((goal.q[0] - exact.q[0]).abs() < 1e-12, "{tick}");
        assert!((goal.qd[0] - rates[0]).abs() < 1e-12, "{tick}");
        assert!((goal.qdd[0] - rates[1]).abs() < 1e-9, "{tick}");
    }
}

// A decay that is slow, so that it still acts where the trajectory counts.
#[test]
fn the_acceleration_of_a_return_is_that_of_its_velocity() {
    let mut resume = ResumeTrajectory::new(H, 2.0, TICKS);
    let start = estimate_of([0.0], [1.0]);
    resume.start(&start, 100);
    let way: Vec<_> =
        (0..TICKS).map(|tick| resume.at(&PARABOLA, f64::from(tick) / f64::from(TICKS))).collect();
    for pair in way.windows(2) {
        let mean = 0.5 * (pair[0].qdd[0] + pair[1].qdd[0]);
        let change = pair[1].qd[0] - pair[0].qd[0] - H * mean;
        assert!(change.abs() < 2e-4, "{change}");
    }
}

#[test]
fn before_the_return_no_time_passes() {
    // A return of four ticks, which begins with a share of zero.
    let mut resume = ResumeTrajectory::<f64, 1>::new(H, DECAY, 4);
    let start = estimate_of([0.5], [0.0]);
    resume.start(&start, 400);
    assert_eq!(resume.at(&STEADY, 0.0).q, [0.5]);
    assert_eq!((resume.fraction, resume.advanced), (0.0, 0));
    // w at 1/8, the middle of the first quarter: 0.125³ · (10 − 15/8 + 6/64).
    resume.at(&STEADY, 0.25);
    assert!((resume.fraction - 0.016_052_246_093_75).abs() < 1e-15);
}

#[test]
fn a_speed_that_decays_within_a_tick_does_not_turn_back() {
    for (decay, keep) in [(0.5 / H, 0.5), (1.0 / H, 0.0), (3.0 / H, 0.0)] {
        let mut resume = ResumeTrajectory::<f64, 1>::new(H, decay, TICKS);
        let start = estimate_of([0.25], [2.0]);
        resume.start(&start, 400);
        resume.at(&STEADY, 0.0);
        assert_eq!((resume.rest.q, resume.rest.qd), ([0.25], [2.0]));
        resume.at(&STEADY, 1.0 / f64::from(TICKS));
        let [qd] = resume.rest.qd;
        assert!((qd - 2.0 * keep).abs() < 1e-12, "{qd}");
        // The mean speed of the tick.
        let [q] = resume.rest.q;
        assert!((q - 0.25 - 0.5 * H * (2.0 + qd)).abs() < 1e-15);
        assert!((resume.rest.qdd[0] + decay * qd).abs() < 1e-9);
    }
}
