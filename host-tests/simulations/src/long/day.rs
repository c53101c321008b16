//! A day of ticks.

use super::name;
use dynamics_core::scalar::Real;
use host_tests::controller::TICK;
use host_tests::hard::Row;
use motion_control::estimate::{Observer, ObserverConfig};
use motion_control::limits::MotionLimits;
use motion_control::reference::{Trajectory, WayPoint};

const DAY: u32 = 86_400_000;

/// The motion and an observer after a day.
pub fn day() -> Vec<Row> {
    observed(DAY)
}

/// The case with a hundredth of the observer's ticks.
pub fn quarter_of_an_hour() -> Vec<Row> {
    observed(DAY / 100)
}

/// The motion after a day, and an observer after this many ticks.
fn observed(ticks: u32) -> Vec<Row> {
    fn run<R: Real>(rows: &mut Vec<Row>) {
        let of = R::from_f64;
        let stop = |q, ticks| WayPoint { q: [of(q)], qd: [R::ZERO], ticks };
        let limits = [MotionLimits { velocity: of(3.0), acceleration: of(30.0) }];
        let way = |rest| {
            let points = [stop(0.3, 0), stop(0.3, rest), stop(1.1, 1000), stop(0.3, 1000)];
            Trajectory::new(&points, of(TICK), &limits).expect("slow enough")
        };
        let (now, tomorrow) = (way(1), way(DAY));
        let same = (0..2100).all(|tick| now.at(1 + tick) == tomorrow.at(DAY + tick));
        rows.push(Row::claim("the motion of tomorrow has the bits of today's", name::<R>(), same));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows);
    run::<f64>(&mut rows);
    // An observer of a joint that swings by steps of its encoder, and one that begins a second
    // before the end.
    let position = |tick: u32| {
        let phase = tick % 4096;
        (if phase < 2048 { phase } else { 4096 - phase }) as f32 * 3.834_952e-4
    };
    let [mut old, mut new] =
        [(); 2].map(|()| Observer::<f32, 1>::new(ObserverConfig { bandwidth: 250.0, tick: 1e-3 }));
    for tick in 0..ticks {
        old.update(&[position(tick)], &[0.0]);
        if tick >= ticks - 1000 {
            new.update(&[position(tick)], &[0.0]);
        }
    }
    let (old, new) = (old.estimate(), new.estimate());
    let [place, speed] = [old.q[0] - new.q[0], old.qd[0] - new.qd[0]].map(|x| f64::from(x.abs()));
    let epsilon = f64::from(f32::EPSILON);
    rows.push(Row::stated(
        "an observer after a day and after a second: rad",
        "f32",
        place,
        epsilon,
    ));
    rows.push(Row::stated("the same: rad/s", "f32", speed, 250.0 * epsilon));
    let time = (0..ticks).fold(0.0_f32, |t, _| t + 1e-3);
    let elapsed = f64::from(ticks) * 1e-3;
    let off = (f64::from(time) - elapsed).abs() / elapsed;
    rows.push(Row::naive("t += 0.001, of the day", "f32", off, epsilon));
    rows
}
