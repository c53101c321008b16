//! Claims about closed forms, limits, zero inertia, refused paths, and f32.

use super::*;
use crate::limits::MotionLimits;
use crate::reference::PathPoint;
use crate::tests::motion_limits;

mod limits;
mod refused;
mod wild;

/// A path by a function of s that returns q, q′ and q″.
struct Curve<F>(F);

impl<R: Real, F: Fn(R) -> [[R; V]; 3], const V: usize> GeometricPath<R, V> for Curve<F> {
    fn point(&self, s: R) -> PathPoint<R, V> {
        let [q, slope, curvature] = (self.0)(s);
        PathPoint { q, slope, curvature }
    }
}

/// A straight line of one joint.
fn line<R: Real>(d: R) -> Curve<impl Fn(R) -> [[R; 1]; 3]> {
    Curve(move |s| [[d * s], [d], [R::ZERO]])
}

const ANY: MotionLimits<f64> = motion_limits(f64::INFINITY, f64::INFINITY);

fn torques<const V: usize>(torque: [f64; V]) -> PathLimits<f64, V> {
    PathLimits { torque, motion: [ANY; V], friction: [JointFriction::NONE; V] }
}

fn friction<R>(coulomb: R, viscous: R, certain: R) -> JointFriction<R> {
    JointFriction { coulomb, viscous, certain }
}

/// 2.5 kg·m².
fn inertia(state: &State<f64, 1, 1>) -> [f64; 1] {
    [2.5 * state.qdd[0]]
}

fn share_off(is: f64, of: f64) -> f64 {
    (is / of - 1.0).abs()
}

#[test]
fn an_inertia_alone_has_the_bang_bang_motion() {
    for (d, tau) in [(1.3, 8.0), (-0.02, 30.0), (20.0, 0.5)] {
        let path = line(d);
        let timed =
            TimedPath::<_, _, 101>::new(&path, 1e-3, &torques([tau]), inertia).ok().unwrap();
        let best = 2.0 * (d.abs() * 2.5 / tau).sqrt();
        assert!(share_off(timed.seconds(), best) < 1e-13, "{d} {tau}");
        assert_eq!(timed.ticks(), (1e3 * best - 1e-6).ceil() as u32);
        for point in 0..101 {
            let s = f64::from(point) / 100.0;
            let x = 2.0 * tau / (2.5 * d.abs()) * s.min(1.0 - s);
            assert!((timed.square_rate(point as usize) - x).abs() < 1e-12 * x.max(1.0));
        }
    }
    // Without a point in the middle a part of a segment is lost.
    let path = line(1.3);
    let even = TimedPath::<_, _, 100>::new(&path, 1e-3, &torques([8.0]), inertia).unwrap();
    let lost = even.seconds() / (2.0 * (1.3 * 2.5 / 8.0_f64).sqrt()) - 1.0;
    assert!((0.0..6e-5).contains(&lost), "{lost}");
}

#[test]
fn limits_of_speed_and_acceleration_make_it_a_trapezoid() {
    let (d, v, a) = (1.5, 0.9, 4.0);
    let best = d / v + v / a;
    let path = line(d);
    let by_acceleration = PathLimits { motion: [motion_limits(v, a)], ..torques([1e3]) };
    let by_torque =
        PathLimits { motion: [MotionLimits { velocity: v, ..ANY }], ..torques([2.5 * a]) };
    for limits in [by_acceleration, by_torque] {
        let timed = TimedPath::<_, _, 301>::new(&path, 1e-3, &limits, inertia).unwrap();
        let lost = timed.seconds() / best - 1.0;
        assert!((0.0..3e-5).contains(&lost), "{lost:e}");
        let speed = timed.at(timed.ticks() / 2).qd[0];
        assert!(share_off(speed, v) < 1e-13, "{speed}");
    }
}

#[test]
fn timed_path_derivatives_agree_and_both_ends_rest() {
    let path = Curve(|s: f64| {
        let (sin, cos) = (3.0 * s).sin_cos();
        let slope = [3.0 * cos, -3.0 * sin];
        [[sin, cos], slope, [-9.0 * sin, -9.0 * cos]]
    });
    let tick = 1e-3;
    let timed = TimedPath::<_, _, 41>::new(&path, tick, &torques([3.0, 4.0]), |s| s.qdd).unwrap();
    let (start, end) = (timed.at(0), timed.at(timed.ticks()));
    assert_eq!((start.q, start.qd), (path.point(0.0).q, [0.0; 2]));
    assert_eq!(end, State::at(path.point(1.0).q));
    assert_eq!(timed.at(u32::MAX), end);
    for k in 1..timed.ticks() {
        let [before, at, after] = [k - 1, k, k + 1].map(|k| timed.at(k));
        for j in 0..2 {
            let slope = (after.q[j] - before.q[j]) / (2.0 * tick);
            // u jumps between segments: at most by 2 · 4 rad/s² in a tick.
            assert!((slope - at.qd[j]).abs() < 5e-3, "{k}: {slope} {}", at.qd[j]);
            let change = (after.qd[j] - before.qd[j]) / (2.0 * tick);
            let ends = [before.qdd[j], at.qdd[j], after.qdd[j]];
            let least = ends.into_iter().fold(f64::INFINITY, f64::min);
            let most = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let within = (least - 0.05..most + 0.05).contains(&change);
            assert!(within, "{k}: {change} {ends:?}");
        }
    }
}

#[test]
fn f32_has_the_motion_of_f64() {
    let (d, tau) = (1.3_f64, 8.0_f64);
    let path = line(1.3_f32);
    let limits = PathLimits {
        torque: [8.0_f32],
        motion: [motion_limits(f32::INFINITY, f32::INFINITY)],
        friction: [JointFriction::NONE],
    };
    let id = |state: &State<f32, 1, 1>| [2.5 * state.qdd[0]];
    let timed = TimedPath::<_, _, 401>::new(&path, 1e-3, &limits, id).unwrap();
    let best = 2.0 * (d * 2.5 / tau).sqrt();
    let off = share_off(f64::from(timed.seconds()), best);
    assert!(off < 3e-4, "{off:e}");
    for k in 0..=timed.ticks() {
        let off = f64::from(timed.at(k).qdd[0].abs()) * 2.5 / tau - 1.0;
        assert!(off < 3e-5, "{k}: {off:e}");
    }
}
