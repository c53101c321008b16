//! Claims about the retraction.

use super::*;
use crate::tests::motion_limits;

const TICK: f64 = 1e-3;
const SLOW: MotionLimits<f64> = motion_limits(0.5, 2.0);
const DISTANCE: f64 = 0.2;

/// A path with a bend, at a phase of it.
fn along(t: f64) -> [f64; 2] {
    let (s, c) = t.sin_cos();
    [0.5 * s, 0.3 * c]
}

/// Steps in which the path is travelled.
const FINE: u32 = 2000;

fn travelled<const N: usize>() -> TravelledPath<f64, 2, N> {
    let mut path = TravelledPath::new(DISTANCE);
    for k in 0..FINE {
        path.record(&along(1.5 * f64::from(k) / f64::from(FINE)));
    }
    let from = path.point(0);
    assert!(path.plan(&from, TICK, &SLOW));
    path
}

/// The largest distance of the retraction from the path, rad: its ellipse's equation over the slope
/// of that.
fn off<const N: usize>(path: &TravelledPath<f64, 2, N>) -> f64 {
    let distance = |[x, y]: [f64; 2]| {
        let [u, v] = [x / 0.5, y / 0.3];
        (u * u + v * v - 1.0) / (2.0 * u / 0.5).hypot(2.0 * v / 0.3)
    };
    most((0..=path.ticks()).map(|tick| distance(path.at(tick).q)))
}

fn most(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, x| most.max(x.abs()))
}

/// The largest speed and acceleration of the retraction.
fn peaks(path: &TravelledPath<f64, 2, 16>) -> [f64; 2] {
    let states = || (0..=path.ticks()).map(|tick| path.at(tick));
    [most(states().flat_map(|state| state.qd)), most(states().flat_map(|state| state.qdd))]
}

#[test]
fn the_retraction_follows_the_path_from_rest_to_rest() {
    let path = travelled::<16>();
    let [first, last] = [path.at(0), path.at(path.ticks())];
    assert_eq!((first.qd, first.qdd), ([0.0; 2], [0.0; 2]));
    assert!(most(last.qd.into_iter().chain(last.qdd)) < 1e-9);
    assert!(most((0..2).map(|j| first.q[j] - along(1.5)[j])) < DISTANCE / 15.0);
    // The joint that moves most is another one at each end of the path.
    let steps = (1..=path.ticks()).map(|tick| [path.at(tick - 1).q, path.at(tick).q]);
    let went: f64 = steps.map(|[a, b]| most((0..2).map(|j| b[j] - a[j]))).sum();
    assert!((went / DISTANCE - 1.0).abs() < 5e-3, "{went}");
    // Fewer points cut the bend.
    let [few, many] = [off(&travelled::<4>()), off(&path)];
    assert!(many < 3e-4 && few > 10.0 * many, "{many} {few}");
}

#[test]
fn the_retraction_is_as_fast_as_its_limits_allow() {
    let mut path = travelled();
    for (velocity, acceleration) in [(0.5, 2.0), (0.2, 20.0), (3.0, 1.0), (3.0, f64::INFINITY)] {
        let limits = motion_limits(velocity, acceleration);
        let from = path.point(0);
        assert!(path.plan(&from, TICK, &limits));
        let [speed, change] = peaks(&path);
        let share = (speed / velocity).max(change / acceleration);
        assert!((0.6..=1.0).contains(&share), "{share}");
    }
}

// The gap between arm and path is closed within the limits too.
#[test]
fn the_retraction_begins_at_the_arm_within_limits() {
    let mut path = travelled::<16>();
    let end = path.at(path.ticks()).q;
    let [x, y] = path.point(0);
    let ahead = path.ticks();
    // Beyond the path's newest point, before it, and beside it.
    for gap in [[-0.03, -0.01], [0.03, 0.01], [0.05, 0.1], [0.2, -0.2]] {
        let from = [x + gap[0], y + gap[1]];
        assert!(path.plan(&from, TICK, &SLOW));
        let first = path.at(0);
        assert!(most((0..2).map(|j| first.q[j] - from[j])) < 1e-15);
        assert_eq!((first.qd, first.qdd), ([0.0; 2], [0.0; 2]));
        let last = path.at(path.ticks());
        assert!(most((0..2).map(|j| last.q[j] - end[j])) < 1e-9);
        let [speed, change] = peaks(&path);
        assert!(speed <= SLOW.velocity && change <= SLOW.acceleration);
        // In the time of a retraction without a gap it would not be.
        if gap == [0.2, -0.2] {
            path.ticks = ahead;
            path.ticks_inv = 1.0 / f64::from(ahead);
            path.seconds_inv = path.ticks_inv / TICK;
            assert!(peaks(&path)[1] > SLOW.acceleration);
        }
    }
}

#[test]
fn positions_velocities_and_accelerations_agree() {
    let mut path = travelled::<16>();
    let [x, y] = path.point(0);
    assert!(path.plan(&[x - 0.02, y + 0.01], TICK, &SLOW));
    for tick in 1..path.ticks() {
        let [a, b, c] = [tick - 1, tick, tick + 1].map(|tick| path.at(tick));
        for j in 0..2 {
            let slope = (c.q[j] - a.q[j]) / (2.0 * TICK);
            let bend = (c.qd[j] - a.qd[j]) / (2.0 * TICK);
            assert!((slope - b.qd[j]).abs() < 1e-4, "{tick}: {slope}");
            assert!((bend - b.qdd[j]).abs() < 0.05, "{tick}: {bend}");
        }
    }
}

#[test]
fn without_a_path_there_is_no_retraction() {
    let mut path: TravelledPath<f64, 2, 16> = TravelledPath::new(DISTANCE);
    let from = [1.0, 2.0];
    assert!(!path.plan(&from, TICK, &SLOW));
    path.record(&[1.0, 2.0]);
    path.record(&[1.0, f64::NAN]);
    assert!(!path.plan(&from, TICK, &SLOW));
    assert!(most((0..2).map(|j| path.at(5).q[j] - [1.0, 2.0][j])) < 1e-12);
    path.record(&[1.1, 2.0]);
    assert!(path.plan(&from, TICK, &SLOW));
    path.clear();
    assert!(!path.plan(&from, TICK, &SLOW));
}

#[test]
fn a_straight_retraction_takes_the_least_time() {
    let mut path: TravelledPath<f64, 1, 3> = TravelledPath::new(1.0);
    // Points that are apart by the spacing are kept.
    for q in [0.0, 0.5, 1.0] {
        path.record(&[q]);
    }
    assert_eq!(path.count, 3);
    let limits = motion_limits(0.625, f64::INFINITY);
    assert!(path.plan(&[1.0], TICK, &limits));
    // 15/8 · 1 rad at 0.625 rad/s, and a tick for rounding.
    assert_eq!(path.ticks(), 3001);
}

#[test]
fn a_retraction_of_a_short_path_ends_at_its_oldest_point() {
    for points in 2..6 {
        let mut path = TravelledPath::<f64, 2, 16>::new(DISTANCE);
        let spacing = path.spacing;
        let at = |k: usize| [1.01 * spacing * k as f64, -0.5 * spacing * (k % 2) as f64];
        for k in 0..points {
            path.record(&at(k));
        }
        assert!(path.plan(&at(points - 1), TICK, &SLOW));
        let end = path.at(path.ticks());
        assert!(most(end.q.into_iter()) < 1e-12, "{points}: {end:?}");
        assert!(most(end.qd.into_iter().chain(end.qdd)) < 1e-9, "{end:?}");
        // There it stays.
        assert_eq!(path.at(path.ticks() + 1), end);
        assert_eq!(path.at(u32::MAX), end);
    }
}

#[test]
fn the_retraction_in_f32_is_that_in_f64() {
    let double = travelled::<16>();
    let mut single = TravelledPath::<f32, 2, 16>::new(0.99 * DISTANCE as f32);
    (0..16).rev().for_each(|k| single.record(&double.point(k).map(|q| q as f32)));
    single.distance = DISTANCE as f32;
    assert!(single.plan(&single.point(0), TICK as f32, &motion_limits(0.5, 2.0)));
    assert!(single.ticks().abs_diff(double.ticks()) <= 1);
    for tick in 0..=double.ticks() {
        let (a, b) = (single.at(tick), double.at(tick));
        let off = (0..2).flat_map(|j| [(a.q[j], b.q[j]), (a.qd[j], b.qd[j])]);
        assert!(most(off.map(|(a, b)| f64::from(a) - b)) < 1e-3, "{tick}");
    }
}
